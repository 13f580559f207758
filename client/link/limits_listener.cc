#include "client/link/limits_listener.h"

#include <fmt/format.h>

#include "client/link/exit_status.h"
#include "lcmtypes/wire.h"

namespace strainwave {

LimitsListener::LimitsListener(Connection& connection)
    : subscription_(connection.subscribe(channel_pattern("[^.]+", channel_kind::kLimits),
                                         &LimitsListener::on_limits, this)) {}

const limits_v1* LimitsListener::find(const std::string& prefix, const std::string& joint) const {
  const auto found = limits_.find({prefix, joint});
  return found == limits_.end() ? nullptr : &found->second;
}

const limits_v1& LimitsListener::wait_for(Client& client, const std::string& joint) const {
  const std::string& prefix = client.options().prefix;
  const std::int64_t session_id = client.wait_for_joint(joint).state.session_id;
  const auto heard = [&] {
    const limits_v1* limits = find(prefix, joint);
    return limits != nullptr && limits->session_id == session_id;
  };
  if (!client.wait_until(heard, Deadline(client.options().timeout_s)))
    throw ClientError(
        ExitStatus::kNoAnswer,
        fmt::format("no limits on {} in {} s: they come once a second from a daemon of this version",
                    channel(prefix, joint, channel_kind::kLimits), client.options().timeout_s));
  return *find(prefix, joint);
}

void LimitsListener::on_limits(const lcm::ReceiveBuffer* buffer, const std::string& channel) {
  const auto parts = parse_channel(channel);
  const auto limits = decode_exactly<limits_v1>(payload(*buffer));
  if (!parts || !limits) return;
  const std::pair name(parts->prefix, parts->joint);
  if (limits_.size() < StateView::kMaxJoints || limits_.contains(name)) limits_[name] = *limits;
}

}  // namespace strainwave
