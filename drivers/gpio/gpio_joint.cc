// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/gpio/gpio_joint.h"

#include <array>

#include "base/durations.h"

namespace strainwave {

namespace {

const std::optional<LineOptions>& line_of(const GpioJointConfig& config, LineRole role) {
  return config.lines[static_cast<std::size_t>(role)];
}

std::unique_ptr<CountSource> make_counts(const GpioJointConfig& config) {
  if (const auto* counter = std::get_if<CounterConfig>(&config.encoder))
    return std::make_unique<CounterCounts>(*counter, config.where + ".encoder");
  return std::make_unique<QuadratureCounts>(std::get<QuadratureConfig>(config.encoder), config.consumer(),
                                            config.where + ".quadrature");
}

/// Debounces the lines that are read as levels; the kernel debounces edges.
Debounce debounce_of(const JointLines& lines) {
  std::array<std::int64_t, kLineRoles> steady_ns{};
  for (std::size_t i = 0; i < kLineRoles; ++i)
    if (lines[i] && !is_edge_input(static_cast<LineRole>(i)))
      steady_ns[i] = nanoseconds(lines[i]->debounce_s);
  return Debounce(steady_ns);
}

}  // namespace

std::unique_ptr<Actuator> make_gpio_actuator(const GpioJointConfig& config) {
  GpioParts parts;
  parts.lines = std::make_unique<GpioLines>(config.lines, config.consumer(), config.where);
  // The encoder follows when the amplifier is off and the brake is shut.
  parts.counts = make_counts(config);
  if (const auto& index = line_of(config, LineRole::kIndex))
    parts.index = std::make_unique<EdgeEvents>(std::array{*index}, EdgeKind::kActive, config.consumer(),
                                               config.where + ".index");
  parts.pwm = std::make_unique<PwmChannel>(config.pwm, TorqueOutput(config.torque).idle_duty(),
                                           config.where + ".pwm");
  return std::make_unique<GpioActuator>(std::move(parts), config.motion, config.torque, config.sequence,
                                        debounce_of(config.lines));
}

}  // namespace strainwave
