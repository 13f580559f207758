// The full-screen watch: listens, draws, obeys keys. Not real-time.
#pragma once

#include "client/commands/commands.h"

namespace strainwave {

/// Until q, an interrupt or the arguments' duration. Needs a terminal.
void watch_screen(Client& client, const WatchArguments& arguments);

}  // namespace strainwave
