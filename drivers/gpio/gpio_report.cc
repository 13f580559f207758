// SPDX-License-Identifier: BSD-3-Clause
// report_lines() of gpio_joint.h, the output of gpio-check.
#include <filesystem>
#include <iomanip>
#include <system_error>

#include "base/input_error.h"
#include "base/printable.h"
#include "drivers/gpio/gpio_joint.h"
#include "drivers/gpio/kernel_view.h"

namespace strainwave {

namespace {

std::string level_text(bool active) {
  return active ? "active" : "inactive";
}

// The request keeps the direction of the line.
std::string level_of_free_input(const LinePlace& place, const LineOptions& options) {
  try {
    LineRequest request({place.chip_path,
                         "strainwave gpio-check",
                         LineDirection::kAsIs,
                         LineBias::kAsIs,
                         options.active_low,
                         {place.offset}});
    std::uint32_t active = 0;
    return request.read(active) ? level_text(active != 0) : "unreadable";
  } catch (const std::system_error& error) {
    return std::string("unreadable: ") + error.what();
  }
}

std::string level_of(const LinePlace& place, LineRole role, const LineOptions& options) {
  if (place.info.held) {
    const auto high =
        level_of_held_line(std::filesystem::path(place.chip_path).filename().string(), place.offset);
    return high ? level_text(*high != options.active_low) : "(root only)";
  }
  const bool output = is_output(role) || place.info.output;
  return output ? "(not read)" : level_of_free_input(place, options);
}

bool report_line(const GpioJointConfig& config, LineRole role, std::ostream& out) {
  const LineOptions& options = *config.lines[static_cast<std::size_t>(role)];
  const std::string name(to_text(role));
  out << "  " << std::left << std::setw(16) << name << "  ";
  try {
    const LinePlace place = find_line(options, config.where + "." + name);
    const bool ours = place.info.consumer == config.consumer();
    out << place.chip_path << ' ' << std::setw(3) << place.offset << "  " << std::setw(16)
        << (place.info.name.empty() ? "(no name)" : place.info.name) << "  "
        << (place.info.output ? "out" : "in ") << (options.active_low ? "  active low   " : "  active high  ")
        << std::setw(14) << level_of(place, role, options) << "  ";
    if (!place.info.held)
      out << "free\n";
    else if (ours)
      out << "held by \"" << printable(place.info.consumer) << "\"\n";
    else
      out << "UNUSABLE: " << describe_holder(place.info) << '\n';
    return !place.info.held || ours;
  } catch (const InputError& error) {
    out << "MISSING: " << error.what() << '\n';
    return false;
  }
}

}  // namespace

bool report_lines(const GpioJointConfig& config, std::ostream& out) {
  out << config.joint << ":\n";
  bool good = true;
  for (std::size_t i = 0; i < kLineRoles; ++i)
    if (config.lines[i]) good = report_line(config, static_cast<LineRole>(i), out) && good;
  return good;
}

}  // namespace strainwave
