// SPDX-License-Identifier: BSD-3-Clause
#include "strainwave/stream.h"

#include <fmt/format.h>

#include <cmath>
#include <exception>
#include <utility>

#include "client/joint/joint_link.h"
#include "client/protocol/motion.h"
#include "client/protocol/orders.h"
#include "lcmtypes/stream_validity.h"

namespace strainwave {

namespace {

constexpr double kFarthestAhead_s = 0.9;  // the daemon allows 1 s; the transmission takes part of it
constexpr double kFarthestTime_s = 1e12;  // a cycle of this time fits into a message
constexpr double kLongestStep_s = 0.5;    // without samples a joint comes to rest after 0.2 s
constexpr auto kAnotherOne = "this stream is over; Joint::stream() opens a new one";
std::string over_after(long late, long outdated) {
  if (late + outdated == 0) return kAnotherOne;
  return fmt::format("{} of its samples came late, {} quoted an old state; {}", late, outdated, kAnotherOne);
}

bool tells_less_than_the_state(Reason refusal) {
  return refusal == Reason::kFaulted || refusal == Reason::kStreamEnded || refusal == Reason::kWrongSession;
}

bool ends_stream(Reason refusal) {
  return refusal == Reason::kStreamEnded || refusal == Reason::kSuperseded ||
         refusal == Reason::kWrongSession || refusal == Reason::kVelocitiesContradict;
}

StreamOptions checked(const std::string& joint, StreamOptions options) {
  checked_number(joint, "ahead_s", options.ahead_s, "above 0 to 0.9",
                 options.ahead_s > 0.0 && options.ahead_s <= kFarthestAhead_s);
  checked_number(joint, "valid_for_s", options.valid_for_s, fmt::format("above 0 to {}", kLongestValidFor_s),
                 options.valid_for_s > 0.0 && options.valid_for_s <= kLongestValidFor_s);
  checked_number(joint, "speed_limit_rad_s", options.speed_limit_rad_s, "0 (none) or above",
                 options.speed_limit_rad_s >= 0.0);
  options.beside = nullptr;  // that stream may end before this one
  return options;
}

double period_of(JointLink& link) {
  const auto held = link.lock();
  return link.limits().period_s;
}

std::int64_t new_stream(JointLink& link) {
  const auto held = link.lock();
  return link.client().new_stream();
}

}  // namespace

/// Relates the time t of a stream to the daemon's cycles. Joints that move together share it.
struct Stream::TimeBase {
  std::optional<double> origin_t_s;
  std::int64_t origin_cycle = 0;

  std::int64_t cycle_of(double t_s, double period_s) const {
    return origin_cycle + std::llround((t_s - *origin_t_s) / period_s);
  }
};

std::shared_ptr<Stream::TimeBase> Stream::base_of(JointLink& link, const Stream* beside) {
  if (beside == nullptr) return std::make_shared<TimeBase>();
  if (!beside->link_) throw InvalidInput(link.name() + ": beside: this Stream was moved to another one");
  require_same_daemon(link, *beside->link_, "streams beside each other");
  return beside->base_;
}

Stream::Stream(std::shared_ptr<JointLink> link, const StreamOptions& options)
    : link_(std::move(link)),
      base_(base_of(*link_, options.beside)),
      options_(checked(link_->name(), options)),
      period_s_(period_of(*link_)),
      stream_id_(new_stream(*link_)),
      exceptions_(std::uncaught_exceptions()) {}

Stream::Stream(Stream&& other) noexcept = default;

Stream::~Stream() {
  if (link_ && last_cycle_) end();
}

// After an exception the joint must hold, instead of moving on to the last sample.
void Stream::end() noexcept {
  try {
    if (std::uncaught_exceptions() == exceptions_) return close();
    const auto held = link_->lock();
    hold();
  } catch (const std::exception&) {
    // The stream expires by itself.
  }
}

bool Stream::put(double t_s, double position_rad, std::optional<double> velocity_rad_s,
                 std::optional<double> acceleration_rad_s2, const CarriedLoad& load) {
  checked_number(link_->name(), "t_s", t_s, "a time from -1e12 to 1e12 s, above the last one",
                 std::abs(t_s) <= kFarthestTime_s && (!last_t_s_ || t_s > *last_t_s_));
  const auto held = link_->lock();
  // A later sample does not restart the stream: another client may have ended it for a reason.
  if (over_) throw NotDone(fmt::format("{}: {}", link_->name(), kAnotherOne));
  if (last_cycle_) {
    link_->client().catch_up();
    check_restart();
  }
  setpoint_v1 message = sample(position_rad, velocity_rad_s, acceleration_rad_s2, load);
  last_t_s_ = t_s;
  if (!last_cycle_) {
    begin(t_s, message);
    return true;
  }
  message.at_cycle = base_->cycle_of(t_s, period_s_);
  if (message.at_cycle <= *last_cycle_)
    throw InvalidInput(fmt::format(
        "{}: t_s = {}: a time of at least {} s (the daemon's period) after the last one is allowed",
        link_->name(), t_s, period_s_));
  wait_until_due(message.at_cycle);
  check_refusals();
  if (static_cast<double>(message.at_cycle) <= link_->cycle_now(period_s_)) {
    leave_out(message.at_cycle);
    return false;
  }
  link_->client().send(link_->name(), channel_kind::kSetpoint, message);
  last_cycle_ = message.at_cycle;
  return true;
}

std::int64_t Stream::cycle_of(double t_s) const {
  checked_number(link_->name(), "t_s", t_s, "a time from -1e12 to 1e12 s", std::abs(t_s) <= kFarthestTime_s);
  const auto held = link_->lock();
  if (!base_->origin_t_s)
    throw NotDone(link_->name() + ": the stream has not begun: its first put() sets its time");
  return base_->cycle_of(t_s, period_s_);
}

void Stream::close() {
  over_ = true;
  if (!last_cycle_) return;
  const auto held = link_->lock();
  try {
    wait_for_end();
  } catch (const ClientError&) {
    hold();
    throw;
  }
  hold();
  wait_until_holding(link_->client(), link_->name());
}

void Stream::wait_for_end() {
  check_refusals();
  const JointView& view = link_->view();
  Client& client = link_->client();
  if (!client.wait_until([&] { return restarted() || view.state.cycle >= *last_cycle_; },
                         Deadline(options_.ahead_s + client.options().timeout_s)))
    throw NoAnswer(link_->silence("lost contact with strainwaved before the stream's end"), link_->name());
  check_refusals();
}

// Sends the hold at most once, and not after the stream was lost: another client may use the joint then.
void Stream::hold() {
  if (std::exchange(last_cycle_, std::nullopt)) send_stop(link_->client(), link_->name(), Action::kHold);
}

setpoint_v1 Stream::sample(double position_rad, std::optional<double> velocity_rad_s,
                           std::optional<double> acceleration_rad_s2, const CarriedLoad& load) const {
  const limits_v1& limits = link_->limits();
  setpoint_v1 message{};
  require_in_range(link_->name(), position_rad, limits);
  message.position_rad = position_rad;
  if (acceleration_rad_s2 && !velocity_rad_s)
    throw InvalidInput(fmt::format("{}: acceleration_rad_s2 = {}: allowed only with velocity_rad_s",
                                   link_->name(), *acceleration_rad_s2));
  if (velocity_rad_s) {
    message.velocity_rad_s =
        checked_number(link_->name(), "velocity_rad_s", *velocity_rad_s, "a finite number");
    message.derivatives = 1;
  }
  if (acceleration_rad_s2) {
    message.acceleration_rad_s2 =
        checked_number(link_->name(), "acceleration_rad_s2", *acceleration_rad_s2, "a finite number");
    message.derivatives = 2;
  }
  message.torque_Nm =
      checked_number(link_->name(), "torque_Nm", load.torque_Nm,
                     fmt::format("from {} to {}", -limits.torque_limit_Nm, limits.torque_limit_Nm),
                     std::abs(load.torque_Nm) <= limits.torque_limit_Nm, "joint.limits.torque_limit_Nm");
  message.load_inertia_kgm2 = checked_number(link_->name(), "load_inertia_kgm2", load.load_inertia_kgm2,
                                             "a number from 0", load.load_inertia_kgm2 >= 0.0);
  message.stream_id = stream_id_;
  message.valid_for_s = options_.valid_for_s;
  message.speed_limit_rad_s = options_.speed_limit_rad_s;
  return message;
}

void Stream::begin(double t_s, setpoint_v1 message) {
  message.begins_stream = 1;
  message.acknowledge = 1;
  message.approach = options_.approach ? 1 : 0;
  const bool sets_the_base = !base_->origin_t_s;
  const auto prepare = [&](setpoint_v1& next) {
    if (sets_the_base) {
      base_->origin_t_s = t_s;
      base_->origin_cycle =
          static_cast<std::int64_t>(std::ceil(link_->cycle_now(period_s_) + options_.ahead_s / period_s_));
    }
    next.at_cycle = base_->cycle_of(t_s, period_s_);
  };
  link_->client().forget_sent();
  const Answer answer = link_->client().request(link_->name(), channel_kind::kSetpoint, message, prepare);
  require_accepted(answer, link_->name(),
                   fmt::format("the first setpoint of the stream, {} rad,", message.position_rad));
  last_cycle_ = first_cycle_ = message.at_cycle;
  session_id_ = link_->client().find(link_->name())->state.session_id;
}

void Stream::wait_until_due(std::int64_t cycle) {
  Client& client = link_->client();
  client.catch_up();
  const double due_s =
      (static_cast<double>(cycle) - link_->cycle_now(period_s_)) * period_s_ - options_.ahead_s;
  if (due_s > kLongestStep_s)
    throw InvalidInput(fmt::format(
        "{}: t_s = {}: due in {:.4g} s, at most {} is allowed: t_s counts seconds, not milliseconds",
        link_->name(), *last_t_s_, due_s, kLongestStep_s));
  client.wait_until([&] { return client.has_refusals() || restarted(); }, Deadline(due_s));
}

// A fault or a yield of the joint is reported before the refusals that it caused.
void Stream::check_refusals() {
  check_state(first_cycle_);
  while (const auto refusal = link_->client().take_refusal()) {
    const bool late = refusal->reason == Reason::kCycleIsOver || refusal->overtaken;
    if (!late && refusal->reason != Reason::kTooOld) {
      if (tells_less_than_the_state(refusal->reason)) check_joint();
      if (ends_stream(refusal->reason)) lose();
      require_accepted(*refusal, link_->name(), "a setpoint of the stream",
                       ends_stream(refusal->reason) ? over_after(late_, outdated_) : "");
    }
    ++(late ? late_ : outdated_);
  }
}

// The refusal may arrive before the state that explains it.
void Stream::check_joint() {
  Client& client = link_->client();
  const JointView& view = client.wait_for_joint(link_->name());
  const std::int64_t seen = view.messages;
  client.wait_until(
      [&] { return mode_of(view) == Mode::kFaulted || restarted() || view.messages > seen + 1; },
      Deadline(kOldStates_s));
  check_state(view.state.cycle);
}

/// In states before `from_cycle`, a yield may be older than the stream.
void Stream::check_state(std::int64_t from_cycle) {
  check_restart();
  const JointView& view = link_->client().wait_for_joint(link_->name());
  const bool fault = mode_of(view) == Mode::kFaulted;
  if (!fault && !(has_yielded(view) && view.state.cycle >= from_cycle)) return;
  lose();
  if (fault) throw faulted(link_->client(), link_->name());
  throw yielded(link_->name(), "did not follow the stream to its end", view);
}

bool Stream::restarted() const {
  return link_->client().find(link_->name())->state.session_id != session_id_;
}

void Stream::check_restart() {
  if (!restarted()) return;
  lose();
  throw NotDone(
      fmt::format("{}: did not follow the stream to its end: the daemon was restarted, and the joint is {}; "
                  "enable it; Joint::stream() opens a new stream",
                  link_->name(), to_text(mode_of(*link_->client().find(link_->name())))),
      link_->name());
}

void Stream::lose() {
  over_ = true;
  last_cycle_.reset();
}

void Stream::leave_out(std::int64_t cycle) {
  ++late_;
  if (static_cast<double>(cycle - *last_cycle_) * period_s_ > options_.valid_for_s)
    throw NotDone(
        fmt::format("{}: stream timed out after {} late samples (valid_for_s = {} s). Send samples earlier, "
                    "or give a larger ahead_s; Joint::stream() opens a new stream",
                    link_->name(), late_, options_.valid_for_s));
}

}  // namespace strainwave
