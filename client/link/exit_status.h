// How strainwavectl ends. The numbers are part of its interface (--help lists them); scripts rely on them.
#pragma once

#include <stdexcept>
#include <string>

namespace strainwave {

enum class ExitStatus : int {
  kDone = 0,
  kRefused = 1,  ///< the daemon refused, or the joint faulted or was stopped before the order was carried out
  kUsage = 2,    ///< the command line makes no sense
  kNoAnswer = 3,        ///< no daemon, no such joint, or no acknowledgement in time
  kFile = 4,            ///< a file cannot be read or written, or its content is wrong
  kLcmUnavailable = 5,  ///< LCM cannot be used on this PC as it is set up
  kInterrupted = 130,   ///< stopped by a signal while it waited (the shells' number for SIGINT)
};

/// A command that could not be done; what() is the whole sentence for the user and says what to do.
class ClientError : public std::runtime_error {
 public:
  ClientError(ExitStatus status, const std::string& message) : std::runtime_error(message), status_(status) {}
  ExitStatus status() const noexcept { return status_; }

 private:
  ExitStatus status_;
};

}  // namespace strainwave
