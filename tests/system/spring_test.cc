// SPDX-License-Identifier: BSD-3-Clause
// The running daemon on a simulated joint with a spring, over LCM, with the state of every cycle. It must
// behave as `strainwave-sim` predicts. For the virtual machine of tests/vm.
#include <algorithm>
#include <cmath>

#include "control/table/gain_table_json.h"
#include "sim/joint/plant_file.h"
#include "sim/studies/contenders.h"
#include "tests/support/daemon_fixture.h"

namespace strainwave::testing {
namespace {

using std::chrono::milliseconds;

constexpr double kCounted_rad = 40e-6;  // two counts of the motor's encoder
constexpr int kSamples = 2000;

/// A plant file: a link with a fine encoder of its own on the gear of size 17.
std::string plant_with_a_link(double link_kgm2, double damping_Nms_rad) {
  return "gear = \"csf-17-50\"\n[link]\ninertia_kgm2 = " + std::to_string(link_kgm2) +
         "\n[spring]\ndamping_Nms_rad = " + std::to_string(damping_Nms_rad) +
         "\n[link_encoder]\ncounts_per_joint_revolution = 1e8\n";
}

/// The compared figures of the link and of the torque.
struct Figures {
  double link_pi2 = 0.0;  ///< sum of |e / r| above 40 urad
  double overshoot_rad = 0.0;
  double peak_Nm = 0.0;

  void add(double link_rad, double torque_Nm, double step_rad) {
    const double error_rad = step_rad - link_rad;
    if (std::abs(error_rad) > kCounted_rad) link_pi2 += std::abs(error_rad / step_rad);
    overshoot_rad = std::max(overshoot_rad, -error_rad);
    peak_Nm = std::max(peak_Nm, std::abs(torque_Nm));
  }
};

class DaemonOnASpring : public DaemonTest {
 protected:
  void SetUp() override {
    if (!in_virtual_time()) GTEST_SKIP() << "for the virtual machine: ctest -L vm";
  }

  /// A daemon that publishes every cycle. `model` has lines of its joint, `limits` and `drive` those of these sections.
  static std::string configured(const std::string& model, const std::string& limits,
                                const std::string& drive) {
    return "[daemon]\nreal_time = \"enforce\"\nstate_rate_Hz = 1000\n[security]\nunsigned_orders = "
           "\"allow\"\n"
           "[[joint]]\nname = \"elbow\"\njoint_model = \"rhs17-6006\"\ngear_ratio = 50\ndriver = "
           "\"simulated\"\n" +
           model + "[joint.limits]\nposition_min_rad = -3.2\nposition_max_rad = 3.2\ntorque_limit_Nm = 34\n" +
           limits + "[joint.simulated]\nambient_temperature_C = \"constant:20\"\ntemperature_noise_C = 0\n" +
           drive;
  }

  void enable(const std::string& configuration, const GainTable& table) {
    client_.reset();
    daemon_.reset();
    daemon_.emplace(folder_, configuration);
    client_.emplace();
    ASSERT_TRUE(client_->wait_for_state("elbow", [](const state_v1&) { return true; })) << daemon_->log();
    const Answer loaded = client_->load("elbow", table);
    ASSERT_TRUE(loaded.accepted) << loaded.text;
    client_->forget_states();
    ASSERT_TRUE(client_->command("elbow", Action::kEnable).accepted) << daemon_->log();
    ASSERT_TRUE(client_->wait_for_mode("elbow", Mode::kHolding)) << daemon_->log();
    client_->pump(milliseconds(3000));  // the temperature must have been valid for some time
  }

  /// Every state of a move, from the first one on.
  std::vector<state_v1> states_of_a_move(double step_rad) {
    client_->forget_states();
    EXPECT_TRUE(client_->move("elbow", step_rad).accepted) << daemon_->log();
    client_->pump(milliseconds(kSamples + 100));
    std::vector<state_v1> states = client_->history("elbow");
    const auto begin = std::find_if(states.begin(), states.end(), [&](const state_v1& state) {
      return state.target_position_rad == step_rad;
    });
    states.erase(states.begin(), begin);
    EXPECT_GE(states.size(), std::size_t{kSamples});
    states.resize(std::min(states.size(), std::size_t{kSamples}));
    for (std::size_t k = 1; k < states.size(); ++k)
      EXPECT_EQ(states[k].cycle, states[k - 1].cycle + 1) << "a cycle is missing";
    return states;
  }

  std::optional<DaemonProcess> daemon_;
  std::optional<TestClient> client_;
};

TEST_F(DaemonOnASpring, MovesTheLinkWithinOnePerCentOfTheStudy) {
  const GainTable table = read_gain_table(programs_folder() / "csf-17-50.json");
  const double link_kgm2 = table.plant.inertia_kgm2 - 0.089;
  const double damping_Nms_rad = 1.0;
  const JointPlantConfig plant = plant_from_toml(plant_with_a_link(link_kgm2, damping_Nms_rad), "plant");
  const std::string model =
      "model = \"flexible\"\ngear = \"csf-17-50\"\nmotor_inertia_kgm2 = 0.089\nload_inertia_kgm2 = " +
      std::to_string(link_kgm2) + "\ndamping_Nms_rad = " + std::to_string(damping_Nms_rad) + "\n";
  for (const double step_rad : {0.01, 0.1, 1.0}) {
    ClosedLoopConfig config;
    config.plant = plant;
    config.ambient = TemperatureProfile::constant(20.0);
    config.setpoint_rad = TimeProfile::constant(step_rad, {"setpoint_position_rad"});
    config.duration_s = kSamples * plant.period_s;
    Figures study;
    for (const TracePoint& point :
         run_closed_loop(config, *extended_contender("daemon", table).make(plant)).trace)
      study.add(point.link_position_rad, point.wanted_torque_Nm, step_rad);

    enable(configured(model,
                      "speed_limit_rad_s = 1000\nmove_speed_share = 1\noverspeed_rad_s = "
                      "1000\nacceleration_rad_s2 = 1e6\n"
                      "following_error_rad = 10\n",
                      "[joint.simulated.link_encoder]\ncounts_per_joint_revolution = 1e8\n"),
           table);
    if (HasFatalFailure()) return;
    Figures daemon;
    for (const state_v1& state : states_of_a_move(step_rad))
      daemon.add(state.link_position_rad, state.torque_commanded_Nm, step_rad);

    std::printf(
        "%g rad: PI2 of the link %.5g, study %.5g; overshoot %.4g, study %.4g mrad; peak %.5g, study "
        "%.5g N.m\n",
        step_rad, daemon.link_pi2, study.link_pi2, 1e3 * daemon.overshoot_rad, 1e3 * study.overshoot_rad,
        daemon.peak_Nm, study.peak_Nm);
    EXPECT_NEAR(daemon.link_pi2 / study.link_pi2, 1.0, 0.01) << step_rad;
    EXPECT_NEAR(daemon.overshoot_rad, study.overshoot_rad, 0.01 * study.overshoot_rad + 20e-6) << step_rad;
    EXPECT_NEAR(daemon.peak_Nm / study.peak_Nm, 1.0, 0.01) << step_rad;
  }
}

}  // namespace
}  // namespace strainwave::testing
