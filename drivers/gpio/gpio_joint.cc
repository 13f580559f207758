#include "drivers/gpio/gpio_joint.h"

#include <array>
#include <iomanip>
#include <system_error>

#include "control/input_error.h"

namespace strainwave {

namespace {

std::string consumer_of(const GpioJointConfig& config) { return "strainwaved " + config.joint; }

const std::optional<LineOptions>& line_of(const GpioJointConfig& config, LineRole role) {
  return config.lines[static_cast<std::size_t>(role)];
}

std::unique_ptr<CountSource> make_counts(const GpioJointConfig& config) {
  if (const auto* counter = std::get_if<CounterConfig>(&config.encoder))
    return std::make_unique<CounterCounts>(*counter, config.where + ".encoder");
  return std::make_unique<QuadratureCounts>(std::get<QuadratureConfig>(config.encoder), consumer_of(config),
                                            config.where + ".quadrature");
}

// The level of a line that nobody holds: requested as it is, so that its direction does not change.
std::string level_of(const LinePlace& place, const LineOptions& options) {
  try {
    LineRequest request({place.chip_path, "strainwave gpio-check", LineDirection::kAsIs, LineBias::kAsIs,
                         options.active_low, {place.offset}});
    std::uint32_t active = 0;
    if (!request.read(active)) return "unreadable";
    return active != 0 ? "active" : "inactive";
  } catch (const std::system_error& error) {
    return std::string("unreadable: ") + error.what();
  }
}

bool report_line(const GpioJointConfig& config, LineRole role, std::ostream& out) {
  const LineOptions& options = *line_of(config, role);
  const std::string name(to_text(role));
  LinePlace place;
  try {
    place = find_line(options, config.where + "." + name);
  } catch (const InputError& error) {
    out << "  " << std::left << std::setw(16) << name << "  MISSING: " << error.what() << '\n';
    return false;
  }
  const bool ours = place.info.consumer == consumer_of(config);
  const bool readable = !place.info.held && !is_output(role) && !place.info.output;
  std::string state = is_output(role) ? "an output, not touched" : place.info.output ? "now an output, not touched" : "";
  if (readable) state = level_of(place, options);
  if (place.info.held) state = ours ? "level known to the daemon that holds it" : describe_holder(place.info);
  out << "  " << std::left << std::setw(16) << name << "  " << place.chip_path << ' ' << std::setw(3) << place.offset << "  "
      << std::setw(16) << (place.info.name.empty() ? "(no name)" : place.info.name) << "  "
      << (options.active_low ? "active low   " : "active high  ") << state
      << (ours ? "; held by \"" + place.info.consumer + "\"" : "") << '\n';
  return !place.info.held || ours;
}

}  // namespace

std::unique_ptr<Actuator> make_gpio_actuator(const GpioJointConfig& config) {
  GpioParts parts;
  parts.lines = std::make_unique<GpioLines>(config.lines, consumer_of(config), config.where);
  // Only now, with the amplifier off and the brake shut.
  parts.counts = make_counts(config);
  if (const auto& index = line_of(config, LineRole::kIndex))
    parts.index = std::make_unique<EdgeEvents>(std::array{*index}, EdgeKind::kActive, consumer_of(config),
                                               config.where + ".index");
  if (config.thermometer) parts.thermometer = std::make_unique<TemperatureFile>(*config.thermometer);
  parts.pwm = std::make_unique<PwmChannel>(config.pwm, TorqueOutput(config.torque).idle_duty(), config.where + ".pwm");
  return std::make_unique<GpioActuator>(std::move(parts), config.motion, config.torque, config.sequence);
}

bool report_lines(const GpioJointConfig& config, std::ostream& out) {
  out << config.joint << ":\n";
  bool good = true;
  for (std::size_t i = 0; i < kLineRoles; ++i)
    if (config.lines[i]) good = report_line(config, static_cast<LineRole>(i), out) && good;
  return good;
}

}  // namespace strainwave
