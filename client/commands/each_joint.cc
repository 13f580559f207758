// SPDX-License-Identifier: BSD-3-Clause
#include "client/commands/each_joint.h"

#include <algorithm>

#include "client/protocol/orders.h"

namespace strainwave {

std::vector<std::string> joints_or_all(Client& client, const std::vector<std::string>& joints) {
  return joints.empty() ? client.wait_for_joints() : joints;
}

bool Failures::attempt(const std::string& joint, const std::function<void()>& step) {
  try {
    step();
    return true;
  } catch (const ClientError& error) {
    failures_.push_back(error.of(joint));
    if (error.status() == ExitStatus::kInterrupted) rethrow();
    return false;
  }
}

void Failures::rethrow() const {
  if (failures_.empty()) return;
  if (failures_.size() == 1) throw ClientError(failures_.front());
  ExitStatus worst = ExitStatus::kDone;
  for (const ClientError& failure : failures_) worst = std::max(worst, failure.status());
  throw ClientError(worst, lines_of(failures_), {"", {}, {}, failures_, {}});
}

}  // namespace strainwave
