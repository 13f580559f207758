// SPDX-License-Identifier: BSD-3-Clause
// Errors between a program and a joint: one type for each reaction that a program may need. Not real-time.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "strainwave/program_error.h"
#include "strainwave/vocabulary.h"

namespace strainwave {

/// The load to which a joint yielded (docs/faults.md, "Contact"), joint side.
struct YieldedTo {
  double load_Nm = 0.0;       ///< > 0 pushes towards negative positions
  double limit_Nm = 0.0;      ///< load that was allowed
  double position_rad = 0.0;  ///< position of the joint
};

/// Base of all following errors. what() is a complete sentence for the user: the input, what is allowed or what the daemon
/// answered, and the remedy.
class ClientError : public ProgramError {
 public:
  /// Details for a program. An empty or missing value is unknown, or does not apply.
  struct Details {
    std::string joint;
    std::optional<Reason> reason;   ///< why the daemon refused
    std::optional<Fault> fault;     ///< fault of the joint
    std::vector<ClientError> each;  ///< one error per joint; all other details are of the first
    std::optional<YieldedTo> yielded_to;
  };
  ClientError(ExitStatus status, const std::string& message, Details details = {})
      : ProgramError(status, message), details_(std::move(details)) {}
  const Details& details() const noexcept { return details_; }
  /// Returns the same error with another message.
  ClientError in_words(const std::string& message) const { return {status(), message, details_}; }
  /// Returns the same error, of `joint` if it names no joint yet.
  ClientError of(const std::string& joint) const {
    Details details = details_;
    if (details.joint.empty() && details.each.empty()) details.joint = joint;
    return {status(), what(), std::move(details)};
  }

 private:
  Details details_;
};

/// The client refused a name, a number or a key file before it sent anything.
class InvalidInput : public ClientError {
 public:
  explicit InvalidInput(const std::string& message, const std::string& joint = "")
      : ClientError(ExitStatus::kUsage, message, {joint, {}, {}, {}, {}}) {}
};

/// No daemon, no such joint, silence, or a network without multicast. It is not known whether an order was carried out.
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

/// The joint has a latched fault. `each`: for several joints, the error that stopped each, a Faulted or a Yielded.
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

/// The joint yielded to a load, which ended its motion. It has no fault, and holds as soon as it rests. `each`: one error per joint.
class Yielded : public NotDone {
 public:
  Yielded(const std::string& message, const std::string& joint, const YieldedTo& to,
          std::vector<ClientError> each = {})
      : NotDone(message, Details{joint, {}, {}, std::move(each), to}) {}
  const YieldedTo& to() const noexcept { return *details().yielded_to; }
};

}  // namespace strainwave
