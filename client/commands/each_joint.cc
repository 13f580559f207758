#include "client/commands/each_joint.h"

#include <algorithm>

namespace strainwave {

std::vector<std::string> joints_or_all(Client& client, const std::vector<std::string>& joints) {
  return joints.empty() ? client.wait_for_joints() : joints;
}

bool Failures::attempt(const std::function<void()>& step) {
  try {
    step();
    return true;
  } catch (const ClientError& error) {
    add(error);
    if (error.status() == ExitStatus::kInterrupted) rethrow();
    return false;
  }
}

void Failures::add(const ClientError& error) {
  failure_.emplace(failure_ ? std::max(failure_->status(), error.status()) : error.status(),
                   failure_ ? std::string(failure_->what()) + "\n" + error.what() : error.what());
}

void Failures::rethrow() const {
  if (failure_) throw *failure_;
}

}  // namespace strainwave
