// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/can_nodes/servo_drive.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace strainwave::can_nodes {

namespace {

constexpr double kStandstill_rad_s = 1e-3;
/// Share of the newest difference in the drive's velocity estimate: a low-pass of about three periods.
constexpr double kVelocityFilterShare = 0.3;
/// Share of the momentum that a quick stop removes in each period, as far as the torque allows.
constexpr double kBrakingShare = 0.2;

bool closes_loop(std::int64_t mode) {
  return mode == kModeInterpolatedPosition || mode == kModeCyclicPosition || mode == kModeCyclicVelocity;
}

JointPlantConfig plant_of(const ServoDriveConfig& config) {
  JointPlantConfig plant = config.plant;
  plant.encoder.counts_per_joint_revolution = config.counts_per_joint_revolution;
  return plant;
}

}  // namespace

ServoDrive::ServoDrive(const ServoDriveConfig& config, ObjectDictionary& dictionary, Events events)
    : config_(config),
      dictionary_(dictionary),
      events_(std::move(events)),
      plant_(plant_of(config)),
      period_us_(std::llround(config.plant.period_s * 1e6)),
      loop_({config.plant.period_s, config.velocity_bandwidth_rad_s,
             config.plant.joint.inertia_kgm2 * 2.0 * std::numbers::pi / config.counts_per_joint_revolution /
                 std::abs(joint_torque_per_permille())}) {
  add_objects();
  plant_.set_ambient_temperature(config_.ambient.at(0.0));
  show_temperature();
  show_state();
}

double ServoDrive::joint_torque_per_permille() const {
  return config_.rated_torque_Nm * config_.joint_torque_per_drive_torque / 1000.0;
}

void ServoDrive::restart() {
  power_ = PowerState::kNotReadyToSwitchOn;
  in_state_us_ = 0;
  enabling_ = false;
  controlword_ = 0;
  demand_Nm_ = 0.0;
  ramped_permille_ = 0.0;
  awaiting_rest_ = !plant_.state().stuck;
  plant_.clear_pending_torque();
  show_state();
  show_temperature();
}

void ServoDrive::change_power(PowerState to) {
  if (to == power_) return;
  const PowerState from = power_;
  power_ = to;
  in_state_us_ = 0;
  enabling_ = false;
  ramped_permille_ = 0.0;
  loop_.begin(drive_counts());
  if (from == PowerState::kOperationEnabled) awaiting_rest_ = true;
  show_state();
  if (events_.power_changed) events_.power_changed(from, to);
}

void ServoDrive::obey_controlword() {
  const auto controlword = static_cast<std::uint16_t>(dictionary_.number({0x6040, 0}));
  const bool stays = dictionary_.number({0x605A, 0}) >= 5;
  PowerState to = commanded_state(power_, controlword, controlword_, stays);
  controlword_ = controlword;
  if (power_ == PowerState::kFault && to != power_) {
    dictionary_.set({0x603F, 0}, 0);
    if (events_.error_reset) events_.error_reset();
  }
  // The brake needs time. Until it is open, the drive stays switched on.
  const bool starts = to == PowerState::kOperationEnabled && power_ == PowerState::kSwitchedOn;
  if (starts && config_.enable_delay_us > 0) {
    if (!enabling_) in_state_us_ = 0;
    enabling_ = true;
    return;
  }
  enabling_ = false;
  change_power(to);
}

void ServoDrive::advance_power() {
  in_state_us_ += period_us_;
  const bool slow = std::abs(plant_.state().velocity_rad_s) < kStandstill_rad_s;
  switch (power_) {
    case PowerState::kNotReadyToSwitchOn:
      if (in_state_us_ >= config_.self_test_us) change_power(PowerState::kSwitchOnDisabled);
      break;
    case PowerState::kSwitchedOn:
      if (enabling_ && in_state_us_ >= config_.enable_delay_us) change_power(PowerState::kOperationEnabled);
      break;
    case PowerState::kQuickStopActive: {
      const std::int64_t option = dictionary_.number({0x605A, 0});
      if (option == 0 || (option < 5 && slow)) change_power(PowerState::kSwitchOnDisabled);
      break;
    }
    case PowerState::kFaultReactionActive:
      if (dictionary_.number({0x605E, 0}) == 0 || slow) change_power(PowerState::kFault);
      break;
    default:
      break;
  }
}

// A limit object that the drive does not have limits nothing.
double ServoDrive::limit_permille(std::uint16_t index) const {
  return dictionary_.find({index, 0}) == nullptr ? INT16_MAX
                                                 : static_cast<double>(dictionary_.number({index, 0}));
}

// Bit 12. In IP the master must request it with bit 4 of the controlword.
bool ServoDrive::follows() const {
  const std::int64_t mode = dictionary_.number({0x6061, 0});
  return power_ == PowerState::kOperationEnabled && mode != kModeTorqueProfile &&
         (mode != kModeInterpolatedPosition || (controlword_ & 0x10) != 0);
}

void ServoDrive::take_setpoint(std::int64_t sync_period_us) {
  const std::int64_t mode = dictionary_.number({0x6061, 0});
  if (!closes_loop(mode)) return;
  const bool by_velocity = mode == kModeCyclicVelocity;
  const Key target = mode == kModeInterpolatedPosition ? Key{0x60C1, 1} : Key{0x607A, 0};
  MotionLoop::Setpoint setpoint;
  setpoint.velocity_counts_s = static_cast<double>(dictionary_.number({0x60B1, 0}) +
                                                   (by_velocity ? dictionary_.number({0x60FF, 0}) : 0));
  if (!by_velocity) setpoint.position_counts = static_cast<double>(dictionary_.number(target));
  loop_.take(setpoint, static_cast<double>(sync_period_us) * 1e-6);
}

// Joint side.
double ServoDrive::target_torque_Nm() {
  const auto target = static_cast<double>(dictionary_.number({0x6071, 0}));
  const std::int64_t mode = dictionary_.number({0x6061, 0});
  const double slope =
      static_cast<double>(dictionary_.number({0x6087, 0})) * static_cast<double>(period_us_) * 1e-6;
  if (mode == kModeTorqueProfile)
    ramped_permille_ += std::clamp(target - ramped_permille_, -slope, slope);
  else if (closes_loop(mode))
    ramped_permille_ = follows() ? loop_.step(drive_counts()) : 0.0;
  else
    ramped_permille_ = mode == kModeCyclicTorque ? target : 0.0;
  const double low = -std::min(limit_permille(0x6072), limit_permille(0x60E1));
  const double high = std::min(limit_permille(0x6072), limit_permille(0x60E0));
  const double wanted = ramped_permille_ + static_cast<double>(dictionary_.number({0x60B2, 0}));
  limited_ = wanted < low || wanted > high;
  if (limited_) loop_.was_limited();
  return std::clamp(wanted, low, high) * joint_torque_per_permille();
}

// Joint side, against the motion.
double ServoDrive::braking_torque_Nm() const {
  const double limit_Nm = limit_permille(0x6072) * std::abs(joint_torque_per_permille());
  const double wanted_Nm = -kBrakingShare * plant_.config().joint.inertia_kgm2 *
                           plant_.state().velocity_rad_s / plant_.config().period_s;
  return std::clamp(wanted_Nm, -limit_Nm, limit_Nm);
}

void ServoDrive::step() {
  advance_power();
  if (power_ != PowerState::kNotReadyToSwitchOn)
    dictionary_.set({0x6061, 0}, dictionary_.number({0x6060, 0}));
  limited_ = false;
  switch (power_) {
    case PowerState::kOperationEnabled:
      demand_Nm_ = target_torque_Nm();
      if (const std::int64_t window = dictionary_.number({0x6065, 0});
          window > 0 && loop_.error_counts() > static_cast<double>(window))
        raise_error(kErrorFollowing);
      break;
    case PowerState::kQuickStopActive:
    case PowerState::kFaultReactionActive:
      demand_Nm_ = braking_torque_Nm();
      break;
    default:
      demand_Nm_ = 0.0;
      plant_.clear_pending_torque();
  }
  const double before_rad = plant_.measured_position_rad();
  const double before_counts = drive_counts();
  plant_.step(demand_Nm_, load_torque_Nm_);
  plant_.set_ambient_temperature(config_.ambient.at(plant_.time_s()));
  const double moved_counts = (plant_.measured_position_rad() - before_rad) / (2.0 * std::numbers::pi) *
                              config_.counts_per_joint_revolution;
  velocity_counts_s_ += kVelocityFilterShare * (moved_counts / plant_.config().period_s - velocity_counts_s_);

  probe_index(before_counts, drive_counts());
  since_temperature_us_ += period_us_;
  if (since_temperature_us_ >= config_.temperature_period_us) show_temperature();
  show_state();
  if (awaiting_rest_ && plant_.state().stuck) {
    awaiting_rest_ = false;
    if (power_ != PowerState::kOperationEnabled && events_.at_rest) events_.at_rest();
  }
}

void ServoDrive::raise_error(std::uint16_t code) {
  dictionary_.set({0x603F, 0}, code);
  if (events_.error_raised) events_.error_raised(code);
  react_to_fault();
}

void ServoDrive::react_to_fault() {
  if (power_ == PowerState::kFault || power_ == PowerState::kFaultReactionActive) return;
  change_power(PowerState::kFaultReactionActive);
}

void ServoDrive::lose_connection() {
  switch (dictionary_.number({0x6007, 0})) {
    case 1:
      dictionary_.set({0x603F, 0}, kErrorHeartbeat);
      react_to_fault();
      break;
    case 2:
      if (power_ != PowerState::kFault && power_ != PowerState::kNotReadyToSwitchOn)
        change_power(PowerState::kSwitchOnDisabled);
      break;
    case 3:
      if (power_ == PowerState::kOperationEnabled) change_power(PowerState::kQuickStopActive);
      break;
    default:
      break;
  }
}

}  // namespace strainwave::can_nodes
