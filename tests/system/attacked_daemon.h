// SPDX-License-Identifier: BSD-3-Clause
// A daemon that tracks a long move under an attack, and the criteria of its behaviour. On a machine with
// other programs, it is compared with a run without the attack. In the virtual machine (tests/vm) with its
// virtual time, it must not miss a single cycle.
#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "lcmtypes/key_text.h"
#include "lcmtypes/wire.h"
#include "tests/support/daemon_fixture.h"
#include "tests/system/loop_observer.h"

namespace strainwave::testing {

inline constexpr double kPeriod_s = 0.001;
// One encoder count at the joint.
inline constexpr double kCount_rad = 2.0 * 3.14159265358979323846 / 320000.0;

class AttackedDaemon : public DaemonTest {
 protected:
  void SetUp() override {
    DaemonTest::SetUp();
    std::ofstream(folder_ / "keys") << to_line(AuthorizedKey{key_.public_key(), Role::kEngineer, "test"})
                                    << '\n';
  }

  /// A slow joint, so that one move lasts as long as an attack. Every cycle is published; orders must be signed.
  void start_tracking(const DaemonStart& start = {}) {
    std::string text = configuration("", "state_rate_Hz = 1000\n");
    const auto replace = [&text](const std::string& from, const std::string& to) {
      ASSERT_NE(text.find(from), std::string::npos) << from;
      text.replace(text.find(from), from.size(), to);
    };
    replace("unsigned_orders = \"allow\"", "authorized_keys = \"keys\"");
    replace("speed_limit_rad_s = 6", "speed_limit_rad_s = 0.05");
    replace("position_max_rad = 3.2", "position_max_rad = 12");
    daemon_.emplace(folder_, text, start);
    TestClient client;
    ASSERT_TRUE(client.wait_for_state("elbow", [](const state_v1&) { return true; })) << daemon_->log();
    ASSERT_TRUE(send(client, "TABLE", client.make_table("elbow", shipped_table())).accepted);
    ASSERT_TRUE(send(client, "COMMAND", client.make_command("elbow", Action::kEnable)).accepted);
    ASSERT_TRUE(client.wait_for_mode("elbow", Mode::kHolding)) << daemon_->log();
    ASSERT_TRUE(send(client, "SETPOINT", client.make_setpoint("elbow", 11.0)).accepted);
    ASSERT_TRUE(client.wait_for_mode("elbow", Mode::kTracking));
    client.pump(std::chrono::milliseconds(500));
    observer_.emplace(daemon_->pid());
  }

  template <typename Message>
  Answer send(TestClient& client, const char* kind, const Message& message,
              std::chrono::milliseconds timeout = std::chrono::seconds(5)) {
    const std::string channel = std::string("SW.elbow.") + kind;
    std::vector<std::uint8_t> bytes = encode(message);
    sign(channel, key_, bytes);
    client.lcm().publish(channel, bytes.data(), static_cast<unsigned int>(bytes.size()));
    return client.wait_for_answer(message.sequence, timeout);
  }

  /// Observes the loop every 5 ms until `done`.
  LoopObserver::Summary observe_until(const std::function<bool()>& done) {
    LoopObserver::Summary summary;
    while (!done()) {
      observer_->observe(summary);
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    observer_->observe(summary);
    return summary;
  }
  LoopObserver::Summary observe_for(double duration_s) {
    const auto start = Clock::now();
    return observe_until([&] { return seconds_since(start) >= duration_s; });
  }

  /// The same under orders that are refused, each of which causes a line in the log.
  LoopObserver::Summary refuse_orders_for(double duration_s) {
    TestClient client;
    LoopObserver::Summary summary;
    const auto start = Clock::now();
    while (seconds_since(start) < duration_s) {
      const setpoint_v1 unsigned_order = client.make_setpoint("elbow", 0.0);
      client.lcm().publish("SW.elbow.SETPOINT", &unsigned_order);
      client.pump(std::chrono::milliseconds(5));
      observer_->observe(summary);
    }
    return summary;
  }

  /// Expects that the loop ran in every cycle, and tracked as before.
  static constexpr double kLearned_rad =
      0.3 * kCount_rad;  ///< difference between two rides of a joint that learns
  static void expect_undisturbed(const LoopObserver::Summary& attacked, const LoopObserver::Summary& calm,
                                 double duration_s) {
    EXPECT_EQ(attacked.faults, 0);
    EXPECT_FALSE(attacked.left_tracking);
    // The rest holds only in virtual time: elsewhere the loop shares the machine, without real-time priority.
    if (!in_virtual_time()) return;
    EXPECT_EQ(attacked.records_dropped, 0);
    EXPECT_LE(attacked.worst_error_rad, calm.worst_error_rad + 2.0 * kCount_rad);
    EXPECT_LE(attacked.rms_error_rad(), 1.05 * calm.rms_error_rad() + kLearned_rad);
    EXPECT_LE(attacked.worst_torque_step_Nm, 1.2 * calm.worst_torque_step_Nm);
    EXPECT_GT(static_cast<double>(attacked.cycles), 0.99 * duration_s / kPeriod_s);
    EXPECT_EQ(attacked.cycles_missed, 0);
    EXPECT_EQ(calm.cycles_missed, 0);
  }
  static void report(const char* what, const LoopObserver::Summary& summary, double duration_s) {
    std::printf(
        "%s: %.1f s, %lld cycles, %lld missed, error rms %.3e worst %.3e rad, torque step worst %.3f Nm\n",
        what, duration_s, static_cast<long long>(summary.cycles),
        static_cast<long long>(summary.cycles_missed), summary.rms_error_rad(), summary.worst_error_rad,
        summary.worst_torque_step_Nm);
  }

  /// Expects that the daemon obeys an order of a new client.
  void expect_orders_obeyed() {
    TestClient client;
    ASSERT_TRUE(client.wait_for_state("elbow", [](const state_v1&) { return true; })) << daemon_->log();
    const Answer answer = send(client, "COMMAND", client.make_command("elbow", Action::kHold));
    EXPECT_TRUE(answer.accepted) << answer.text;
    EXPECT_TRUE(client.wait_for_mode("elbow", Mode::kHolding)) << daemon_->log();
  }
  SecretKey key_ = SecretKey::generate();
  std::optional<DaemonProcess> daemon_;
  std::optional<LoopObserver> observer_;
};

}  // namespace strainwave::testing
