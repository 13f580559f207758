// SPDX-License-Identifier: BSD-3-Clause
// The failure of a command as one JSON object for scripts, with named numbers. Not real-time.
//
//   error        refused, faulted, yielded, not done, wrong input, no answer, interrupted
//   exit_status  exit status of the program
//   command      the command, if one was understood
//   joint        the failed joint; or joints, all that the command line names
//   reason, reason_text, fault, fault_text   from the daemon, see docs/commands.md
//   yield_load_Nm, yield_limit_Nm, yield_position_rad   of a joint that yielded, as in its state
//   key, given, allowed   the parts of a text "key = given: ... allowed" (or "... is allowed");
//                         for a knot of a path, key is the name of its limit
//   knot         number of a path's knot, if the text names one
//   failures     for several joints: one such object each
//   text         the error message for people
#pragma once

#include <string>
#include <vector>

#include "base/manual/command_line.h"

namespace strainwave {

/// The command and the joints that the command line names.
struct FailedCommand {
  std::string command;
  std::vector<std::string> joints;
};

/// One line, without a newline.
std::string to_json(const ProgramFailure& failure, const FailedCommand& command);

}  // namespace strainwave
