// SPDX-License-Identifier: BSD-3-Clause
#include "strainwave/joint.h"

#include <utility>

#include "client/joint/joint_link.h"
#include "client/protocol/motion.h"
#include "client/protocol/orders.h"

namespace strainwave {

namespace {

MoveOrder checked(const std::string& joint, const MoveOrder& order) {
  checked_number(joint, "position_rad", order.position_rad, "a finite number of rad");
  checked_number(joint, "speed_limit_rad_s", order.speed_limit_rad_s, "0 (none) or above",
                 order.speed_limit_rad_s >= 0.0);
  checked_number(joint, "tolerance_rad", order.tolerance_rad, "a number above 0", order.tolerance_rad > 0.0);
  return order;
}

/// Collects every state during its lifetime.
class OpenInbox {
 public:
  explicit OpenInbox(JointLink& link) : link_(link) { link_.open(states_); }
  ~OpenInbox() { link_.close(states_); }
  OpenInbox(const OpenInbox&) = delete;
  OpenInbox& operator=(const OpenInbox&) = delete;

  /// Returns the next state. Throws NoAnswer.
  State take() {
    Client& client = link_.client();
    if (!client.wait_until([&] { return !states_.empty(); }, Deadline(client.options().timeout_s))) {
      client.wait_for_joint(link_.name());  // its error is more specific if no state ever came
      throw NoAnswer(link_.silence("lost contact with strainwaved"), link_.name());
    }
    const State next = states_.front();
    states_.pop_front();
    return next;
  }

 private:
  JointLink& link_;
  JointLink::Inbox states_;
};

}  // namespace

Joint::Joint(const std::string& name, const JointOptions& options)
    : link_(std::make_shared<JointLink>(name, options)) {}
Joint::~Joint() = default;
Joint::Joint(Joint&&) noexcept = default;
Joint& Joint::operator=(Joint&&) noexcept = default;

const std::string& Joint::name() const noexcept {
  return link_->name();
}

State Joint::state() {
  const auto held = link_->lock();
  const JointView& view = link_->view();
  return {view.state, view.received};
}

Limits Joint::limits() {
  const auto held = link_->lock();
  return Limits(link_->limits());
}

void Joint::states(double duration_s, const std::function<void(const State&)>& visit) {
  checked_number(name(), "duration_s", duration_s, "0 or above", duration_s >= 0.0);
  const auto held = link_->lock();
  OpenInbox inbox(*link_);
  const State first = inbox.take();
  for (State next = first; seconds_between(first.received, next.received) <= duration_s; next = inbox.take())
    visit(next);
}

void Joint::enable() {
  const auto held = link_->lock();
  link_->view();
  enable_joint(link_->client(), name());
}

void Joint::disable() {
  const auto held = link_->lock();
  send_stop(link_->client(), name(), Action::kDisable);
  wait_until_off(link_->client(), name());
}

void Joint::hold() {
  const auto held = link_->lock();
  send_stop(link_->client(), name(), Action::kHold);
  wait_until_holding(link_->client(), name());
}

void Joint::clear_fault() {
  const auto held = link_->lock();
  link_->view();
  if (clear_joint_fault(link_->client(), name())) wait_until_cleared(link_->client(), name());
}

void Joint::home() {
  const auto held = link_->lock();
  home_joint(link_->client(), name());
}

void Joint::take_over() {
  const auto held = link_->lock();
  order_accepted(link_->client(), name(), Action::kTakeOver);
}

void Joint::release() {
  const auto held = link_->lock();
  order_accepted(link_->client(), name(), Action::kRelease);
}

void Joint::reset_learning() {
  const auto held = link_->lock();
  order_accepted(link_->client(), name(), Action::kResetLearning);
}

void Joint::freeze_learning() {
  const auto held = link_->lock();
  order_accepted(link_->client(), name(), Action::kFreezeLearning);
}

void Joint::resume_learning() {
  const auto held = link_->lock();
  order_accepted(link_->client(), name(), Action::kResumeLearning);
}

Arrival Joint::move(const MoveOrder& order) {
  const auto held = link_->lock();
  return move_joint(link_->client(), name(), checked(name(), order));
}

void Joint::start_move(const MoveOrder& order) {
  const auto held = link_->lock();
  strainwave::start_move(link_->client(), name(), checked(name(), order));
}

Stream Joint::stream(const StreamOptions& options) {
  return {link_, options};
}

}  // namespace strainwave
