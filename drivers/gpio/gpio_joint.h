// SPDX-License-Identifier: BSD-3-Clause
// One joint's GPIO hardware by configuration: makes the drive, and tells of its lines without touching them.
// Not real-time.
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
  std::string joint;  ///< name; lines are held as "strainwaved <joint>"
  std::string where;  ///< section in messages: "joint[0].gpio"
  JointLines lines;
  PwmConfig pwm;
  std::variant<CounterConfig, QuadratureConfig> encoder;  ///< the lines of the latter are those of its roles
  GpioMotionConfig motion;
  TorqueOutputConfig torque;
  DriveSequenceConfig sequence;

  /// As whom the lines are held; the kernel keeps 31 characters.
  std::string consumer() const { return ("strainwaved " + joint).substr(0, 31); }
};

/// Requests everything, outputs safe. Throws InputError before anything is driven.
std::unique_ptr<Actuator> make_gpio_actuator(const GpioJointConfig& config);

/// One line of text per line: role, place, direction, level, holder. Outputs are not requested, inputs only
/// as they are and only when they are free. False when a line is missing or held by another process; the text
/// says what is wrong.
bool report_lines(const GpioJointConfig& config, std::ostream& out);

}  // namespace strainwave
