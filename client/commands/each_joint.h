// SPDX-License-Identifier: BSD-3-Clause
// One order to several joints: each outcome is reported, and a failure of one does not stop the others. Not real-time.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "client/protocol/client.h"
#include "strainwave/client_error.h"

namespace strainwave {

/// `joints`, or when there are none every joint that is heard of the prefix. Throws NoAnswer when none is.
std::vector<std::string> joints_or_all(Client& client, const std::vector<std::string>& joints);

/// What went wrong with some of several joints, reported as one error.
class Failures {
 public:
  /// Whether `step`, an order to `joint`, ended without a ClientError. An interruption ends everything: it is thrown on, behind what had
  /// failed.
  bool attempt(const std::string& joint, const std::function<void()>& step);
  /// Throws what has failed, of several joints a line for each, with the status of the worst: no answer before a refusal.
  void rethrow() const;

 private:
  std::vector<ClientError> failures_;
};

}  // namespace strainwave
