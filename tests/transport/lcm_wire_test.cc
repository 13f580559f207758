// SPDX-License-Identifier: BSD-3-Clause
#include "transport/lcm_wire.h"

#include <gtest/gtest.h>

#include "tests/support/lcm_datagrams.h"

namespace strainwave {
namespace {

using Kind = LcmDatagram::Kind;
using testing::Bytes;
using testing::fragment_datagram;
using testing::pattern;
using testing::short_datagram;

Kind kind_of(const Bytes& datagram) {
  return parse_lcm_datagram(datagram).kind;
}

Bytes with_channel(const std::string& channel, std::size_t part) {
  Bytes body;
  testing::put_channel(body, channel);
  body.resize(body.size() + part);
  return body;
}

TEST(LcmWire, ReadsAShortMessage) {
  const Bytes datagram = short_datagram("SW.elbow.COMMAND", pattern(40), 77);
  const LcmDatagram parsed = parse_lcm_datagram(datagram);
  EXPECT_EQ(parsed.kind, Kind::kShort);
  EXPECT_EQ(parsed.sequence, 77U);
  EXPECT_EQ(parsed.channel, "SW.elbow.COMMAND");
  EXPECT_EQ(Bytes(parsed.part.begin(), parsed.part.end()), pattern(40));
}

TEST(LcmWire, ReadsAMessageWithoutContent) {
  EXPECT_EQ(kind_of(short_datagram("SW", {})), Kind::kShort);
  EXPECT_TRUE(parse_lcm_datagram(short_datagram("SW", {})).part.empty());
}

TEST(LcmWire, RefusesEveryBeginningOfADatagramThatEndsBeforeItsChannel) {
  const Bytes whole = short_datagram("SW.elbow.COMMAND", {});
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_EQ(kind_of(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size))),
              Kind::kMalformed)
        << size;
  EXPECT_EQ(kind_of(whole), Kind::kShort);
}

TEST(LcmWire, TakesAChannelOf63CharactersAndNoneOf64) {
  EXPECT_EQ(kind_of(short_datagram(std::string(63, 'a'), pattern(9))), Kind::kShort);
  EXPECT_EQ(kind_of(short_datagram(std::string(64, 'a'), pattern(9))), Kind::kMalformed);
  EXPECT_EQ(kind_of(fragment_datagram({1, 100, 0, 0, 2}, with_channel(std::string(63, 'a'), 50))),
            Kind::kFragment);
  EXPECT_EQ(kind_of(fragment_datagram({1, 100, 0, 0, 2}, with_channel(std::string(64, 'a'), 50))),
            Kind::kMalformed);
}

TEST(LcmWire, RefusesAnotherMagic) {
  Bytes datagram = short_datagram("SW", pattern(9));
  datagram[3] = 0x31;
  EXPECT_EQ(kind_of(datagram), Kind::kMalformed);
}

TEST(LcmWire, FindsAChannelInTheFirstFragmentOnly) {
  const auto first_bytes = fragment_datagram({5, 150, 0, 0, 2}, with_channel("SW", 100));
  const LcmDatagram first = parse_lcm_datagram(first_bytes);
  EXPECT_EQ(first.channel, "SW");
  EXPECT_EQ(first.part.size(), 100U);
  const auto second_bytes = fragment_datagram({5, 150, 100, 1, 2}, pattern(50));
  const LcmDatagram second = parse_lcm_datagram(second_bytes);
  EXPECT_EQ(second.channel, "");
  EXPECT_EQ(second.part.size(), 50U);
  EXPECT_EQ(second.offset, 100U);
}

TEST(LcmWire, RefusesAFragmentThatEndsBeyondItsMessageAlsoWhereTheSumWraps) {
  EXPECT_EQ(kind_of(fragment_datagram({5, 150, 100, 1, 2}, pattern(51))), Kind::kMalformed);
  EXPECT_EQ(kind_of(fragment_datagram({5, 150, 151, 1, 2}, {})), Kind::kMalformed);
  EXPECT_EQ(kind_of(testing::crashing_fragments("SW", 1).back()), Kind::kMalformed);
  EXPECT_EQ(kind_of(fragment_datagram({5, UINT32_MAX, UINT32_MAX - 10, 1, 2}, pattern(11))),
            Kind::kMalformed);
}

TEST(LcmWire, RefusesNumbersThatContradictEachOther) {
  EXPECT_EQ(kind_of(fragment_datagram({5, 150, 100, 2, 2}, pattern(50))), Kind::kMalformed);
  EXPECT_EQ(kind_of(fragment_datagram({5, 150, 0, 0, 0}, with_channel("SW", 50))), Kind::kMalformed);
  EXPECT_EQ(kind_of(fragment_datagram({5, 150, 1, 0, 2}, with_channel("SW", 50))), Kind::kMalformed);
}

}  // namespace
}  // namespace strainwave
