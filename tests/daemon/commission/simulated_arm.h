// SPDX-License-Identifier: BSD-3-Clause
// A simulated joint for commissioning.
#pragma once

#include <sstream>
#include <string>

#include "commission/commission_record.h"
#include "daemon/commission/commission.h"
#include "tests/daemon/config/config_file_test.h"

namespace strainwave {

inline constexpr const char* kArm = R"(
[daemon]
real_time = "ignore"
[security]
unsigned_orders = "allow"
[[joint]]
name = "elbow"
joint_model = "arm"
model = "flexible"
gear = "csf-17-50"
motor_inertia_kgm2 = 0.089
load_inertia_kgm2 = 0.1
gear_ratio = 50
driver = "simulated"
[joint.limits]
position_min_rad = -3
position_max_rad = 0.5
speed_limit_rad_s = 3.0
acceleration_rad_s2 = 30
following_error_rad = 0.1
torque_limit_Nm = 34
[joint.simulated]
ambient_temperature_C = "constant:20"
spring = {damping_Nms_rad = 1.0, lost_motion_rad = 0.0005}
drive = {current_loop_s = 0.0003}
sliding = {transmitted_share = 0.05}
)";

class CommissionTest : public ConfigFileTest {
 protected:
  ExitStatus run(const std::string& text) {
    return commission_joint(configuration(text), folder_ / "c.toml", "elbow", folder_ / "out", out_);
  }
  DaemonConfig configuration(const std::string& text) {
    std::ofstream(folder_ / "c.toml") << text;
    return read_config(folder_ / "c.toml", ConfigUse::kCommission);
  }
  CommissionRecord record() { return read_commission_record(folder_ / "out").value(); }
  std::string refusal(const std::string& text) {
    const DaemonConfig config = configuration(text);
    return testing::refusal_of([&] { (void)commissioning_config(config, 0); });
  }
  std::ostringstream out_;
};

}  // namespace strainwave
