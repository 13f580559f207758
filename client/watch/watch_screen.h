// SPDX-License-Identifier: BSD-3-Clause
// The full-screen watch: listens, draws, obeys keys. Not real-time.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client/protocol/client.h"

namespace strainwave {

struct WatchArguments {
  std::vector<std::string> joints;  ///< empty: all that are heard
  double interval_s = 0.2;
  std::optional<double> duration_s;  ///< nothing: until interrupted
  bool plain = false;                ///< lines instead of the full screen
};

/// Until q, an interrupt or the arguments' duration. Needs a terminal.
void watch_screen(Client& client, const WatchArguments& arguments);

}  // namespace strainwave
