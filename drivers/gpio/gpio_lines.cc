// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/gpio/gpio_lines.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <set>
#include <system_error>

#include "base/input_error.h"
#include "base/printable.h"

namespace strainwave {

namespace {

constexpr std::array<std::string_view, kLineRoles> kNames{
    "enable",         "direction",      "brake_release", "alive", "amplifier_fault", "estop",
    "negative_limit", "positive_limit", "home",          "index", "quadrature_a",    "quadrature_b"};

std::vector<std::string> chip_paths() {
  std::vector<std::string> paths;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator("/dev", ignored))
    if (entry.path().filename().string().starts_with("gpiochip")) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  return paths;
}

std::string known_chips() {
  std::string text;
  for (const std::string& path : chip_paths()) {
    std::error_code error;
    std::string label;
    try {
      label = chip_label(path);
    } catch (const std::system_error&) {
      label = "cannot be opened";
    }
    text += (text.empty() ? "" : ", ") + std::filesystem::path(path).filename().string() + " (" + label + ")";
  }
  return text.empty() ? "this machine has no GPIO chip" : "there are " + text;
}

std::string find_chip(const std::string& chip, const std::string& where) {
  if (chip.starts_with('/')) return chip;
  std::string path = "/dev/" + chip;
  std::vector<std::string> found;
  for (const std::string& candidate : chip_paths()) {
    if (candidate == path) return path;
    try {
      if (chip_label(candidate) == chip) found.push_back(candidate);
    } catch (const std::system_error&) {
      // Skips a chip that cannot be opened. If the user gives its path, find_line() reports the error.
    }
  }
  if (found.size() == 1) return found.front();
  throw InputError(where, "chip", chip,
                   (found.empty() ? "no such chip; " : "several chips have this label; ") + known_chips());
}

std::optional<unsigned> number_of(const std::string& text) {
  unsigned number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

std::string role_section(const std::string& where, LineRole role) {
  return where + "." + std::string(to_text(role));
}

}  // namespace

std::string_view to_text(LineRole role) noexcept {
  return kNames[static_cast<std::size_t>(role)];
}

LinePlace find_line(const LineOptions& options, const std::string& where) {
  const std::string path = find_chip(options.chip, where);
  std::vector<LineInfo> lines;
  try {
    lines = list_lines(path);
  } catch (const std::system_error& error) {
    throw InputError(where, "chip", options.chip, std::string("cannot be opened: ") + error.what());
  }
  std::vector<LineInfo> found;
  for (const LineInfo& line : lines)
    if (line.name == options.line) found.push_back(line);
  const auto number = number_of(options.line);
  if (found.empty() && number && *number < lines.size()) found.push_back(lines[*number]);
  if (found.size() == 1) return {path, found.front().offset, found.front()};
  throw InputError(where, "line", options.line,
                   (found.empty() ? "no line of " + path + " has this name; a name or a number from 0 to " +
                                        std::to_string(lines.size() - 1) + " is allowed"
                                  : "several lines of " + path + " have this name: give the number") +
                       " (strainwavectl gpio-check shows them)");
}

std::string describe_holder(const LineInfo& info) {
  const std::string holder =
      info.consumer.empty() ? "a process without a name" : "\"" + printable(info.consumer) + "\"";
  return "held by " + holder + ": end the program that uses the line, or unload its driver";
}

// Lines of one chip with the same settings share one request.
std::vector<GpioLines::Group> GpioLines::group(const JointLines& lines, const std::string& consumer,
                                               const std::string& where) {
  std::vector<Group> groups;
  std::set<std::pair<std::string, unsigned>> taken;
  for (std::size_t i = 0; i < kLineRoles; ++i) {
    const auto role = static_cast<LineRole>(i);
    if (!lines[i]) continue;
    const LineOptions& line = *lines[i];
    const LinePlace place = find_line(line, role_section(where, role));
    if (!taken.insert({place.chip_path, place.offset}).second)
      throw InputError(role_section(where, role), "line", line.line,
                       "this line has two roles, one is allowed");
    if (place.info.held)
      throw InputError(role_section(where, role), "line", line.line, describe_holder(place.info));
    if (is_edge_input(role)) continue;
    const LineDirection direction = is_output(role) ? LineDirection::kOutput : LineDirection::kInput;
    const auto same = std::find_if(groups.begin(), groups.end(), [&](const Group& group) {
      const LineRequest::Settings& settings = group.settings;
      return settings.chip_path == place.chip_path && settings.direction == direction &&
             settings.bias == line.bias && settings.active_low == line.active_low;
    });
    Group& target = same != groups.end()
                        ? *same
                        : groups.emplace_back(Group{
                              {place.chip_path, consumer, direction, line.bias, line.active_low, {}}, {}});
    target.settings.offsets.push_back(place.offset);
    target.roles.push_back(role);
  }
  return groups;
}

GpioLines::GpioLines(const JointLines& lines, const std::string& consumer, const std::string& where) {
  for (Group& group : group(lines, consumer, where)) {
    const bool output = group.settings.direction == LineDirection::kOutput;
    try {
      requests_.push_back({LineRequest(group.settings), group.roles, output});
    } catch (const std::system_error& error) {
      std::string names;
      for (const LineRole role : group.roles) {
        if (!names.empty()) names += ", ";
        names += to_text(role);
      }
      std::string complaint = where;
      complaint.append(": lines ").append(names).append(" of ").append(group.settings.chip_path);
      complaint.append(" cannot be requested: ").append(error.what());
      throw InputError(complaint + " (strainwavectl gpio-check shows who holds them)");
    }
  }
}

GpioLines::~GpioLines() {
  (void)write(0);
}

bool GpioLines::read(std::uint32_t& active) noexcept {
  active = 0;
  for (Requested& requested : requests_) {
    if (requested.output) continue;
    std::uint32_t bits = 0;
    if (!requested.request.read(bits)) return false;
    for (std::size_t i = 0; i < requested.roles.size(); ++i)
      if ((bits & (1U << i)) != 0) active |= bit(requested.roles[i]);
  }
  return true;
}

bool GpioLines::write(std::uint32_t active) noexcept {
  bool good = true;
  for (Requested& requested : requests_) {
    if (!requested.output) continue;
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < requested.roles.size(); ++i)
      if ((active & bit(requested.roles[i])) != 0) bits |= 1U << i;
    if (bits == requested.written) continue;
    // A write that failed is tried again in the next period; the other lines are written in any case.
    if (requested.request.write(bits))
      requested.written = bits;
    else
      good = false;
  }
  return good;
}

}  // namespace strainwave
