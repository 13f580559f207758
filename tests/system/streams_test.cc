// SPDX-License-Identifier: BSD-3-Clause
// Streams a sine of 0.5 rad and 0.5 Hz to the running daemon over LCM, on a link with a spring and with a
// network's defects. Checks the state of every cycle. For the virtual machine of tests/vm.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>

#include "base/utime.h"
#include "control/table/gain_table_json.h"
#include "tests/support/daemon_fixture.h"

namespace strainwave::testing {
namespace {

using std::chrono::milliseconds;

constexpr double kOmega_rad_s = 2.0 * std::numbers::pi * 0.5;
constexpr double kAmplitude_rad = 0.5;
// Cycles by which a sample is stamped ahead: the longest interval, the controller's lead, and the transmission time.
constexpr std::int64_t kAhead = 60;
constexpr std::int64_t kBegin = 500;
constexpr std::int64_t kEnd = 2500;  // one whole period of the sine

struct Ride {
  double rms_torque_Nm = 0.0;
  double rms_error_rad = 0.0;  ///< of the position from the sine in the same cycle
  double largest_error_rad = 0.0;
  double largest_step_Nm = 0.0;
  std::int64_t cycles = 0;
};

class DaemonStreams : public DaemonTest {
 protected:
  void SetUp() override {
    if (!in_virtual_time()) GTEST_SKIP() << "for the virtual machine: ctest -L vm";
    const GainTable table = read_gain_table(programs_folder() / "c4.json");
    daemon_.emplace(folder_, kJoint);
    client_.emplace();
    ASSERT_TRUE(client_->wait_for_state("elbow", [](const state_v1&) { return true; })) << daemon_->log();
    const Answer loaded = client_->load("elbow", table);
    ASSERT_TRUE(loaded.accepted) << loaded.text;
    ASSERT_TRUE(client_->command("elbow", Action::kEnable).accepted) << daemon_->log();
    ASSERT_TRUE(client_->wait_for_mode("elbow", Mode::kHolding)) << daemon_->log();
    client_->pump(milliseconds(3000));  // the temperature must have been valid for some time
  }

  static constexpr const char* kJoint =
      "[daemon]\nreal_time = \"enforce\"\nstate_rate_Hz = 1000\n[security]\nunsigned_orders = \"allow\"\n"
      "[[joint]]\nname = \"elbow\"\njoint_model = \"rhs17-6006\"\ngear_ratio = 50\ndriver = \"simulated\"\n"
      "model = \"flexible\"\ngear = \"csf-17-50\"\nmotor_inertia_kgm2 = 0.089\nload_inertia_kgm2 = 0.089\n"
      "[joint.limits]\nposition_min_rad = -3.2\nposition_max_rad = 3.2\nspeed_limit_rad_s = 6\n"
      "acceleration_rad_s2 = 150\nfollowing_error_rad = 0.1\ntorque_limit_Nm = 34\n"
      "[joint.simulated.spring]\ndamping_Nms_rad = 1.0\n";

  /// A sample every `every` cycles. A `bad` network loses, doubles and reorders a tenth each, and has gaps of 30 ms.
  Ride ride(std::int64_t every, int derivatives, bool bad) {
    EXPECT_TRUE(client_->move("elbow", 0.0).accepted);
    client_->pump(milliseconds(700));
    client_->begin_stream();
    client_->forget_states();
    client_->pump(milliseconds(10));
    const std::int64_t base = client_->state("elbow")->cycle + 10;
    std::mt19937 random(5);
    const auto chance = [&] { return bad && random() % 10 == 0; };
    std::optional<setpoint_v1> late;
    for (std::int64_t k = 0; k < kEnd; k += every) {
      while (client_->state("elbow")->cycle < base + k) client_->pump(milliseconds(1));
      const setpoint_v1 sample = sample_for(base, k + kAhead, derivatives);
      const bool gap = bad && k % 500 >= 200 && k % 500 < 230;
      const bool reordered = k > 0 && !late && chance();
      if (reordered) {
        late = sample;
        continue;
      }
      const bool lost = k > 0 && (chance() || gap);
      for (int copies = lost ? 0 : chance() ? 2 : 1; copies > 0; --copies)
        client_->lcm().publish("SW.elbow.SETPOINT", &sample);
      if (late) client_->lcm().publish("SW.elbow.SETPOINT", &*late);
      late.reset();
    }
    client_->pump(milliseconds(100));
    const Ride result = judge(base);
    EXPECT_TRUE(client_->command("elbow", Action::kHold).accepted);
    EXPECT_TRUE(client_->wait_for_mode("elbow", Mode::kHolding));
    return result;
  }

  setpoint_v1 sample_for(std::int64_t base, std::int64_t k, int derivatives) {
    const double phase = kOmega_rad_s * 1e-3 * static_cast<double>(k);
    setpoint_v1 sample = client_->make_setpoint("elbow", kAmplitude_rad * std::sin(phase), 0.3);
    sample.derivatives = derivatives;
    if (derivatives > 0) sample.velocity_rad_s = kAmplitude_rad * kOmega_rad_s * std::cos(phase);
    sample.at_cycle = base + k;
    sample.acknowledge = 0;
    return sample;
  }

  Ride judge(std::int64_t base) {
    Ride result;
    const state_v1* last = nullptr;
    for (const state_v1& state : client_->history("elbow")) {
      const std::int64_t k = state.cycle - base;
      if (k < kBegin || k >= kEnd) continue;
      EXPECT_EQ(state.mode, static_cast<std::int32_t>(Mode::kTracking));
      const double error_rad =
          state.joint_position_rad - kAmplitude_rad * std::sin(kOmega_rad_s * 1e-3 * static_cast<double>(k));
      ++result.cycles;
      result.rms_torque_Nm += state.torque_commanded_Nm * state.torque_commanded_Nm;
      result.rms_error_rad += error_rad * error_rad;
      result.largest_error_rad = std::max(result.largest_error_rad, std::abs(error_rad));
      // At a reversal of the joint, friction changes its sign.
      if (last != nullptr && std::abs(state.setpoint_velocity_rad_s) > 0.3)
        result.largest_step_Nm =
            std::max(result.largest_step_Nm, std::abs(state.torque_commanded_Nm - last->torque_commanded_Nm));
      last = &state;
    }
    result.rms_torque_Nm = std::sqrt(result.rms_torque_Nm / static_cast<double>(result.cycles));
    result.rms_error_rad = std::sqrt(result.rms_error_rad / static_cast<double>(result.cycles));
    return result;
  }

  /// Positions only, 20 per second. Each is stamped by the sender's own clock when it is sent, up to 2 ms
  /// later than planned. The plan begins with the answer to the first one.
  enum class Harm { kNone, kOneLost, kAll };
  Ride ride_by_senders_clock(Harm harm) {
    constexpr int kInterval_us = 50'000;
    constexpr int kSamples = 90;
    constexpr int kLost = 40;  // at full speed, in the second period of the sine
    EXPECT_TRUE(client_->move("elbow", 0.0).accepted);
    client_->pump(milliseconds(700));
    client_->begin_stream();
    client_->forget_states();
    setpoint_v1 first = client_->make_setpoint("elbow", 0.0, 0.3);
    first.utime = utime_now();
    client_->lcm().publish("SW.elbow.SETPOINT", &first);
    EXPECT_TRUE(client_->wait_for_answer(first.sequence).accepted);
    const std::int64_t base_us = utime_now() + 10'000;
    base_ = client_->state("elbow")->cycle + 10;
    std::mt19937 random(7);
    const auto chance = [&] { return harm == Harm::kAll && random() % 10 == 0; };
    std::optional<setpoint_v1> late;
    int missing = 0;
    for (int i = 0; i < kSamples; ++i) {
      const std::int64_t due_us = base_us + i * kInterval_us + static_cast<std::int64_t>(random() % 2000);
      while (utime_now() < due_us - 1000) client_->pump(milliseconds(1));
      while (utime_now() < due_us) {
      }
      const std::int64_t now_us = utime_now();
      const double phase = kOmega_rad_s * 1e-6 * static_cast<double>(now_us - base_us);
      setpoint_v1 sample = client_->make_setpoint("elbow", kAmplitude_rad * std::sin(phase), 0.3);
      sample.acknowledge = 0;
      sample.utime = now_us;
      const bool gap = harm == Harm::kAll && i % 10 == 4;
      const bool may_miss = i >= 20 && missing < 2;
      const bool lost = may_miss && ((harm == Harm::kOneLost && i == kLost) || gap || chance());
      const bool reordered = may_miss && !lost && !late && chance();
      missing = lost || reordered ? missing + 1 : 0;
      if (reordered) late = sample;
      if (lost || reordered) continue;
      for (int copies = chance() ? 2 : 1; copies > 0; --copies)
        client_->lcm().publish("SW.elbow.SETPOINT", &sample);
      if (late) client_->lcm().publish("SW.elbow.SETPOINT", &*late);
      late.reset();
    }
    client_->pump(milliseconds(50));
    EXPECT_TRUE(client_->command("elbow", Action::kHold).accepted);
    EXPECT_TRUE(client_->wait_for_mode("elbow", Mode::kHolding));
    return judge_setpoint();
  }

  /// Errors of the setpoint from the sine, at the lag near the play-out delay that makes them smallest.
  Ride judge_setpoint() {
    Ride best;
    best.largest_error_rad = kAmplitude_rad;
    for (double lag_s = 0.02; lag_s < 0.045; lag_s += 0.00025) {
      Ride one;
      const state_v1* last = nullptr;
      for (const state_v1& state : client_->history("elbow")) {
        const std::int64_t k = state.cycle - base_;
        if (k < 1500 || k >= 4400) continue;
        EXPECT_EQ(state.mode, static_cast<std::int32_t>(Mode::kTracking));
        const double sine_rad =
            kAmplitude_rad * std::sin(kOmega_rad_s * (1e-3 * static_cast<double>(k) - lag_s));
        ++one.cycles;
        one.largest_error_rad =
            std::max(one.largest_error_rad, std::abs(state.setpoint_position_rad - sine_rad));
        if (last != nullptr && std::abs(state.setpoint_velocity_rad_s) > 0.3)
          one.largest_step_Nm =
              std::max(one.largest_step_Nm, std::abs(state.torque_commanded_Nm - last->torque_commanded_Nm));
        last = &state;
      }
      if (one.largest_error_rad < best.largest_error_rad) best = one;
    }
    return best;
  }

  std::int64_t base_ = 0;  ///< cycle in which the sine begins
  std::optional<DaemonProcess> daemon_;
  std::optional<TestClient> client_;
};

TEST_F(DaemonStreams, AreFollowedWithTheTorqueOfTheMotionWhateverTheNetworkDoes) {
  const Ride smooth = ride(5, 1, false);
  const auto print = [&](const char* what, const Ride& one) {
    std::printf("%s: %lld cycles, torque rms %.3f N.m, step %.3f N.m, error rms %.3f, largest %.3f mrad\n",
                what, static_cast<long long>(one.cycles), one.rms_torque_Nm, one.largest_step_Nm,
                1e3 * one.rms_error_rad, 1e3 * one.largest_error_rad);
  };
  print("200 Hz with velocity", smooth);
  // StreamedSines tests every rate with and without velocities. This tests effects of the way to the loop.
  for (const auto& [every, derivatives] : {std::pair{50, 0}, std::pair{2, 0}}) {
    const Ride streamed = ride(every, derivatives, false);
    print(("every " + std::to_string(every) + " ms, derivatives " + std::to_string(derivatives)).c_str(),
          streamed);
    EXPECT_GT(streamed.cycles, 1900);
    EXPECT_LT(streamed.rms_error_rad, 1e-3) << every << " ms, derivatives " << derivatives;
    EXPECT_LT(streamed.rms_torque_Nm, 1.2 * smooth.rms_torque_Nm)
        << every << " ms, derivatives " << derivatives;
    EXPECT_LT(streamed.largest_step_Nm, smooth.largest_step_Nm + 1.0) << every << " ms, " << derivatives;
  }
  const Ride hurt = ride(10, 1, true);
  print("lost, doubled, reordered, gaps", hurt);
  EXPECT_LT(hurt.largest_error_rad, 5e-3);
}

TEST_F(DaemonStreams, OfASlowSenderAreFollowedByItsClockWhateverIsLost) {
  const auto print = [&](const char* what, const Ride& one) {
    std::printf("20 Hz, positions by utime, %s: %lld cycles, setpoint off by %.2f mrad, step %.2f N.m\n",
                what, static_cast<long long>(one.cycles), 1e3 * one.largest_error_rad, one.largest_step_Nm);
  };
  const Ride all_came = ride_by_senders_clock(Harm::kNone);
  print("all came", all_came);
  EXPECT_GT(all_came.cycles, 2500);
  EXPECT_LT(all_came.largest_error_rad, 3e-3);
  const Ride one_lost = ride_by_senders_clock(Harm::kOneLost);
  print("one lost at full speed", one_lost);
  EXPECT_LT(one_lost.largest_error_rad, 3e-3);
  EXPECT_LT(one_lost.largest_step_Nm, all_came.largest_step_Nm + 1.0);
  const Ride hurt = ride_by_senders_clock(Harm::kAll);
  print("lost, doubled, reordered, gaps", hurt);
  EXPECT_LT(hurt.largest_error_rad, 5e-3);
  EXPECT_LT(hurt.largest_step_Nm, all_came.largest_step_Nm + 2.0);
}

}  // namespace
}  // namespace strainwave::testing
