// What watch shows, and how: a pure function from what is known to a screen. No terminal, no network, no
// clock. Not real-time.
#pragma once

#include <deque>
#include <optional>
#include <strainwave/limits_v1.hpp>
#include <strainwave/temperature_v1.hpp>
#include <strainwave/timing_v1.hpp>
#include <string>
#include <vector>

#include "client/link/state_view.h"
#include "client/watch/screen.h"

namespace strainwave {

struct WatchedJoint {
  std::string prefix;
  std::string joint;
  JointView view;
  double age_s = 0.0;             ///< of the state
  std::deque<double> errors_rad;  ///< |error| over time, the latest last
  std::deque<double> torques_Nm;  ///< |applied torque| over time
  std::optional<temperature_v1> temperature;
  std::optional<limits_v1> limits;
};

struct WatchedDaemon {
  std::string prefix;
  timing_v1 timing{};
  double age_s = 0.0;
};

struct WatchModel {
  std::vector<WatchedDaemon> daemons;
  std::vector<WatchedJoint> joints;
  int selected = 0;      ///< of `joints`
  bool has_key = false;  ///< orders can be signed
  bool unicode = true;   ///< the terminal shows more than ASCII
  std::string message;   ///< the latest answer or refusal
  bool message_alarm = false;
};

/// The whole screen. Columns that do not fit are left out, the most important ones stay; so do rows.
Screen render(const WatchModel& model, int rows, int columns);

/// `values` as bars, the latest last, scaled to the largest one; at most `width` of them.
std::string sparkline(const std::deque<double>& values, int width, bool unicode);

}  // namespace strainwave
