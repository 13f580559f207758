#include "tests/support/can_nodes/servo_drive.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace strainwave::can_nodes {

namespace {

constexpr int kModeTorqueProfile = 4;
constexpr int kModeCyclicTorque = 10;
constexpr double kStandstill_rad_s = 1e-3;
/// Share of the newest difference in the drive's velocity estimate: a low-pass of about three periods.
constexpr double kVelocityShare = 0.3;
/// Share of the momentum that a quick stop takes away in each period, torque permitting.
constexpr double kBrakingShare = 0.2;

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
      period_us_(std::llround(config.plant.period_s * 1e6)) {
  add_objects();
  plant_.set_ambient_temperature(config_.ambient.at(0.0));
  show_temperature();
  show_state();
}

void ServoDrive::add_objects() {
  using enum DataType;
  const auto variable = [&](std::uint16_t index, DataType type, Mappable mappable, std::int64_t value = 0) {
    dictionary_.add({index, 0}, {type, Access::kReadOnly, value, mappable});
  };
  const auto setting = [&](std::uint16_t index, DataType type, std::int64_t value, std::int64_t low,
                           std::int64_t high, Mappable mappable = Mappable::kNo) {
    dictionary_.add({index, 0}, {type, Access::kReadWrite, value, mappable, low, high, {}});
  };
  setting(0x6007, kInteger16, 1, 0, 3);
  variable(0x603F, kUnsigned16, Mappable::kTransmit);
  setting(0x6040, kUnsigned16, 0, 0, 0xFFFF, Mappable::kBoth);
  variable(0x6041, kUnsigned16, Mappable::kTransmit);
  setting(0x605A, kInteger16, 2, 0, 6);
  setting(0x605E, kInteger16, 2, 0, 2);
  setting(0x6060, kInteger8, 0, -128, 127, Mappable::kBoth);
  variable(0x6061, kInteger8, Mappable::kTransmit);
  variable(0x6064, kInteger32, Mappable::kTransmit);
  variable(0x606C, kInteger32, Mappable::kTransmit);
  setting(0x6071, kInteger16, 0, INT16_MIN, INT16_MAX, Mappable::kBoth);
  setting(0x6072, kUnsigned16, 1000, 0, UINT16_MAX, Mappable::kBoth);
  variable(0x6074, kInteger16, Mappable::kTransmit);
  variable(0x6075, kUnsigned32, Mappable::kNo, std::llround(config_.rated_current_A * 1e3));
  variable(0x6076, kUnsigned32, Mappable::kNo,
           std::llround(config_.rated_torque_Nm * config_.rated_torque_units_per_Nm));
  variable(0x6077, kInteger16, Mappable::kTransmit);
  setting(0x607E, kUnsigned8, 0, 0, 255);
  setting(0x60B2, kInteger16, 0, INT16_MIN, INT16_MAX, Mappable::kBoth);
  setting(0x60E0, kUnsigned16, 1000, 0, UINT16_MAX, Mappable::kBoth);
  setting(0x60E1, kUnsigned16, 1000, 0, UINT16_MAX, Mappable::kBoth);
  variable(0x60FD, kUnsigned32, Mappable::kTransmit);
  setting(0x6087, kUnsigned32, 1000000, 1, UINT32_MAX);
  dictionary_.add({0x60C2, 0}, {kUnsigned8, Access::kConstant, 2});
  dictionary_.add({0x60C2, 1}, {kUnsigned8, Access::kReadWrite, 1, Mappable::kNo, 1, 255, {}});
  dictionary_.add({0x60C2, 2}, {kInteger8, Access::kReadWrite, -3, Mappable::kNo, -6, 0, {}});
  variable(0x6502, kUnsigned32, Mappable::kNo,
           (config_.has_cst ? 1 << 9 : 0) | (config_.has_tq ? 1 << 3 : 0));

  const Key temperature = config_.temperature.key;
  if (temperature.sub != 0)
    dictionary_.add({temperature.index, 0}, {kUnsigned8, Access::kConstant, temperature.sub});
  dictionary_.add(temperature, {config_.temperature.type, Access::kReadOnly, 0, Mappable::kTransmit});

  dictionary_.guard(0x6060, 0x6060, [this](Key, std::int64_t mode) {
    const bool has = mode == 0 || (mode == kModeCyclicTorque && config_.has_cst) ||
                     (mode == kModeTorqueProfile && config_.has_tq);
    return has ? Abort::kNone : Abort::kInvalidValue;
  });
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
  // The brake takes its time; until it is open the drive stays switched on.
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

// What a drive lacks limits nothing.
double ServoDrive::limit_permille(std::uint16_t index) const {
  return dictionary_.find({index, 0}) == nullptr ? INT16_MAX
                                                 : static_cast<double>(dictionary_.number({index, 0}));
}

// Joint side, from 6071h.
double ServoDrive::target_torque_Nm() {
  const auto target = static_cast<double>(dictionary_.number({0x6071, 0}));
  const std::int64_t mode = dictionary_.number({0x6061, 0});
  if (mode == kModeTorqueProfile) {
    const double slope =
        static_cast<double>(dictionary_.number({0x6087, 0})) * static_cast<double>(period_us_) * 1e-6;
    ramped_permille_ += std::clamp(target - ramped_permille_, -slope, slope);
  } else {
    ramped_permille_ = mode == kModeCyclicTorque ? target : 0.0;
  }
  const double low = -std::min(limit_permille(0x6072), limit_permille(0x60E1));
  const double high = std::min(limit_permille(0x6072), limit_permille(0x60E0));
  const double wanted =
      ramped_permille_ +
      (dictionary_.find({0x60B2, 0}) == nullptr ? 0.0 : static_cast<double>(dictionary_.number({0x60B2, 0})));
  limited_ = wanted < low || wanted > high;
  return std::clamp(wanted, low, high) * joint_torque_per_permille();
}

// Joint side: against the motion.
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
  plant_.step(demand_Nm_, load_torque_Nm_);
  plant_.set_ambient_temperature(config_.ambient.at(plant_.time_s()));
  const double moved_counts = (plant_.measured_position_rad() - before_rad) / (2.0 * std::numbers::pi) *
                              config_.counts_per_joint_revolution;
  velocity_counts_s_ += kVelocityShare * (moved_counts / plant_.config().period_s - velocity_counts_s_);

  since_temperature_us_ += period_us_;
  if (since_temperature_us_ >= config_.temperature_period_us) show_temperature();
  show_state();
  if (awaiting_rest_ && plant_.state().stuck) {
    awaiting_rest_ = false;
    if (power_ != PowerState::kOperationEnabled && events_.at_rest) events_.at_rest();
  }
}

void ServoDrive::show_state() {
  const double sign = config_.joint_torque_per_drive_torque < 0.0 ? -1.0 : 1.0;
  const double counts =
      plant_.measured_position_rad() / (2.0 * std::numbers::pi) * config_.counts_per_joint_revolution;
  // The drive's counter is a 32-bit register: it wraps.
  dictionary_.set({0x6064, 0}, static_cast<std::int32_t>(std::llround(sign * counts)));
  dictionary_.set({0x606C, 0}, static_cast<std::int32_t>(std::llround(sign * velocity_counts_s_)));
  const auto permille = [&](double torque_Nm) {
    return static_cast<std::int16_t>(std::clamp(torque_Nm / joint_torque_per_permille(), -32768.0, 32767.0));
  };
  dictionary_.set({0x6074, 0}, permille(demand_Nm_));
  dictionary_.set({0x6077, 0}, permille(plant_.applied_torque_Nm()));
  const bool follows =
      power_ == PowerState::kOperationEnabled && dictionary_.number({0x6061, 0}) == kModeCyclicTorque;
  const unsigned status =
      status_bits(power_) | 1U << 4 | 1U << 9 | (limited_ ? 1U << 11 : 0U) | (follows ? 1U << 12 : 0U);
  dictionary_.set({0x6041, 0}, status);
}

void ServoDrive::show_temperature() {
  since_temperature_us_ = 0;
  const double temperature_C = plant_.sensor_temperature_C();
  const TemperatureObject& object = config_.temperature;
  dictionary_.set(object.key,
                  object.type == DataType::kReal32
                      ? std::int64_t{std::bit_cast<std::uint32_t>(static_cast<float>(temperature_C))}
                      : std::llround(temperature_C / object.unit_C));
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
