// SPDX-License-Identifier: BSD-3-Clause
// Draws the watch screen: a pure function from the known data to a screen. No terminal, no network, no clock.
// Not real-time.
#pragma once

#include <optional>
#include <strainwave/limits_v1.hpp>
#include <strainwave/temperature_v1.hpp>
#include <strainwave/timing_v1.hpp>
#include <string>
#include <vector>

#include "client/protocol/state_view.h"
#include "client/watch/history.h"
#include "client/watch/screen.h"

namespace strainwave {

struct WatchedJoint {
  std::string prefix;
  std::string joint;
  JointView view;
  double age_s = 0.0;  ///< age of the state
  WatchHistory history;
  std::optional<temperature_v1> temperature;
  std::optional<limits_v1> limits;
};

struct WatchedDaemon {
  std::string prefix;
  timing_v1 timing{};
  double age_s = 0.0;
};

/// The outcome of an order.
struct WatchNotice {
  std::string text;
  double age_s = 0.0;
};

struct WatchModel {
  std::vector<WatchedDaemon> daemons;
  std::vector<WatchedJoint> joints;
  int selected = 0;         ///< index into `joints`
  bool has_key = false;     ///< commands are signed
  bool unicode = true;      ///< the terminal shows more than ASCII
  bool help = false;        ///< show the keys and their meaning instead of the joints
  double interval_s = 0.2;  ///< time between two points of a history
  double jog_rad = 0.01;    ///< step of the jog keys
  std::string message;      ///< the latest answer or refusal
  bool message_alarm = false;
  std::vector<WatchNotice> refusals;  ///< refusals of orders from this screen, the latest first
};

/// Draws the whole screen. On a small terminal, less important columns and rows are left out.
Screen render(const WatchModel& model, int rows, int columns);

/// "elbow", or "SW.elbow" when there are several daemons.
std::string name_of(const WatchModel& model, const WatchedJoint& joint);

/// Alarm: it has faulted, is silent, or two daemons use its channels. Warning: the state has a notice, or its temperature is not valid.
Style style_of(const WatchedJoint& joint);

/// Which sensor gives the temperature that schedules the gains.
std::string temperature_source(const WatchedJoint& joint);

}  // namespace strainwave
