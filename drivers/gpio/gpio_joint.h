// SPDX-License-Identifier: BSD-3-Clause
// The GPIO hardware of one joint, from the configuration: makes the drive, and reports its lines without
// changing them. Not real-time.
#pragma once

#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <variant>

#include "drivers/gpio/counter_counts.h"
#include "drivers/gpio/gpio_actuator.h"
#include "drivers/gpio/quadrature_counts.h"

namespace strainwave {

struct GpioJointConfig {
  std::string joint;  ///< name; the lines are requested as "strainwaved <joint>"
  std::string where;  ///< section name for messages: "joint[0].gpio"
  JointLines lines;
  PwmConfig pwm;
  std::variant<CounterConfig, QuadratureConfig> encoder;  ///< quadrature uses the lines of its roles
  GpioMotionConfig motion;
  TorqueOutputConfig torque;
  DriveSequenceConfig sequence;

  /// The consumer name of the lines; the kernel keeps 31 characters.
  std::string consumer() const { return ("strainwaved " + joint).substr(0, 31); }
};

/// Requests all hardware with safe outputs. Throws InputError before it drives any output.
std::unique_ptr<Actuator> make_gpio_actuator(const GpioJointConfig& config);

/// Writes one row per line: role, place, direction, level, holder. It requests no outputs, and inputs only if
/// they are free, without changing them. Returns false when a line is missing or another process holds it;
/// the text says what is wrong.
bool report_lines(const GpioJointConfig& config, std::ostream& out);

}  // namespace strainwave
