// SPDX-License-Identifier: BSD-3-Clause
// The exit status of all programs of Strainwave. The numbers are part of their interface (--help lists them); scripts rely on them.
#pragma once

namespace strainwave {

enum class ExitStatus : int {
  kDone = 0,
  kRefused = 1,       ///< the request was tried but failed: refused, not certified, faulted
  kUsage = 2,         ///< invalid input: the command line, or the content of a file
  kNoAnswer = 3,      ///< missing: a daemon, a joint, an acknowledgement in time, LCM on this PC
  kInterrupted = 130  ///< stopped by a signal while it waited (the shells' number for SIGINT)
};

}  // namespace strainwave
