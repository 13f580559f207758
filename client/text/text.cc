// SPDX-License-Identifier: BSD-3-Clause
#include "client/text/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "client/protocol/plain_zero.h"
#include "lcmtypes/reading_doubt.h"
#include "lcmtypes/state_fields.h"
#include "strainwave/client_error.h"
#include "strainwave/vocabulary.h"

namespace strainwave {

namespace {

constexpr std::size_t kTerminalColumns = 80;

constexpr std::array kNotices{Notice::kTorqueLimited,   Notice::kTemperatureClamped,
                              Notice::kSetpointExpired, Notice::kReadingMissed,
                              Notice::kSpeedLimited,    Notice::kNotHomed,
                              Notice::kAtLimitSwitch,   Notice::kOffStream,
                              Notice::kPositionLate,    Notice::kOffTarget,
                              Notice::kLoadHigh,        Notice::kOtherInertia,
                              Notice::kPathPaused,      Notice::kYielded,
                              Notice::kSamplesMissing,  Notice::kFrictionDiffers,
                              Notice::kDerated};

bool is_degree_mark(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  return text == "d" || text.starts_with("deg") || text == "\xC2\xB0";
}

/// The meaning of a field in words, if it has any to add; otherwise empty.
std::string meaning(std::string_view field, const state_v1& state) {
  if (field == "mode") return std::string(to_text(static_cast<Mode>(state.mode)));
  if (field == "fault") return fault_words(static_cast<Fault>(state.fault), state.drive_error);
  if (field == "temperature_status") {
    return std::string(to_text(static_cast<TemperatureStatus>(state.temperature_status)));
  }
  if (field == "temperature_used_C" && std::isnan(state.temperature_used_C)) return "no plausible value yet";
  if (field == "notices") {
    std::vector<std::string> texts;
    for (const Notice notice : kNotices) {
      if ((state.notices & static_cast<std::int32_t>(notice)) == 0) continue;
      texts.emplace_back(to_text(notice));
      if (notice == Notice::kFrictionDiffers)
        texts.back() += fmt::format(" ({:.2f} times)", state.friction_factor);
      if (notice == Notice::kDerated)
        texts.back() += std::isfinite(state.temperature_margin_C)
                            ? fmt::format(" ({:.1f} N.m, {:.1f} degC below the limit)", state.torque_limit_Nm,
                                          state.temperature_margin_C)
                            : fmt::format(" ({:.1f} N.m, temperature lost)", state.torque_limit_Nm);
      if (notice == Notice::kOtherInertia && std::isfinite(state.inertia_estimated_kgm2))
        texts.back() += fmt::format(" ({:.3g} kg m2)", state.inertia_estimated_kgm2);
    }
    return fmt::format("{}", fmt::join(texts, ", "));
  }
  return "";
}

/// `notes` as indented lines below the joint's line.
std::string indented(const std::string& notes) {
  constexpr std::size_t kIndent = 2;
  std::string text;
  for (const std::string& line : wrapped(notes, kTerminalColumns - kIndent, notes.size()))
    text += "\n" + std::string(kIndent, ' ') + line;
  return text;
}

}  // namespace

double parse_position_rad(std::string_view text) {
  std::string_view number = text;
  if (number.starts_with('+')) number.remove_prefix(1);  // from_chars takes no plus sign
  double value = 0.0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
  const std::string_view rest(end, static_cast<std::size_t>(number.data() + number.size() - end));
  if (error == std::errc() && rest.empty() && std::isfinite(value)) return value;
  if (error == std::errc() && is_degree_mark(rest) && std::isfinite(value)) {
    throw ClientError(ExitStatus::kUsage,
                      fmt::format("positions are in rad, not in degrees: {} is {:.6g} rad", text,
                                  value * std::numbers::pi / 180.0));
  }
  throw ClientError(
      ExitStatus::kUsage,
      fmt::format("'{}' is not a position: give a finite number in rad, such as 0.1 or -1.5e-3", text));
}

std::string clipped(std::string_view line, std::size_t columns) {
  std::size_t seen = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool continuation = (static_cast<unsigned char>(line[i]) & 0xC0U) == 0x80U;
    if (!continuation && ++seen > columns) return std::string(line.substr(0, i));
  }
  return std::string(line);
}

std::vector<std::string> wrapped(std::string_view text, std::size_t columns, std::size_t most) {
  std::vector<std::string> lines;
  while (lines.size() < most && (lines.empty() || !text.empty())) {
    std::string_view line = text.substr(0, clipped(text, columns).size());
    const bool all = line.size() == text.size();
    if (!all && lines.size() + 1 == most) {
      lines.push_back(clipped(text, columns - 3) + "...");
      break;
    }
    if (const auto blank = line.rfind(' ');
        !all && text[line.size()] != ' ' && blank != line.npos && blank > 0)
      line = line.substr(0, blank);
    lines.emplace_back(line);
    text.remove_prefix(line.size());
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  }
  return lines;
}

std::string display_name(const JointName& name, const std::vector<JointName>& names) {
  const bool several = std::any_of(names.begin(), names.end(),
                                   [&](const JointName& other) { return other.prefix != name.prefix; });
  return several ? name.prefix + "." + name.joint : name.joint;
}

double without_negative_zero(double value, int decimals) noexcept {
  return std::abs(value) <= 0.5 * std::pow(10.0, -decimals) ? 0.0 : value;
}

std::string temperature_text(double temperature_C) {
  return std::isnan(temperature_C) ? "-" : fmt::format("{:+.1f}", without_negative_zero(temperature_C, 1));
}

std::size_t name_columns(const std::vector<JointName>& names) {
  std::size_t columns = 12;  // width for common names
  for (const JointName& name : names) columns = std::max(columns, display_name(name, names).size());
  return columns;
}

std::string state_header(std::size_t name_columns) {
  return fmt::format("{:<{}} {:<9} {:>12} {:>12} {:>9} {:>9} {:>6}", "joint", name_columns, "mode",
                     "setpoint_rad", "position_rad", "error_rad", "torque_Nm", "temp_C");
}

std::string state_row(const std::string& joint, std::size_t name_columns, const JointView& view,
                      double age_s) {
  const state_v1& state = view.state;
  std::string row = fmt::format(
      "{:<{}} {:<9} {:>+12.6f} {:>+12.6f} {:>+9.1e} {:>+9.3f} {:>6}", joint, name_columns,
      to_text(static_cast<Mode>(state.mode)), without_negative_zero(state.setpoint_position_rad, 6),
      without_negative_zero(state.joint_position_rad, 6), tracking_error_rad(view),
      without_negative_zero(state.torque_commanded_Nm, 3), temperature_text(state.temperature_used_C));
  const std::string notes = state_notes(view, age_s);
  if (!notes.empty()) row += indented(notes);
  return row;
}

std::string state_notes(const JointView& view, double age_s) {
  const state_v1& state = view.state;
  std::vector<std::string> notes;
  if (age_s > kStateSilence_s) notes.push_back(fmt::format("no message for {:.1f} s", age_s));
  if (view.two_daemons) notes.emplace_back("two daemons use these channels");
  if (state.fault != 0) notes.push_back(fmt::format("fault {}: {}", state.fault, meaning("fault", state)));
  if (state.notices != 0) notes.push_back(meaning("notices", state));
  if (state.temperature_status != 0) notes.push_back("temperature " + meaning("temperature_status", state));
  if (state.rule_count == 0) notes.emplace_back("no table");
  return fmt::format("{}", fmt::join(notes, "; "));
}

std::string state_details(const std::string& joint, const JointView& view, double age_s) {
  std::string text = fmt::format("{:<24} {}\n{:<24} {:.3f}\n", "joint", joint, "age_s", age_s);
  visit_state_fields(view.state, [&](std::string_view name, const auto& value) {
    if constexpr (requires { value.size(); }) {
      const auto in_use = static_cast<std::size_t>(std::clamp<std::int32_t>(view.state.rule_count, 0, 16));
      text += fmt::format("{:<24} {:.4f}\n", name, fmt::join(value.first(in_use), " "));
    } else {
      const std::string words = meaning(name, view.state);
      text += fmt::format("{:<24} {}{}\n", name, plain_zero(value), words.empty() ? "" : " (" + words + ")");
    }
  });
  if (const std::string notes = state_notes(view, age_s); !notes.empty()) {
    text += fmt::format("{:<24} {}\n", "notes", notes);
  }
  return text;
}

}  // namespace strainwave
