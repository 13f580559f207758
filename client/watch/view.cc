#include "client/watch/view.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "client/text/text.h"
#include "client/watch/joint_detail.h"
#include "client/watch/plot.h"
#include "lcmtypes/vocabulary.h"

namespace strainwave {

namespace {

constexpr double kDaemonSilence_s = 3.0;  // TIMING comes once a second
constexpr int kSparkWidth = 12;
constexpr int kNotesWidth = 17;   // room for notes before the least important column
constexpr int kLeastDetail = 10;  // rows below the joints that are worth drawing

Mode mode_of(const WatchedJoint& joint) {
  return static_cast<Mode>(joint.view.state.mode);
}

/// One column of the table of joints.
struct Column {
  std::string_view title;
  int width;
  int rank;  ///< higher ones go first when the terminal is narrow
  std::string (*cell)(const WatchModel&, const WatchedJoint&);
};

const std::array<Column, 10> kColumns{{
    {"joint", 12, 0, [](const WatchModel& m, const WatchedJoint& j) { return name_of(m, j); }},
    {"mode", 8, 0, [](const WatchModel&, const WatchedJoint& j) { return std::string(to_text(mode_of(j))); }},
    {"setpoint_rad", 12, 6,
     [](const WatchModel&, const WatchedJoint& j) {
       return fmt::format("{:+12.6f}", j.view.state.setpoint_position_rad);
     }},
    {"position_rad", 12, 1,
     [](const WatchModel&, const WatchedJoint& j) {
       return fmt::format("{:+12.6f}", j.view.state.joint_position_rad);
     }},
    {"error_rad", 9, 2,
     [](const WatchModel&, const WatchedJoint& j) {
       return fmt::format("{:+9.1e}", tracking_error_rad(j.view));
     }},
    {"torque_Nm", 9, 3,
     [](const WatchModel&, const WatchedJoint& j) {
       return fmt::format("{:+9.3f}", j.view.state.torque_applied_Nm);
     }},
    {"temp_C", 6, 4,
     [](const WatchModel&, const WatchedJoint& j) {
       return fmt::format("{:>6}", temperature_text(j.view.state.temperature_used_C));
     }},
    {"from", 14, 9, [](const WatchModel&, const WatchedJoint& j) { return temperature_source(j); }},
    {"error", kSparkWidth, 7,
     [](const WatchModel& m, const WatchedJoint& j) {
       return sparkline(j.history.error_rad, kSparkWidth, plot_spans(j).error_rad, m.unicode);
     }},
    {"torque", kSparkWidth, 8,
     [](const WatchModel& m, const WatchedJoint& j) {
       return sparkline(j.history.torque_Nm, kSparkWidth, plot_spans(j).torque_Nm, m.unicode);
     }},
}};

std::vector<const Column*> fitting_columns(int columns) {
  std::vector<const Column*> chosen;
  chosen.reserve(kColumns.size());
  for (const Column& column : kColumns) chosen.push_back(&column);
  const auto width = [&] {
    int sum = 1;
    for (const Column* column : chosen) sum += column->width + 1;
    return sum;
  };
  while (chosen.size() > 2 && width() + (chosen.size() > 5 ? kNotesWidth : 0) > columns)
    chosen.erase(
        std::max_element(chosen.begin(), chosen.end(), [](auto* a, auto* b) { return a->rank < b->rank; }));
  return chosen;
}

void draw_joint(const WatchModel& model, const WatchedJoint& joint, bool selected,
                const std::vector<const Column*>& columns, Screen& screen, int row) {
  const Style style = style_of(joint);
  screen.put(row, 0, selected ? ">" : " ", Style::kTitle);
  int x = 1;
  for (const Column* column : columns) {
    const std::string text = clipped(column->cell(model, joint), static_cast<std::size_t>(column->width));
    const bool name = column == columns.front();
    screen.put(row, x, name ? fmt::format("{:<{}}", text, column->width) : text, style, selected && name);
    x += column->width + 1;
  }
  screen.put(row, x, state_notes(joint.view, joint.age_s), style);
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
  const int joints = static_cast<int>(model.joints.size());
  const int skip = std::clamp(model.selected - shown + 1, 0, std::max(0, joints - shown));
  for (int i = 0; i < shown && skip + i < joints; ++i)
    draw_joint(model, *std::next(model.joints.begin(), skip + i), skip + i == model.selected, columns, screen,
               first + 1 + i);
}

void draw_daemon(const WatchedDaemon& daemon, Screen& screen, int row) {
  const timing_v1& timing = daemon.timing;
  std::int64_t refused = 0;
  for (const std::int64_t count : timing.rejects) refused += count;
  const bool silent = daemon.age_s > kDaemonSilence_s;
  const std::string text =
      fmt::format("{}: {}{} at {:g} ms, {} overruns, wake-up {:.0f} us, execution {:.0f} us, {} refused",
                  daemon.prefix, silent ? fmt::format("SILENT for {:.0f} s, ", daemon.age_s) : "",
                  timing.real_time == 1 ? "real time" : "not real time", 1e3 * timing.period_s,
                  timing.overruns, static_cast<double>(timing.wakeup_latency_max_ns) * 1e-3,
                  static_cast<double>(timing.execution_time_max_ns) * 1e-3, refused);
  screen.put(row, 0, text, silent ? Style::kAlarm : Style::kPlain);
}

/// The keys, the most important first, as many as fit.
std::string keys(const WatchModel& model, int columns) {
  const std::array<std::string, 9> all{
      "s stop",        "S stop all", "? help",  "q quit",
      "e enable",      "h hold",     "c clear", fmt::format("[ ] jog {:g} rad", model.jog_rad),
      "up/down select"};
  std::string line;
  for (const std::string& key : all)
    if (static_cast<int>(line.size() + key.size()) + 2 <= columns) line += (line.empty() ? "" : "  ") + key;
  return line;
}

constexpr std::array<std::string_view, 21> kHelp{
    "up, down     select a joint",
    "s            stop the selected joint: needs no key and no session",
    "S            stop every joint that is shown",
    "e            enable: the joint holds where it is",
    "h            hold: stop within the limits and stay enabled",
    "c            clear a fault; the joint stays off",
    "] [          jog: move the target by one step, up or down",
    "+ -          a larger or smaller step",
    "?            this help, and back",
    "q, Ctrl-C    end; joints go on as they are",
    "",
    "error_rad    setpoint - position, at the instant when the position was measured",
    "torque_Nm    as the drive reports it",
    "temp_C       what schedules the gains; 'from' says where it comes from",
    "notes        faults, and limits in force; docs/faults.md explains each",
    "rules        weight of each temperature rule, cold to warm",
    "rejects      orders that the daemon refused, of anybody, by reason",
    "",
    "white on red: fault, silence, or two daemons on the same channels",
    "black on amber: a limit is in force, or an order was refused",
    "orders are signed with --key FILE; without it, a daemon may refuse them",
};

void draw_help(Screen& screen, int first, int end) {
  for (std::size_t i = 0; i < kHelp.size() && first + static_cast<int>(i) < end; ++i)
    screen.put(first + static_cast<int>(i), 1, kHelp[i]);
}

void draw_body(const WatchModel& model, Screen& screen, int first, int end) {
  if (model.help) return draw_help(screen, first, end);
  if (model.joints.empty()) {
    screen.put(first, 0, "nothing heard yet", Style::kWarning);
    return;
  }
  const int rows = end - first;
  const int wanted = static_cast<int>(model.joints.size()) + 1;
  // Half of the screen for the joints at most, if the other half can show something.
  const int table = rows >= 2 * kLeastDetail ? std::min(wanted, rows / 2)
                                             : std::min(wanted, std::max(2, rows - kLeastDetail));
  draw_joints(model, screen, first, table);
  if (model.selected >= 0 && model.selected < static_cast<int>(model.joints.size()))
    draw_detail(model, model.joints[static_cast<std::size_t>(model.selected)], screen, first + table + 1,
                end);
}

/// "1 joint", "2 joints".
std::string counted(std::size_t number, std::string_view thing) {
  return fmt::format("{} {}{}", number, thing, number == 1 ? "" : "s");
}

}  // namespace

std::string name_of(const WatchModel& model, const WatchedJoint& joint) {
  const bool several = std::any_of(model.joints.begin(), model.joints.end(),
                                   [&](const WatchedJoint& other) { return other.prefix != joint.prefix; });
  return several ? joint.prefix + "." + joint.joint : joint.joint;
}

Style style_of(const WatchedJoint& joint) {
  if (mode_of(joint) == Mode::kFaulted || joint.age_s > kStateSilence_s || joint.view.two_daemons)
    return Style::kAlarm;
  if (joint.view.state.notices != 0 || joint.view.state.temperature_status != 0) return Style::kWarning;
  return mode_of(joint) == Mode::kOff ? Style::kDim : Style::kGood;
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
  screen.put(0, 0,
             fmt::format("strainwave  {} of {}  {}", counted(model.joints.size(), "joint"),
                         counted(model.daemons.size(), "daemon"),
                         model.has_key ? "orders are signed" : "orders are not signed"),
             Style::kTitle);
  int row = 1;
  // A third of the screen at most: the joints matter more.
  const int daemon_rows = std::min(static_cast<int>(model.daemons.size()), std::max(1, rows / 3 - 1));
  for (int i = 0; i < daemon_rows; ++i)
    draw_daemon(model.daemons[static_cast<std::size_t>(i)], screen, row++);
  // As long as the daemon's reasons are; a sixth of the screen at most.
  const std::vector<std::string> message = wrapped(model.message, static_cast<std::size_t>(columns),
                                                   static_cast<std::size_t>(std::max(1, rows / 6)));
  const int end = rows - 1 - static_cast<int>(message.size());
  draw_body(model, screen, row, end);
  for (std::size_t i = 0; i < message.size(); ++i)
    screen.put(end + static_cast<int>(i), 0, message[i], model.message_alarm ? Style::kAlarm : Style::kPlain);
  screen.put(rows - 1, 0, keys(model, columns), Style::kDim);
  return screen;
}

}  // namespace strainwave
