#include "client/link/published_limits.h"

#include <algorithm>

#include "client/link/client_error.h"

namespace strainwave {

namespace {

constexpr double kWithin_s = 2.0;  // they are published once a second

}  // namespace

PublishedLimits::PublishedLimits(Client& client, const std::vector<std::string>& joints)
    : client_(client), heard_(client.connection()) {
  for (const std::string& joint : joints) heard_.keep({client.options().prefix, joint});
}

const limits_v1& PublishedLimits::wait_for(const std::string& joint) {
  const ClientOptions& options = client_.options();
  const state_v1& state = client_.wait_for_joint(joint).state;
  const auto heard = [&] {
    const auto* const latest = heard_.find(options.prefix, joint);
    return latest != nullptr && latest->message.session_id == state.session_id;
  };
  if (!client_.wait_until(heard, Deadline(std::max(kWithin_s, options.timeout_s))))
    throw NoAnswer(joint + ": publishes its state but not its limits", joint);
  return heard_.find(options.prefix, joint)->message;
}

}  // namespace strainwave
