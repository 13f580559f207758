// SPDX-License-Identifier: BSD-3-Clause
// The limits that daemons publish for their joints, for programs that need them before an order. Not real-time.
#pragma once

#include <strainwave/limits_v1.hpp>
#include <string>
#include <vector>

#include "client/protocol/client.h"
#include "client/protocol/latest_messages.h"

namespace strainwave {

/// Throws InvalidInput, in the daemon's words, unless `joint` may go to `position_rad`. Adds a hint if degrees may be meant.
void require_in_range(const std::string& joint, double position_rad, const limits_v1& limits);

class PublishedLimits {
 public:
  /// Starts to listen for `joints`, under the client's prefix. `client` must outlive this object.
  PublishedLimits(Client& client, const std::vector<std::string>& joints);

  /// Waits for the limits of `joint`, one of `joints`, from the daemon that publishes its states. The result
  /// lasts as long as this object, and later limits update it. Throws NoAnswer.
  const limits_v1& wait_for(const std::string& joint);

 private:
  Client& client_;
  LatestMessages<Latest<limits_v1>> heard_;
};

}  // namespace strainwave
