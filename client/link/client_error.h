// What can go wrong between a program and a joint: one type for each thing that a program may want to do about it. Not real-time.
#pragma once

#include <string>

#include "base/program_error.h"
#include "lcmtypes/vocabulary.h"

namespace strainwave {

/// Any of the following. what() is the whole sentence for the user: what was given, what is allowed or what the daemon answered,
/// what to do.
class ClientError : public ProgramError {
 public:
  using ProgramError::ProgramError;
};

/// Refused here, before anything was sent: a name, a number, a key file.
class InvalidInput : public ClientError {
 public:
  explicit InvalidInput(const std::string& message) : ClientError(ExitStatus::kUsage, message) {}
};

/// No daemon, no such joint, silence, or a network without multicast. Whether an order was carried out is not known.
class NoAnswer : public ClientError {
 public:
  explicit NoAnswer(const std::string& message) : ClientError(ExitStatus::kNoAnswer, message) {}
};

/// The daemon answered and refused.
class Refused : public ClientError {
 public:
  Refused(const std::string& message, Reason reason)
      : ClientError(ExitStatus::kRefused, message), reason_(reason) {}
  Reason reason() const noexcept { return reason_; }

 private:
  Reason reason_;
};

/// The joint has a latched fault.
class Faulted : public ClientError {
 public:
  Faulted(const std::string& message, Fault fault)
      : ClientError(ExitStatus::kRefused, message), fault_(fault) {}
  Fault fault() const noexcept { return fault_; }

 private:
  Fault fault_;
};

/// An order that was accepted did not come to its end: another replaced it, the joint was disabled, it holds elsewhere.
class NotDone : public ClientError {
 public:
  explicit NotDone(const std::string& message) : ClientError(ExitStatus::kRefused, message) {}
};

}  // namespace strainwave
