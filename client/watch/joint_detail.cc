// SPDX-License-Identifier: BSD-3-Clause
#include "client/watch/joint_detail.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "client/protocol/orders.h"
#include "client/protocol/plain_zero.h"
#include "client/text/text.h"
#include "client/watch/plot.h"
#include "strainwave/vocabulary.h"

namespace strainwave {

namespace {

constexpr int kLabelWidth = 13;
constexpr int kLeastPlotHeight = 3;
constexpr int kTwoPlotsAbreast = 100;  // columns
constexpr std::size_t kRefusalsShown = 3;
constexpr std::size_t kLatestRefusal = 5;  // lines for the longest reason of the daemon, in 80 columns
constexpr std::size_t kOlderRefusals = 1;

/// Writes lines from top to bottom while there is room.
class Lines {
 public:
  Lines(Screen& screen, int first, int end) : screen_(screen), row_(first), end_(end) {}
  int row() const { return row_; }

  /// Breaks the text at spaces, into at most `most` lines. Further lines are aligned with the text, not with `label`.
  void put(std::string_view label, const std::string& text, Style style = Style::kPlain,
           std::size_t most = 3) {
    constexpr int kIndent = 9;
    const auto room = static_cast<std::size_t>(std::max(10, screen_.columns() - kIndent));
    for (const std::string& line : wrapped(text, room, most)) {
      if (row_ >= end_) return;
      screen_.put(row_, 0, label, Style::kDim);
      screen_.put(row_++, kIndent, line, style);
      label = "";
    }
  }

 private:
  Screen& screen_;
  int row_;
  int end_;
};

std::string position_scale(const WatchedJoint& joint) {
  const limits_v1& limits = *joint.limits;
  const double width_rad = limits.position_max_rad - limits.position_min_rad;
  const double share = (joint.view.state.joint_position_rad - limits.position_min_rad) / width_rad;
  if (!(width_rad > 0.0) || !std::isfinite(share)) return "";
  constexpr int kScale = 21;
  std::string scale(kScale, '-');
  scale[static_cast<std::size_t>(std::clamp(share * kScale, 0.0, kScale - 1.0))] = '|';
  return fmt::format("{:+.2f} [{}] {:+.2f} rad, ", without_negative_zero(limits.position_min_rad, 2), scale,
                     without_negative_zero(limits.position_max_rad, 2));
}

std::string limits_text(const WatchedJoint& joint) {
  const limits_v1& limits = *joint.limits;
  return position_scale(joint) +
         fmt::format("speed {:.3g} rad/s, torque {:.3g} N.m, following error {:.3g} rad, {:.3g} degC",
                     limits.speed_limit_rad_s, limits.torque_limit_Nm, limits.following_error_rad,
                     limits.temperature_limit_C);
}

std::string gains_text(const WatchModel& model, const WatchedJoint& joint) {
  const state_v1& state = joint.view.state;
  std::deque<double> weights;
  for (int i = 0; i < std::clamp(state.rule_count, 0, 16); ++i)
    weights.push_back(state.temperature_weights[i]);
  return fmt::format(
      "rules {}, standstill {:.2f}; {}",
      sparkline(weights, static_cast<int>(weights.size()), 1.0, model.unicode), state.zero_velocity_weight,
      std::isnan(state.temperature_used_C)
          ? "temperature " + temperature_source(joint)
          : fmt::format("temperature {} degC from {}", temperature_text(state.temperature_used_C),
                        temperature_source(joint)));
}

/// The orders that the daemon has refused since its start, from any client.
std::string rejects_text(const WatchModel& model, const WatchedJoint& joint) {
  std::string text;
  for (const WatchedDaemon& daemon : model.daemons) {
    if (daemon.prefix != joint.prefix) continue;
    for (int reason = 1; reason < kReasonCount; ++reason)
      if (daemon.timing.rejects[reason] > 0)
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", daemon.timing.rejects[reason],
                            to_text(static_cast<Reason>(reason)));
  }
  return text;
}

void put_text(const WatchModel& model, const WatchedJoint& joint, Lines& lines) {
  const state_v1& state = joint.view.state;
  lines.put("joint", fmt::format("{} {}, target {:+.6f} rad, setpoint {:+.6f} rad, speed {:+.4f} rad/s",
                                 name_of(model, joint), to_text(mode_of(joint.view)),
                                 without_negative_zero(state.target_position_rad, 6),
                                 without_negative_zero(state.setpoint_position_rad, 6),
                                 without_negative_zero(state.joint_velocity_rad_s, 4)));
  if (const std::string notes = state_notes(joint.view, joint.age_s); !notes.empty())
    lines.put("notes", notes, style_of(joint));
  for (std::size_t i = 0; i < std::min(kRefusalsShown, model.refusals.size()); ++i)
    lines.put(i == 0 ? "refused" : "",
              fmt::format("{:.0f} s ago: {}", model.refusals[i].age_s, model.refusals[i].text),
              Style::kWarning, i == 0 ? kLatestRefusal : kOlderRefusals);
  if (joint.limits) lines.put("limits", limits_text(joint));
  lines.put("gains", gains_text(model, joint));
  if (const std::string rejects = rejects_text(model, joint); !rejects.empty())
    lines.put("rejects", rejects + " (since the daemon's start, from all clients)");
}

struct Curve {
  const char* name;
  const std::deque<double>* values;
  double least_span;
  bool with_zero;
  std::optional<int> decimals;  ///< no value: two digits and an exponent
};

std::string scale_text(const Curve& curve, double value) {
  return curve.decimals
             ? fmt::format("{:>+11.{}f}", without_negative_zero(value, *curve.decimals), *curve.decimals)
             : fmt::format("{:>+11.1e}", plain_zero(value));
}

void draw_plot(const Curve& curve, bool unicode, Screen& screen, int row, int column, int width, int height) {
  const int room = width - kLabelWidth;
  const PlotScale scale =
      scale_of(*curve.values, plot_capacity(room, unicode), curve.least_span, curve.with_zero);
  screen.put(row, column, scale_text(curve, scale.high), Style::kDim);
  screen.put(row + height / 2, column, curve.name, Style::kTitle);
  screen.put(row + height - 1, column, scale_text(curve, scale.low), Style::kDim);
  const std::vector<std::string> lines = plot(*curve.values, scale, room, height, unicode);
  for (int i = 0; i < height; ++i) {
    screen.put(row + i, column + kLabelWidth - 1, unicode ? "│" : "|", Style::kDim);
    screen.put(row + i, column + kLabelWidth, lines[static_cast<std::size_t>(i)], Style::kGood);
  }
}

void draw_plots(const WatchModel& model, const WatchedJoint& joint, Screen& screen, int first, int end) {
  const PlotSpans spans = plot_spans(joint);
  const std::array<Curve, 4> curves{{
      {"error_rad", &joint.history.error_rad, spans.error_rad, true, std::nullopt},
      {"torque_Nm", &joint.history.torque_Nm, spans.torque_Nm, true, 2},
      {"position_rad", &joint.history.position_rad, spans.position_rad, false, 5},
      {"temp_C", &joint.history.temperature_C, spans.temperature_C, false, 1},
  }};
  const int abreast = screen.columns() >= kTwoPlotsAbreast ? 2 : 1;
  const int width = (screen.columns() - (abreast - 1)) / abreast;
  // One row is for the label of the time axis.
  const int rows = end - first - 1;
  const int stacked = std::min(static_cast<int>(curves.size()) / abreast, rows / kLeastPlotHeight);
  if (stacked < 1 || width < kLabelWidth + 10) return;
  const double span_s =
      static_cast<double>(plot_capacity(width - kLabelWidth, model.unicode)) * model.interval_s;
  screen.put(first, 0, fmt::format("the last {:.0f} s, now at the right", span_s), Style::kDim);
  const int height = rows / stacked;
  for (int i = 0; i < stacked * abreast; ++i)
    draw_plot(curves[static_cast<std::size_t>(i)], model.unicode, screen, first + 1 + (i / abreast) * height,
              (i % abreast) * (width + 1), width, height);
}

}  // namespace

PlotSpans plot_spans(const WatchedJoint& joint) {
  PlotSpans spans;
  if (!joint.limits) return spans;
  const limits_v1& limits = *joint.limits;
  // Shares of the limits that an operator regards as negligible.
  if (limits.following_error_rad > 0.0) spans.error_rad = 0.01 * limits.following_error_rad;
  if (limits.torque_limit_Nm > 0.0) spans.torque_Nm = 0.1 * limits.torque_limit_Nm;
  if (limits.position_max_rad > limits.position_min_rad)
    spans.position_rad = 1e-3 * (limits.position_max_rad - limits.position_min_rad);
  return spans;
}

void draw_detail(const WatchModel& model, const WatchedJoint& joint, Screen& screen, int first, int end) {
  Lines lines(screen, first, end);
  put_text(model, joint, lines);
  draw_plots(model, joint, screen, lines.row(), end);
}

}  // namespace strainwave
