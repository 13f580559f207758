// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/config/config_gpio.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "base/units.h"
#include "daemon/config/config_motor.h"
#include "daemon/realtime/loop/periodic_clock.h"
#include "drivers/gpio/gpio_joint.h"

namespace strainwave {

namespace {

constexpr Range kDelay_s{0.0, 10.0};

LineOptions read_line(TomlSection section, LineRole role) {
  LineOptions line;
  line.chip = section.text("chip");
  line.line = section.text("line");
  line.active_low = section.choice_or("active", "high", {"high", "low"}) == "low";
  const std::string bias = section.choice_or("bias", "as_is", {"as_is", "off", "pull_up", "pull_down"});
  line.bias = bias == "off"         ? LineBias::kOff
              : bias == "pull_up"   ? LineBias::kPullUp
              : bias == "pull_down" ? LineBias::kPullDown
                                    : LineBias::kAsIs;
  line.debounce_s = section.number_or("debounce_s", 0.0, {0.0, is_output(role) ? 0.0 : 0.1});
  section.refuse_unknown_keys();
  return line;
}

JointLines read_lines(TomlSection& section) {
  JointLines lines;
  const auto read = [&](LineRole role, TomlSection line) {
    lines[static_cast<std::size_t>(role)] = read_line(std::move(line), role);
  };
  read(LineRole::kEnable, section.section("enable"));
  if (section.has("direction")) read(LineRole::kDirection, section.section("direction"));
  if (section.has("brake_release")) read(LineRole::kBrakeRelease, section.section("brake_release"));
  if (section.has("alive")) read(LineRole::kAlive, section.section("alive"));
  if (section.has("amplifier_fault")) read(LineRole::kAmplifierFault, section.section("amplifier_fault"));
  if (section.has("estop")) read(LineRole::kEmergencyStop, section.section("estop"));
  if (section.has("negative_limit")) read(LineRole::kNegativeLimit, section.section("negative_limit"));
  if (section.has("positive_limit")) read(LineRole::kPositiveLimit, section.section("positive_limit"));
  if (section.has("home")) read(LineRole::kHome, section.section("home"));
  if (section.has("index")) read(LineRole::kIndex, section.section("index"));
  if (section.has("quadrature_a")) read(LineRole::kQuadratureA, section.section("quadrature_a"));
  if (section.has("quadrature_b")) read(LineRole::kQuadratureB, section.section("quadrature_b"));
  return lines;
}

bool has(const JointLines& lines, LineRole role) {
  return lines[static_cast<std::size_t>(role)].has_value();
}

PwmConfig read_pwm(TomlSection section) {
  PwmConfig pwm;
  pwm.chip_folder = section.text("chip");
  if (!pwm.chip_folder.is_absolute()) pwm.chip_folder = "/sys/class/pwm" / pwm.chip_folder;
  pwm.channel = static_cast<int>(section.integer_or("channel", 0, 0, 1023));
  pwm.frequency_Hz = section.number_or("frequency_Hz", pwm.frequency_Hz, {10.0, 1e6});
  pwm.inversed = section.boolean_or("inversed", false);
  section.refuse_unknown_keys();
  return pwm;
}

// The keys refer to the motor's own shaft, the result to the joint side.
MotorData read_motor(TomlSection section, double gear_ratio) {
  MotorData motor = read_motor_constants(section).at_joint(gear_ratio);
  motor.torque_constant_Nm_A *= section.number_or("efficiency", 1.0, {0.01, 1.0});
  motor.peak_torque_Nm = section.number("peak_current_A", kPositive) * motor.torque_constant_Nm_A;
  if (section.has("resistance_ohm")) motor.resistance_ohm = section.number("resistance_ohm", kPositive);
  section.refuse_unknown_keys();
  return motor;
}

// Returns the limits of `motor` with this amplifier.
MotorLimits read_amplifier(TomlSection section, MotorData motor, GpioJointConfig& gpio) {
  TorqueOutputConfig& torque = gpio.torque;
  const bool voltage = section.choice("kind", {"current", "voltage"}) == "voltage";
  torque.amplifier = voltage ? AmplifierKind::kVoltage : AmplifierKind::kCurrent;
  torque.bridge = section.choice_or("bridge", "sign_magnitude", {"sign_magnitude", "locked_antiphase"}) ==
                          "sign_magnitude"
                      ? BridgeKind::kSignMagnitude
                      : BridgeKind::kLockedAntiphase;
  if ((torque.bridge == BridgeKind::kSignMagnitude) != has(gpio.lines, LineRole::kDirection))
    section.fail("bridge",
                 "\"sign_magnitude\" with a joint.gpio.direction line, or \"locked_antiphase\" without one, "
                 "is allowed");
  if (voltage && motor.resistance_ohm <= 0.0)
    section.fail("kind", "\"voltage\" needs joint.gpio.motor.resistance_ohm");
  if (!voltage) {
    torque.full_scale_Nm = section.number("full_scale_A", kPositive) * motor.torque_constant_Nm_A;
    motor.peak_torque_Nm = std::min(motor.peak_torque_Nm, torque.full_scale_Nm);
  }
  if (voltage || section.has("supply_V")) motor.supply_V = section.number("supply_V", kPositive);
  torque.motor = MotorLimits::from_motor(motor);
  torque.duty_min = section.number_or("duty_min", torque.duty_min, {0.0, 0.99});
  torque.duty_max = section.number_or("duty_max", torque.duty_max, {torque.duty_min + 0.01, 1.0});
  torque.slew_Nm_s = section.number_or("slew_Nm_s", torque.slew_Nm_s, {0.0, 1e9});
  torque.dead_time_s = section.number_or("dead_time_s", torque.dead_time_s, {0.0, 0.1});
  torque.reversed = section.boolean_or("reversed", torque.reversed);
  gpio.sequence.enable_delay_s = section.number_or("enable_delay_s", 0.0, kDelay_s);
  section.refuse_unknown_keys();
  return torque.motor;
}

/// Time for the loop to hold the joint before the brake opens: several periods of a usual loop.
constexpr double kHoldDelay_s = 0.02;

void read_brake(TomlSection section, GpioJointConfig& gpio) {
  const bool brake = has(gpio.lines, LineRole::kBrakeRelease);
  gpio.sequence.hold_delay_s = section.number_or("hold_delay_s", brake ? kHoldDelay_s : 0.0, kDelay_s);
  gpio.sequence.release_delay_s = section.number_or("release_delay_s", 0.0, kDelay_s);
  gpio.sequence.engage_delay_s = section.number_or("engage_delay_s", 0.0, kDelay_s);
  gpio.sequence.stop_delay_s = section.number_or("stop_delay_s", 0.0, kDelay_s);
  if (!brake)
    for (const char* key : {"hold_delay_s", "release_delay_s", "engage_delay_s", "stop_delay_s"})
      if (section.has(key)) section.fail(key, "a delay needs a joint.gpio.brake_release line");
  section.refuse_unknown_keys();
}

// Reads the encoder into `gpio`. Returns the counts per radian of the joint.
double read_encoder(TomlSection section, double period_s, const JointConfig& joint, GpioJointConfig& gpio) {
  const double counts_per_turn = section.number("counts_per_motor_revolution", {1.0, 1e9});
  const double counts_per_rad = counts_per_turn * joint.plant.gear_ratio / kTurn_rad;
  gpio.motion.count_rad = 1.0 / counts_per_rad;
  gpio.motion.period_s = period_s;
  gpio.motion.encoder_reversed = section.boolean_or("reversed", false);
  gpio.motion.velocity_filter_s =
      section.number_or("velocity_filter_s", gpio.motion.velocity_filter_s, {0.0, 1.0});
  const double fastest_counts_s = joint.loop.limits.overspeed_rad_s * counts_per_rad;
  if (section.choice("source", {"counter", "edges"}) == "counter") {
    CounterConfig counter;
    counter.count_folder = section.text("counter");
    if (!counter.count_folder.is_absolute())
      counter.count_folder = "/sys/bus/counter/devices" / counter.count_folder;
    const double least = std::max(3.0, std::ceil(4.0 * fastest_counts_s * period_s));
    constexpr std::int64_t kLargest = std::numeric_limits<std::int64_t>::max();
    if (section.has("ceiling")) {
      const auto at_least = static_cast<std::int64_t>(least);
      counter.ceiling = static_cast<std::uint64_t>(section.integer_or("ceiling", 0, at_least, kLargest));
    }
    gpio.encoder = counter;
  } else {
    if (!has(gpio.lines, LineRole::kQuadratureA) || !has(gpio.lines, LineRole::kQuadratureB))
      section.fail("source", "\"edges\" needs the lines joint.gpio.quadrature_a and quadrature_b");
    QuadratureConfig quadrature;
    quadrature.a = *gpio.lines[static_cast<std::size_t>(LineRole::kQuadratureA)];
    quadrature.b = *gpio.lines[static_cast<std::size_t>(LineRole::kQuadratureB)];
    quadrature.max_rate_Hz =
        section.number_or("max_rate_Hz", quadrature.max_rate_Hz, {1.0, QuadratureConfig::kHighestRate_Hz});
    quadrature.priority = static_cast<int>(section.integer_or("priority", quadrature.priority, 0, 98));
    quadrature.clock_ns = &monotonic_now_ns;
    const double wanted_Hz = joint.loop.controller.motion.velocity_rad_s * counts_per_rad;
    if (wanted_Hz > quadrature.max_rate_Hz)
      section.fail("source", "joint.limits.speed_limit_rad_s makes " +
                                 std::to_string(std::lround(wanted_Hz)) +
                                 " edges a second, more than max_rate_Hz = " +
                                 std::to_string(std::lround(quadrature.max_rate_Hz)) + ": use \"counter\"");
    gpio.encoder = quadrature;
  }
  section.refuse_unknown_keys();
  return counts_per_rad;
}

}  // namespace

HomingInputs read_gpio_driver(TomlSection& section, const std::string& where, double period_s,
                              JointConfig& joint) {
  GpioJointConfig gpio;
  gpio.joint = joint.name;
  gpio.where = where;
  gpio.lines = read_lines(section);
  gpio.pwm = read_pwm(section.section("pwm"));
  const MotorData motor = read_motor(section.section("motor"), joint.plant.gear_ratio);
  gpio.torque.period_s = period_s;
  const MotorLimits limits = read_amplifier(section.section("amplifier"), motor, gpio);
  read_brake(section.section_or_empty("brake"), gpio);
  const double counts_per_rad = read_encoder(section.section("encoder"), period_s, joint, gpio);

  JointControllerConfig& controller = joint.loop.controller;
  controller.encoder_resolution_rad = 1.0 / counts_per_rad;
  controller.motor = limits;
  if (controller.torque_limit_Nm > controller.motor.peak_torque_Nm * (1.0 + 1e-9)) {
    std::ostringstream most;
    most << controller.motor.peak_torque_Nm;
    section.fail(
        "motor",
        "joint.limits.torque_limit_Nm may be at most " + most.str() +
            " (torque constant * gear ratio * efficiency * current): lower it, or allow more current");
  }
  joint.driver_resource = "pwm " + gpio.pwm.chip_folder.string() + " " + std::to_string(gpio.pwm.channel);
  joint.drive = gpio;
  return {has(gpio.lines, LineRole::kHome), has(gpio.lines, LineRole::kNegativeLimit),
          has(gpio.lines, LineRole::kPositiveLimit), has(gpio.lines, LineRole::kIndex)};
}

}  // namespace strainwave
