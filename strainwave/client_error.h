// SPDX-License-Identifier: BSD-3-Clause
// What can go wrong between a program and a joint: one type for each thing that a program may want to do about it. Not real-time.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "strainwave/program_error.h"
#include "strainwave/vocabulary.h"

namespace strainwave {

/// What made a joint let go (docs/faults.md, "Contact"), joint side.
struct YieldedTo {
  double load_Nm = 0.0;       ///< > 0 pushes towards negative positions
  double limit_Nm = 0.0;      ///< what load was allowed
  double position_rad = 0.0;  ///< where the joint was
};

/// Any of the following. what() is the whole sentence for the user: what was given, what is allowed or what the daemon answered,
/// what to do.
class ClientError : public ProgramError {
 public:
  /// As a program needs it. Empty, or nothing: not known, or of none.
  struct Details {
    std::string joint;
    std::optional<Reason> reason;   ///< why the daemon refused
    std::optional<Fault> fault;     ///< that the joint has
    std::vector<ClientError> each;  ///< what went wrong with each of several joints; all else is of the first
    std::optional<YieldedTo> yielded_to;
  };
  ClientError(ExitStatus status, const std::string& message, Details details = {})
      : ProgramError(status, message), details_(std::move(details)) {}
  const Details& details() const noexcept { return details_; }
  /// The same in other words.
  ClientError in_words(const std::string& message) const { return {status(), message, details_}; }
  /// The same of `joint`, if it is not known yet whose it is.
  ClientError of(const std::string& joint) const {
    Details details = details_;
    if (details.joint.empty() && details.each.empty()) details.joint = joint;
    return {status(), what(), std::move(details)};
  }

 private:
  Details details_;
};

/// Refused here, before anything was sent: a name, a number, a key file.
class InvalidInput : public ClientError {
 public:
  explicit InvalidInput(const std::string& message, const std::string& joint = "")
      : ClientError(ExitStatus::kUsage, message, {joint, {}, {}, {}, {}}) {}
};

/// No daemon, no such joint, silence, or a network without multicast. Whether an order was carried out is not known.
class NoAnswer : public ClientError {
 public:
  explicit NoAnswer(const std::string& message, const std::string& joint = "")
      : ClientError(ExitStatus::kNoAnswer, message, {joint, {}, {}, {}, {}}) {}
};

/// The daemon answered and refused.
class Refused : public ClientError {
 public:
  Refused(const std::string& message, const std::string& joint, Reason reason)
      : ClientError(ExitStatus::kRefused, message, {joint, reason, {}, {}, {}}) {}
  Reason reason() const noexcept { return *details().reason; }
};

/// The joint has a latched fault. `each`: of several joints what stopped each, a Faulted or a Yielded.
class Faulted : public ClientError {
 public:
  Faulted(const std::string& message, const std::string& joint, Fault fault,
          std::vector<ClientError> each = {})
      : ClientError(ExitStatus::kRefused, message, {joint, {}, fault, std::move(each), {}}) {}
  Fault fault() const noexcept { return *details().fault; }
};

/// An order that was accepted did not come to its end: another replaced it, the joint was disabled, it holds elsewhere.
class NotDone : public ClientError {
 public:
  explicit NotDone(const std::string& message, const std::string& joint = "")
      : ClientError(ExitStatus::kRefused, message, {joint, {}, {}, {}, {}}) {}

 protected:
  NotDone(const std::string& message, Details details)
      : ClientError(ExitStatus::kRefused, message, std::move(details)) {}
};

/// The joint yielded to a load, which ended its motion; it has no fault, and holds as soon as it rests. `each`: of several joints that did.
class Yielded : public NotDone {
 public:
  Yielded(const std::string& message, const std::string& joint, const YieldedTo& to,
          std::vector<ClientError> each = {})
      : NotDone(message, Details{joint, {}, {}, std::move(each), to}) {}
  const YieldedTo& to() const noexcept { return *details().yielded_to; }
};

}  // namespace strainwave
