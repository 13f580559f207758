// SPDX-License-Identifier: BSD-3-Clause
#include "client/protocol/published_limits.h"

#include <fmt/format.h>

#include <algorithm>

#include "client/protocol/motion.h"
#include "strainwave/client_error.h"

namespace strainwave {

namespace {

constexpr double kWithin_s = 2.0;  // they are published once a second

}  // namespace

void require_in_range(const std::string& joint, double position_rad, const limits_v1& limits) {
  if (position_rad >= limits.position_min_rad && position_rad <= limits.position_max_rad) return;
  const std::string hint = degrees_hint(position_rad);
  throw InvalidInput(fmt::format("{0}: position_rad = {1}: from {2} to {3} is allowed "
                                 "(joint.limits.position_min_rad and position_max_rad of {0}){4}{5}",
                                 joint, position_rad, limits.position_min_rad, limits.position_max_rad,
                                 hint.empty() ? "" : "; ", hint),
                     joint);
}

PublishedLimits::PublishedLimits(Client& client, const std::vector<std::string>& joints)
    : client_(client), heard_(client.connection()) {
  for (const std::string& joint : joints) heard_.keep({client.options().prefix, joint});
}

const limits_v1& PublishedLimits::wait_for(const std::string& joint) {
  const ClientOptions& options = client_.options();
  const JointView& view = client_.wait_for_joint(joint);
  const state_v1& state = view.state;
  const auto heard = [&] {
    const auto* const latest = heard_.find(options.prefix, joint);
    return latest != nullptr && latest->message.session_id == state.session_id;
  };
  if (!client_.wait_until(heard, Deadline(std::max(kWithin_s, options.timeout_s)))) {
    const std::string silence = silence_of(view, options.timeout_s);
    throw NoAnswer(joint + ": " +
                       (silence.empty() ? "publishes its state but not its limits"
                                        : "its limits are not known: " + silence),
                   joint);
  }
  return heard_.find(options.prefix, joint)->message;
}

}  // namespace strainwave
