// SPDX-License-Identifier: BSD-3-Clause
// The full-screen watch: receives states, draws them, and reacts to keys. Not real-time.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client/protocol/client.h"

namespace strainwave {

struct WatchArguments {
  std::vector<std::string> joints;  ///< empty: all joints heard
  double interval_s = 0.2;
  std::optional<double> duration_s;  ///< no value: until interrupted
  bool plain = false;                ///< lines instead of the full screen
};

/// Runs until q, an interrupt or the end of the duration. Needs a terminal.
void watch_screen(Client& client, const WatchArguments& arguments);

}  // namespace strainwave
