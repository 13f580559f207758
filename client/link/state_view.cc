#include "client/link/state_view.h"

#include "lcmtypes/channels.h"
#include "lcmtypes/wire.h"

namespace strainwave {

StateView::StateView(Connection& connection)
    : subscription_(
          connection.subscribe(channel_pattern("[^.]+", channel_kind::kState), &StateView::on_state, this)) {}

const JointView* StateView::find(const std::string& prefix, const std::string& joint) const {
  const auto found = joints_.find({prefix, joint});
  return found == joints_.end() ? nullptr : &found->second;
}

std::vector<std::string> StateView::joints(const std::string& prefix) const {
  std::vector<std::string> names;
  for (const auto& [name, view] : joints_) {
    if (name.first == prefix) names.push_back(name.second);
  }
  return names;
}

std::vector<std::string> StateView::prefixes() const {
  std::vector<std::string> names;
  for (const auto& [name, view] : joints_) {
    if (names.empty() || names.back() != name.first) names.push_back(name.first);
  }
  return names;
}

void StateView::accept(const std::string& channel, std::span<const std::uint8_t> bytes) {
  const auto parts = parse_channel(channel);
  if (!parts || parts->kind != channel_kind::kState) return;
  const auto state = decode_exactly<state_v1>(bytes);
  if (!state) return;
  const std::pair name(parts->prefix, parts->joint);
  if (joints_.size() >= kMaxJoints && !joints_.contains(name)) return;
  JointView& view = joints_[name];
  if (view.messages > 0 && state->session_id != view.state.session_id) {
    view.two_daemons = view.two_daemons || state->session_id == view.previous_session;
    view.previous_session = view.state.session_id;
  }
  view.state = *state;
  view.received = now();
  ++view.messages;
}

void StateView::on_state(const lcm::ReceiveBuffer* buffer, const std::string& channel) {
  accept(channel, payload(*buffer));
}

}  // namespace strainwave
