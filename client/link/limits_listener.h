// The latest limits of every joint that is heard, under any prefix. Not real-time.
#pragma once

#include <map>
#include <strainwave/limits_v1.hpp>
#include <string>
#include <utility>

#include "client/link/client.h"

namespace strainwave {

class LimitsListener {
 public:
  explicit LimitsListener(Connection& connection);

  /// Null when nothing was heard yet.
  const limits_v1* find(const std::string& prefix, const std::string& joint) const;
  /// Waits for those of a joint of the client's prefix, from the daemon whose states are heard. Throws
  /// ClientError (no answer).
  const limits_v1& wait_for(Client& client, const std::string& joint) const;

 private:
  void on_limits(const lcm::ReceiveBuffer* buffer, const std::string& channel);

  std::map<std::pair<std::string, std::string>, limits_v1> limits_;
  Subscription subscription_;
};

}  // namespace strainwave
