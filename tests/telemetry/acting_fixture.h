// SPDX-License-Identifier: BSD-3-Clause
// Pages that order the joints "elbow" and "knee" of a fleet, and the messages sent for them.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <strainwave/ack_v1.hpp>
#include <strainwave/command_v1.hpp>
#include <strainwave/setpoint_v1.hpp>
#include <string>
#include <vector>

#include "client/protocol/key_file.h"
#include "lcmtypes/signing.h"
#include "telemetry/acting.h"
#include "tests/support/temporary_folder.h"

namespace strainwave {

inline constexpr Acting::Page kTab{1, true};
inline constexpr Acting::Page kOtherTab{2, true};
inline constexpr Acting::Page kForeignPage{3, false};

class ActingTest : public ::testing::Test {
 protected:
  using Json = nlohmann::json;
  struct Sent {
    std::string channel;
    std::vector<std::uint8_t> bytes;
  };

  ActingTest();

  void take(const Acting::Page& page, const Json& order);
  void open(const Acting::Page& page);
  static Json order(const std::string& action, const std::string& joint = "SW.elbow");
  static Json jog(int number, double velocity_rad_s, const std::string& joint = "SW.elbow");
  void tick(double seconds) {
    for (const double end_s = now_s_ + seconds; now_s_ < end_s - 1e-9;) {
      now_s_ += Acting::kTick_s;
      acting_.tick(now_s_);
    }
  }
  /// Delivers the daemon's answer to the latest message.
  void acknowledge(Reason reason = Reason::kAccepted) {
    ack_v1 ack{};
    visit_latest([&](const auto& message) {
      ack.sender_id = message.sender_id;
      ack.sequence = message.sequence;
    });
    ack.accepted = reason == Reason::kAccepted ? 1 : 0;
    ack.reason = static_cast<std::int32_t>(reason);
    const auto name = parse_channel(sent_.back().channel);
    acting_.take({name->prefix, name->joint, "ACK"}, ack);
  }
  template <typename Visit>
  void visit_latest(const Visit& visit) const {
    if (const auto command = decode_exactly<command_v1>(sent_.back().bytes)) return visit(*command);
    visit(*decode_exactly<setpoint_v1>(sent_.back().bytes));
  }
  std::vector<Action> actions(const std::string& channel = "SW.elbow.COMMAND") const {
    std::vector<Action> found;
    for (const Sent& sent : sent_)
      if (sent.channel == channel)
        found.push_back(static_cast<Action>(decode_exactly<command_v1>(sent.bytes)->action));
    return found;
  }
  std::vector<setpoint_v1> setpoints() const {
    std::vector<setpoint_v1> found;
    for (const Sent& sent : sent_)
      if (const auto setpoint = decode_exactly<setpoint_v1>(sent.bytes)) found.push_back(*setpoint);
    return found;
  }
  bool signed_by_key(const Sent& sent) const { return verify(sent.channel, key_, sent.bytes); }
  /// Returns the last text sent to `page`, or nothing.
  Json said(const Acting::Page& page) const;
  void begin_jog(const Acting::Page& page, int number = 1);

  TemporaryFolder folder_;
  PublicKey key_;
  Fleet fleet_;
  std::vector<Sent> sent_;
  std::map<std::uint64_t, std::string> texts_;
  double now_s_ = 100.0;
  Acting acting_{folder_.path() / "key", fleet_,
                 [this](const std::string& channel, std::span<const std::uint8_t> bytes) {
                   sent_.push_back({channel, {bytes.begin(), bytes.end()}});
                 },
                 [this](std::uint64_t page, const std::string& text) { texts_[page] = text; }};
};

}  // namespace strainwave
