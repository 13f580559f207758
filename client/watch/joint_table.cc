// SPDX-License-Identifier: BSD-3-Clause
#include "client/watch/joint_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "client/protocol/orders.h"
#include "client/text/text.h"
#include "client/watch/joint_detail.h"
#include "client/watch/plot.h"
#include "strainwave/vocabulary.h"

namespace strainwave {

namespace {

constexpr int kSparkWidth = 12;
constexpr int kNotesWidth = 17;  // width of the notes, which displace less important columns
constexpr int kNameWidth = 12;   // width of a column of short names

/// One column of the table of joints.
struct Column {
  std::string_view title;
  int width;
  int rank;  ///< on a narrow terminal the highest ranks are removed first
  std::string (*cell)(const WatchModel&, const WatchedJoint&);
};

const std::array<Column, 10> kColumns{{
    {"joint", kNameWidth, 0, [](const WatchModel& m, const WatchedJoint& j) { return name_of(m, j); }},
    {"mode", 8, 0,
     [](const WatchModel&, const WatchedJoint& j) { return std::string(to_text(mode_of(j.view))); }},
    {"setpoint_rad", 12, 6,
     [](const WatchModel&, const WatchedJoint& j) {
       return fmt::format("{:+12.6f}", without_negative_zero(j.view.state.setpoint_position_rad, 6));
     }},
    {"position_rad", 12, 1,
     [](const WatchModel&, const WatchedJoint& j) {
       return fmt::format("{:+12.6f}", without_negative_zero(j.view.state.joint_position_rad, 6));
     }},
    {"error_rad", 9, 2,
     [](const WatchModel&, const WatchedJoint& j) {
       return fmt::format("{:+9.1e}", tracking_error_rad(j.view));
     }},
    {"torque_Nm", 9, 3,
     [](const WatchModel&, const WatchedJoint& j) {
       return fmt::format("{:+9.3f}", without_negative_zero(j.view.state.torque_applied_Nm, 3));
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

/// Wide enough to distinguish long names, but at most half of the screen.
int name_width(const WatchModel& model, int columns) {
  std::size_t longest = kNameWidth;
  for (const WatchedJoint& joint : model.joints) longest = std::max(longest, name_of(model, joint).size());
  return std::min(static_cast<int>(longest), std::max(kNameWidth, columns / 2));
}

std::vector<Column> fitting_columns(const WatchModel& model, int columns) {
  std::vector<Column> chosen(kColumns.begin(), kColumns.end());
  chosen.front().width = name_width(model, columns);
  const auto width = [&] {
    int sum = 1;
    for (const Column& column : chosen) sum += column.width + 1;
    return sum;
  };
  while (chosen.size() > 2 && width() + (chosen.size() > 5 ? kNotesWidth : 0) > columns)
    chosen.erase(
        std::ranges::max_element(chosen, [](const Column& a, const Column& b) { return a.rank < b.rank; }));
  return chosen;
}

/// The beginning and the end of a name that is too long.
std::string elided(const std::string& name, std::size_t width) {
  if (name.size() <= width || width < 4) return name.substr(0, width);
  const std::size_t end = (width - 2) / 2;
  return name.substr(0, width - 2 - end) + ".." + name.substr(name.size() - end);
}

void draw_joint(const WatchModel& model, const WatchedJoint& joint, bool selected,
                const std::vector<Column>& columns, Screen& screen, int row) {
  const Style style = style_of(joint);
  screen.put(row, 0, selected ? ">" : " ", Style::kTitle);
  int x = 1;
  for (const Column& column : columns) {
    const auto width = static_cast<std::size_t>(column.width);
    const bool name = &column == &columns.front();
    const std::string text = column.cell(model, joint);
    screen.put(row, x, name ? fmt::format("{:<{}}", elided(text, width), width) : clipped(text, width), style,
               selected && name);
    x += column.width + 1;
  }
  screen.put_fitting(row, x, state_notes(joint.view, joint.age_s), style);
}

}  // namespace

void draw_joints(const WatchModel& model, Screen& screen, int first, int count) {
  const std::vector<Column> columns = fitting_columns(model, screen.columns());
  int x = 1;
  for (const Column& column : columns) {
    screen.put(first, x, column.title, Style::kDim);
    x += column.width + 1;
  }
  screen.put(first, x, "notes", Style::kDim);
  const int shown = std::max(0, count - 1);
  const int joints = static_cast<int>(model.joints.size());
  const int skip = std::clamp(model.selected - shown + 1, 0, std::max(0, joints - shown));
  for (int i = 0; i < shown && skip + i < joints; ++i)
    draw_joint(model, *std::next(model.joints.begin(), skip + i), skip + i == model.selected, columns, screen,
               first + 1 + i);
}

}  // namespace strainwave
