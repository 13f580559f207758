// SPDX-License-Identifier: BSD-3-Clause
// How every program of ours ends. The numbers are part of their interface (--help lists them); scripts rely on them.
#pragma once

namespace strainwave {

enum class ExitStatus : int {
  kDone = 0,
  kRefused = 1,  ///< what was asked for was tried and did not come about: refused, not certified, faulted
  kUsage = 2,    ///< what was given makes no sense: the command line, or the content of a file
  kNoAnswer =
      3,  ///< what is needed is not there: a daemon, a joint, an acknowledgement in time, LCM on this PC
  kInterrupted = 130  ///< stopped by a signal while it waited (the shells' number for SIGINT)
};

}  // namespace strainwave
