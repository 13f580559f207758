// SPDX-License-Identifier: BSD-3-Clause
// One order to several joints: each outcome is reported, and a failure of one does not stop the others. Not real-time.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "client/protocol/client.h"
#include "strainwave/client_error.h"

namespace strainwave {

/// Returns `joints`, or if empty every joint heard of the prefix. Throws NoAnswer when no joint is heard.
std::vector<std::string> joints_or_all(Client& client, const std::vector<std::string>& joints);

/// The failures of an order to several joints, reported as one error.
class Failures {
 public:
  /// Runs `step`, an order to `joint`, and returns whether it ended without a ClientError. An interruption
  /// ends everything: it is thrown at once, listed after the earlier failures.
  bool attempt(const std::string& joint, const std::function<void()>& step);
  /// Throws the failures, if any: a line for each joint, with the largest exit status: kNoAnswer outranks kRefused.
  void rethrow() const;

 private:
  std::vector<ClientError> failures_;
};

}  // namespace strainwave
