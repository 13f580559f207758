// SPDX-License-Identifier: BSD-3-Clause
// The limits that daemons publish of their joints, for who has to know them before he orders. Not real-time.
#pragma once

#include <strainwave/limits_v1.hpp>
#include <string>
#include <vector>

#include "client/protocol/client.h"
#include "client/protocol/latest_messages.h"

namespace strainwave {

/// Throws InvalidInput unless `joint` may go to `position_rad`; in the daemon's words, and with a hint to who may mean degrees.
void require_in_range(const std::string& joint, double position_rad, const limits_v1& limits);

class PublishedLimits {
 public:
  /// Starts to listen for `joints`, under the client's prefix. `client` outlives this.
  PublishedLimits(Client& client, const std::vector<std::string>& joints);

  /// The limits of `joint`, one of those that are listened for, from the daemon whose states are heard: waits until both have come.
  /// Lasts as long as this; later limits take its place. Throws NoAnswer.
  const limits_v1& wait_for(const std::string& joint);

 private:
  Client& client_;
  LatestMessages<Latest<limits_v1>> heard_;
};

}  // namespace strainwave
