// SPDX-License-Identifier: BSD-3-Clause
#include "lcmtypes/channels.h"

#include <gtest/gtest.h>

#include <random>
#include <regex>

namespace strainwave {
namespace {

constexpr std::string_view kKinds[] = {
    channel_kind::kState, channel_kind::kTemperature, channel_kind::kSetpoint, channel_kind::kCommand,
    channel_kind::kTable, channel_kind::kAck,         channel_kind::kPath};

TEST(ChannelName, ReadsBackAsItWasMade) {
  for (const std::string_view kind : kKinds) {
    for (const char* prefix : {"SW", "a", "Lab_2-x", "ABCDEFGHIJKLMNOPQRSTUVWX"}) {
      for (const char* joint : {"elbow", "0", "a-", "_-", "abcdefghijklmnopqrstuvwx"}) {
        const auto parts = parse_channel(channel(prefix, joint, kind));
        ASSERT_TRUE(parts) << channel(prefix, joint, kind);
        EXPECT_EQ(parts->prefix, prefix);
        EXPECT_EQ(parts->joint, joint);
        EXPECT_EQ(parts->kind, kind);
      }
    }
  }
}

TEST(ChannelName, OfTimingHasNoJoint) {
  const auto parts = parse_channel(timing_channel("SW"));
  ASSERT_TRUE(parts);
  EXPECT_EQ(parts->prefix, "SW");
  EXPECT_EQ(parts->joint, "");
  EXPECT_EQ(parts->kind, channel_kind::kTiming);
}

TEST(ChannelName, OfTheLongestNamesFitsIntoLcm) {
  const std::string longest(24, 'x');
  for (const std::string_view kind : kKinds)
    EXPECT_LE(channel(longest, longest, kind).size(), kMaxChannelLength);
}

TEST(ChannelName, FromAHostileSenderIsNoneOfOurs) {
  const std::string long_name(25, 'x');
  for (const std::string& name : {std::string(),
                                  std::string("."),
                                  std::string(".."),
                                  std::string("..."),
                                  std::string("SW"),
                                  std::string("SW."),
                                  std::string("-SW.elbow.STATE"),
                                  std::string("SW.--all.STATE"),
                                  std::string("SW.STATE"),
                                  std::string(".elbow.STATE"),
                                  std::string("SW..STATE"),
                                  std::string("SW.elbow."),
                                  std::string("SW.elbow.STATE.x"),
                                  std::string("SW.el bow.STATE"),
                                  std::string("SW.el\nbow.STATE"),
                                  std::string("SW.el\0bow.STATE", 15),
                                  std::string("SW.\xC3\xA9.STATE"),
                                  std::string("SW.../etc.STATE"),
                                  std::string("S/W.elbow.STATE"),
                                  std::string("SW.[^.]+.STATE"),
                                  long_name + ".elbow.STATE",
                                  "SW." + long_name + ".STATE",
                                  "SW.elbow." + long_name,
                                  std::string(10'000, '.'),
                                  std::string(10'000, 'x')}) {
    EXPECT_FALSE(parse_channel(name)) << name.substr(0, 80);
  }
}

TEST(ChannelName, OfRandomBytesNeverYieldsAnInvalidPart) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> byte(0, 255);
  std::uniform_int_distribution<std::size_t> length(0, 70);
  for (int run = 0; run < 100'000; ++run) {
    std::string name(length(random), ' ');
    // Mostly letters and dots, so that the parts are reached.
    for (char& c : name) c = run % 3 == 0 ? static_cast<char>(byte(random)) : "ab.S-_"[byte(random) % 6];
    const auto parts = parse_channel(name);
    if (!parts) continue;
    EXPECT_TRUE(is_valid_name(parts->prefix));
    EXPECT_TRUE(parts->joint.empty() ? parts->kind == channel_kind::kTiming : is_valid_name(parts->joint));
    EXPECT_TRUE(is_valid_name(parts->kind));
  }
}

TEST(ChannelPattern, MatchesEveryJointOfItsPrefixAndNothingElse) {
  const std::regex pattern(channel_pattern("SW", channel_kind::kState));
  EXPECT_TRUE(std::regex_match("SW.elbow.STATE", pattern));
  EXPECT_TRUE(std::regex_match("SW.j-1_x.STATE", pattern));
  for (const char* other : {"SWX.elbow.STATE", "XSW.elbow.STATE", "SW.elbow.STATES", "SW.elbow.ACK",
                            "SW.STATE", "SWxelbowxSTATE", "SW.a.b.STATE", "SW..STATE"}) {
    EXPECT_FALSE(std::regex_match(other, pattern)) << other;
  }
}

TEST(ChannelPattern, MatchesEveryPrefixWhenAsked) {
  const std::regex pattern(channel_pattern("[^.]+", channel_kind::kState));
  EXPECT_TRUE(std::regex_match("LAB.elbow.STATE", pattern));
  EXPECT_FALSE(std::regex_match("LAB.elbow.ACK", pattern));
}

}  // namespace
}  // namespace strainwave
