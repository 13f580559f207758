// SPDX-License-Identifier: BSD-3-Clause
#include "client/watch/view.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "base/printable.h"
#include "base/saturated_sum.h"
#include "client/protocol/orders.h"
#include "client/text/text.h"
#include "client/watch/help.h"
#include "client/watch/joint_detail.h"
#include "client/watch/joint_table.h"
#include "strainwave/vocabulary.h"

namespace strainwave {

namespace {

constexpr double kDaemonSilence_s = 3.0;  // TIMING comes once a second
constexpr int kLeastDetail = 10;          // rows below the joints that suffice for details

/// The first part, and as many of the others as fit completely.
template <std::size_t kCount>
std::string fitting(const std::array<std::string, kCount>& parts, std::string_view between, int columns) {
  std::string line;
  for (const std::string& part : parts) {
    if (line.empty())
      line = part;
    else if (static_cast<int>(line.size() + between.size() + part.size()) <= columns)
      line.append(between) += part;
  }
  return line;
}

void draw_daemon(const WatchedDaemon& daemon, Screen& screen, int row) {
  const timing_v1& timing = daemon.timing;
  std::int64_t refused = 0;
  for (const std::int64_t count : timing.rejects) refused = saturated_sum(refused, count);
  const bool silent = daemon.age_s > kDaemonSilence_s;
  const std::array<std::string, 5> parts{
      fmt::format("{}: {}{} at {:g} ms", daemon.prefix,
                  silent ? fmt::format("SILENT for {:.0f} s, ", daemon.age_s) : "",
                  timing.real_time == 1 ? "real time" : "not real time", 1e3 * timing.period_s),
      counted(timing.overruns, "overrun"), fmt::format("{} refused", refused),
      fmt::format("wake-up {:.0f} us", static_cast<double>(timing.wakeup_latency_max_ns) * 1e-3),
      fmt::format("execution {:.0f} us", static_cast<double>(timing.execution_time_max_ns) * 1e-3)};
  screen.put_fitting(row, 0, fitting(parts, ", ", screen.columns()), silent ? Style::kAlarm : Style::kPlain);
}

/// As many keys as fit, the most important ones first.
std::string keys(const WatchModel& model, int columns) {
  const std::array<std::string, 9> all{
      "s stop",        "S stop all", "? help",  "q quit",
      "e enable",      "h hold",     "c clear", fmt::format("[ ] jog {:g} rad", model.jog_rad),
      "up/down select"};
  return fitting(all, "  ", columns);
}

void draw_body(const WatchModel& model, Screen& screen, int first, int end) {
  if (model.joints.empty()) {
    screen.put(first, 0, "no state received yet", Style::kWarning);
    return;
  }
  const int rows = end - first;
  const int wanted = static_cast<int>(model.joints.size()) + 1;
  // The table takes half of the screen at most, if the other half has room for details.
  const int table = rows >= 2 * kLeastDetail ? std::min(wanted, rows / 2)
                                             : std::min(wanted, std::max(2, rows - kLeastDetail));
  draw_joints(model, screen, first, table);
  if (model.selected >= 0 && model.selected < static_cast<int>(model.joints.size()))
    draw_detail(model, model.joints[static_cast<std::size_t>(model.selected)], screen, first + table + 1,
                end);
}

/// Joints with an alarm, whether the screen shows them or not.
std::vector<std::string> troubled(const WatchModel& model) {
  std::vector<std::string> names;
  for (const WatchedJoint& joint : model.joints)
    if (style_of(joint) == Style::kAlarm) names.push_back(name_of(model, joint));
  return names;
}

/// As many of `names` as fit, at least one, and the number of the others.
std::string alarm(const std::vector<std::string>& names, int columns) {
  const auto naming = [&](std::size_t shown) {
    std::string text =
        fmt::format("FAULT or SILENCE: {}",
                    fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(shown), ", "));
    return shown < names.size() ? fmt::format("{} and {} more", text, names.size() - shown) : text;
  };
  std::size_t shown = names.size();
  while (shown > 1 && static_cast<int>(naming(shown).size()) > columns) --shown;
  return naming(shown);
}

/// An alarm comes first, because a narrow terminal cuts the end of the line.
void draw_title(const WatchModel& model, Screen& screen) {
  const std::string counts =
      fmt::format("{} of {}", counted(model.joints.size(), "joint"), counted(model.daemons.size(), "daemon"));
  if (const std::vector<std::string> names = troubled(model); !names.empty()) {
    const std::string text = alarm(names, screen.columns());
    screen.put_fitting(0, 0, text, Style::kAlarm);
    if (static_cast<int>(text.size() + 2 + counts.size()) <= screen.columns())
      screen.put(0, static_cast<int>(text.size()) + 2, counts, Style::kTitle);
    return;
  }
  const int end = screen.put(0, 0, fmt::format("strainwave  {}  ", counts), Style::kTitle);
  screen.put_fitting(0, end, model.has_key ? "commands are signed" : "commands are not signed",
                     Style::kTitle);
}

}  // namespace

std::string name_of(const WatchModel& model, const WatchedJoint& joint) {
  const bool several = std::any_of(model.joints.begin(), model.joints.end(),
                                   [&](const WatchedJoint& other) { return other.prefix != joint.prefix; });
  return several ? joint.prefix + "." + joint.joint : joint.joint;
}

Style style_of(const WatchedJoint& joint) {
  if (mode_of(joint.view) == Mode::kFaulted || joint.age_s > kStateSilence_s || joint.view.two_daemons)
    return Style::kAlarm;
  if (joint.view.state.notices != 0 || joint.view.state.temperature_status != 0) return Style::kWarning;
  return mode_of(joint.view) == Mode::kOff ? Style::kDim : Style::kGood;
}

std::string temperature_source(const WatchedJoint& joint) {
  const auto status = static_cast<TemperatureStatus>(joint.view.state.temperature_status);
  if (status != TemperatureStatus::kValid) return std::string(to_text(status));
  if (!joint.temperature) return "sensor";
  return fmt::format("sensor, {:.1f} s", joint.temperature->age_s);
}

Screen render(const WatchModel& model, int rows, int columns) {
  Screen screen(rows, columns);
  if (rows < 5 || columns < 30) {
    screen.put(0, 0, "terminal too small; s still stops", Style::kWarning);
    return screen;
  }
  draw_title(model, screen);
  int row = 1;
  // The daemons take a third of the screen at most, because the joints matter more.
  const int daemon_rows =
      model.help ? 0 : std::min(static_cast<int>(model.daemons.size()), std::max(1, rows / 3 - 1));
  for (int i = 0; i < daemon_rows; ++i)
    draw_daemon(model.daemons[static_cast<std::size_t>(i)], screen, row++);
  // The message has room for the daemon's reason, but takes a sixth of the screen at most.
  const std::vector<std::string> message =
      wrapped(model.message, static_cast<std::size_t>(columns),
              static_cast<std::size_t>(model.help ? 1 : std::max(1, rows / 6)));
  const int end = rows - 1 - static_cast<int>(message.size());
  model.help ? draw_help(screen, row, end) : draw_body(model, screen, row, end);
  for (std::size_t i = 0; i < message.size(); ++i)
    screen.put(end + static_cast<int>(i), 0, message[i], model.message_alarm ? Style::kAlarm : Style::kPlain);
  screen.put(rows - 1, 0, keys(model, columns), Style::kDim);
  return screen;
}

}  // namespace strainwave
