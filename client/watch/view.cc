#include "client/watch/view.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "client/text/text.h"
#include "lcmtypes/vocabulary.h"

namespace strainwave {

namespace {

constexpr double kSilence_s = 1.0;
constexpr int kSparkWidth = 12;

constexpr std::array<std::string_view, 8> kBars{"▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
constexpr std::string_view kAsciiBars = ".:-=+*%#";

std::string bar(double share, bool unicode) {
  if (!std::isfinite(share)) return "?";
  const auto step = static_cast<std::size_t>(std::clamp(share * 8.0, 0.0, 7.0));
  return unicode ? std::string(kBars.at(step)) : std::string(1, kAsciiBars.at(step));
}

Mode mode_of(const WatchedJoint& joint) {
  return static_cast<Mode>(joint.view.state.mode);
}

double error_rad(const WatchedJoint& joint) {
  return joint.view.state.joint_position_rad - joint.view.state.setpoint_position_rad;
}

/// Several daemons: joints of the same name must not be taken for each other.
std::string name_of(const WatchModel& model, const WatchedJoint& joint) {
  const bool several = std::any_of(model.joints.begin(), model.joints.end(),
                                   [&](const WatchedJoint& other) { return other.prefix != joint.prefix; });
  return several ? joint.prefix + "." + joint.joint : joint.joint;
}

/// Where the temperature that schedules the gains comes from.
std::string temperature_source(const WatchedJoint& joint) {
  const auto status = static_cast<TemperatureStatus>(joint.view.state.temperature_status);
  if (status != TemperatureStatus::kValid) return std::string(to_text(status));
  if (!joint.temperature) return "sensor";
  return fmt::format("sensor, {:.1f} s", joint.temperature->age_s);
}

/// One column of the table of joints.
struct Column {
  std::string_view title;
  int width;
  int rank;  ///< higher ones go first when the terminal is narrow
  std::string (*cell)(const WatchModel&, const WatchedJoint&);
};

const std::array<Column, 10> kColumns{{
    {"joint", 16, 0, [](const WatchModel& m, const WatchedJoint& j) { return name_of(m, j); }},
    {"mode", 9, 0, [](const WatchModel&, const WatchedJoint& j) { return std::string(to_text(mode_of(j))); }},
    {"setpoint_rad", 13, 2,
     [](const WatchModel&, const WatchedJoint& j) {
       return fmt::format("{:+12.6f}", j.view.state.setpoint_position_rad);
     }},
    {"position_rad", 13, 1,
     [](const WatchModel&, const WatchedJoint& j) {
       return fmt::format("{:+12.6f}", j.view.state.joint_position_rad);
     }},
    {"error_rad", 10, 3,
     [](const WatchModel&, const WatchedJoint& j) { return fmt::format("{:+9.1e}", error_rad(j)); }},
    {"torque_Nm", 10, 4,
     [](const WatchModel&, const WatchedJoint& j) {
       return fmt::format("{:+9.3f}", j.view.state.torque_applied_Nm);
     }},
    {"temp_C", 7, 5,
     [](const WatchModel&, const WatchedJoint& j) {
       return fmt::format("{:+6.1f}", j.view.state.temperature_C);
     }},
    {"from", 14, 7, [](const WatchModel&, const WatchedJoint& j) { return temperature_source(j); }},
    {"error", kSparkWidth + 1, 6,
     [](const WatchModel& m, const WatchedJoint& j) {
       return sparkline(j.errors_rad, kSparkWidth, m.unicode);
     }},
    {"torque", kSparkWidth + 1, 8,
     [](const WatchModel& m, const WatchedJoint& j) {
       return sparkline(j.torques_Nm, kSparkWidth, m.unicode);
     }},
}};

constexpr int kNotesWidth = 20;  // room for notes before the least important column

std::vector<const Column*> fitting_columns(int columns) {
  std::vector<const Column*> chosen;
  for (const Column& column : kColumns) chosen.push_back(&column);
  const auto width = [&] {
    int sum = 0;
    for (const Column* column : chosen) sum += column->width + 1;
    return sum;
  };
  while (chosen.size() > 2 && width() + kNotesWidth > columns)
    chosen.erase(
        std::max_element(chosen.begin(), chosen.end(), [](auto* a, auto* b) { return a->rank < b->rank; }));
  return chosen;
}

Style style_of(const WatchedJoint& joint) {
  if (mode_of(joint) == Mode::kFaulted || joint.age_s > kSilence_s || joint.view.two_daemons)
    return Style::kAlarm;
  if (joint.view.state.notices != 0 || joint.view.state.temperature_status != 0) return Style::kWarning;
  return mode_of(joint) == Mode::kOff ? Style::kDim : Style::kGood;
}

void draw_joints(const WatchModel& model, Screen& screen, int first, int count) {
  const std::vector<const Column*> columns = fitting_columns(screen.columns());
  int x = 1;
  for (const Column* column : columns) {
    screen.put(first, x, column->title, Style::kDim);
    x += column->width + 1;
  }
  screen.put(first, x, "notes", Style::kDim);
  // The selected joint stays in sight.
  const int shown = std::max(0, count - 1);
  const int skip =
      std::clamp(model.selected - shown + 1, 0, std::max(0, static_cast<int>(model.joints.size()) - shown));
  for (int i = 0; i < shown && skip + i < static_cast<int>(model.joints.size()); ++i) {
    const WatchedJoint& joint = model.joints[static_cast<std::size_t>(skip + i)];
    const int row = first + 1 + i;
    const bool selected = skip + i == model.selected;
    const Style style = selected ? Style::kSelected : style_of(joint);
    if (selected) screen.paint(row, style);
    screen.put(row, 0, selected ? ">" : " ", style);
    x = 1;
    for (const Column* column : columns) {
      screen.put(row, x, clipped(column->cell(model, joint), static_cast<std::size_t>(column->width)), style);
      x += column->width + 1;
    }
    screen.put(row, x, state_notes(joint.view, joint.age_s), selected ? style : style_of(joint));
  }
}

void draw_daemon(const WatchedDaemon& daemon, Screen& screen, int row) {
  const timing_v1& timing = daemon.timing;
  std::int64_t refused = 0;
  for (const std::int64_t count : timing.rejects) refused += count;
  const bool silent = daemon.age_s > 3.0;  // TIMING comes once a second
  const std::string text =
      fmt::format("{}: {}, period {} s, overruns {}, wake-up {:.0f} us, execution {:.0f} us, refused {}{}",
                  daemon.prefix, timing.real_time == 1 ? "real time" : "not real time", timing.period_s,
                  timing.overruns, static_cast<double>(timing.wakeup_latency_max_ns) * 1e-3,
                  static_cast<double>(timing.execution_time_max_ns) * 1e-3, refused,
                  silent ? fmt::format(", silent for {:.0f} s", daemon.age_s) : "");
  screen.put(row, 0, text, silent ? Style::kAlarm : Style::kPlain);
}

/// The selected joint: weights of its rules, where it stands within its limits.
void draw_selected(const WatchModel& model, Screen& screen, int row) {
  if (model.selected < 0 || model.selected >= static_cast<int>(model.joints.size())) return;
  const WatchedJoint& joint = model.joints[static_cast<std::size_t>(model.selected)];
  const state_v1& state = joint.view.state;
  int x = screen.put(row, 0, name_of(model, joint) + ": gains ", Style::kDim);
  x = screen.put(row, x, to_text(static_cast<GainsInUse>(state.gains_in_use)));
  x = screen.put(row, x, ", weights ", Style::kDim);
  for (int i = 0; i < std::clamp(state.rule_count, 0, 16); ++i)
    x = screen.put(row, x, bar(state.temperature_weights[i], model.unicode));
  x = screen.put(row, x, fmt::format(" (standstill {:.2f})", state.zero_velocity_weight));
  if (!joint.limits || !std::isfinite(state.joint_position_rad)) return;
  const double width_rad = joint.limits->position_max_rad - joint.limits->position_min_rad;
  if (!(width_rad > 0.0)) return;
  constexpr int kScale = 21;
  const double share = (state.joint_position_rad - joint.limits->position_min_rad) / width_rad;
  std::string scale(kScale, '-');
  scale[static_cast<std::size_t>(std::clamp(share * kScale, 0.0, kScale - 1.0))] = '|';
  screen.put(row, x,
             fmt::format(", {:+.2f} [{}] {:+.2f} rad, at most {:.0f} N.m", joint.limits->position_min_rad,
                         scale, joint.limits->position_max_rad, joint.limits->torque_Nm));
}

std::string keys(const WatchModel& model) {
  return std::string("s stop  S stop all  ") +
         (model.has_key ? "e enable  h hold  c clear fault  " : "(--key FILE for enable, hold, clear)  ") +
         "up/down select  q quit";
}

}  // namespace

std::string sparkline(const std::deque<double>& values, int width, bool unicode) {
  const std::size_t count = std::min(values.size(), static_cast<std::size_t>(std::max(0, width)));
  double largest = 0.0;
  for (std::size_t i = values.size() - count; i < values.size(); ++i)
    if (std::isfinite(values[i])) largest = std::max(largest, values[i]);
  std::string line;
  for (std::size_t i = values.size() - count; i < values.size(); ++i)
    line += std::isfinite(values[i]) ? bar(largest > 0.0 ? values[i] / largest : 0.0, unicode) : "?";
  return line;
}

Screen render(const WatchModel& model, int rows, int columns) {
  Screen screen(rows, columns);
  if (rows < 5 || columns < 30) {
    screen.put(0, 0, "terminal too small; s still stops", Style::kWarning);
    return screen;
  }
  screen.put(0, 0,
             fmt::format("strainwave  {} joints of {} daemons  {}", model.joints.size(), model.daemons.size(),
                         model.has_key ? "orders are signed" : "no key: only stop"),
             Style::kTitle);
  int row = 1;
  // A third of the screen at most: the joints matter more.
  const int daemon_rows = std::min(static_cast<int>(model.daemons.size()), std::max(1, rows / 3 - 1));
  for (int i = 0; i < daemon_rows && i < static_cast<int>(model.daemons.size()); ++i)
    draw_daemon(model.daemons[static_cast<std::size_t>(i)], screen, row++);
  const int below = rows >= 8 ? 3 : 2;  // selected joint, message, keys
  if (model.joints.empty()) screen.put(row, 0, "nothing heard yet", Style::kWarning);
  if (!model.joints.empty()) draw_joints(model, screen, row, rows - below - row);
  if (below == 3) draw_selected(model, screen, rows - 3);
  screen.put(rows - 2, 0, model.message, model.message_alarm ? Style::kAlarm : Style::kPlain);
  screen.put(rows - 1, 0, keys(model), Style::kDim);
  return screen;
}

}  // namespace strainwave
