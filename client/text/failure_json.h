// SPDX-License-Identifier: BSD-3-Clause
// Why a command ended, as one JSON object for scripts, with the numbers by name. Not real-time.
//
//   error        refused, faulted, yielded, not done, wrong input, no answer, interrupted
//   exit_status  the program's
//   command      of the command line, if one was understood
//   joint        whose it is; or joints, all that the command line names
//   reason, reason_text, fault, fault_text   the daemon's, see docs/commands.md
//   yield_load_Nm, yield_limit_Nm, yield_position_rad   of a joint that yielded, as in its state
//   key, given, allowed   where the text has the form "key = given: ... allowed" (or "... is allowed"): its parts;
//                         of a path's knot the key is its limit's
//   knot         of a path, where one is named
//   failures     of several joints, one such object each
//   text         the sentence that people get
#pragma once

#include <string>
#include <vector>

#include "base/manual/command_line.h"

namespace strainwave {

/// What the command line says of whom it is about.
struct FailedCommand {
  std::string command;
  std::vector<std::string> joints;
};

/// One line without its end.
std::string to_json(const ProgramFailure& failure, const FailedCommand& command);

}  // namespace strainwave
