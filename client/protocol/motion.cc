// SPDX-License-Identifier: BSD-3-Clause
#include "client/protocol/motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <strainwave/setpoint_v1.hpp>
#include <utility>
#include <vector>

#include "client/protocol/orders.h"
#include "client/protocol/plain_zero.h"
#include "strainwave/client_error.h"

namespace strainwave {

namespace {

/// A motion whose end is awaited.
struct Motion {
  Mode mode;            ///< mode during the motion
  std::string purpose;  ///< in words, after "did not"
  std::function<bool(const JointView&)> replaced =
      nullptr;  ///< whether another order of this kind replaced it; null: impossible
  std::function<void(const JointView&)> observe =
      nullptr;  ///< sees each state with this order's target, which may be older than the order
};

/// The reason why the wait ends before the joint arrives, in words. Empty while the joint is moving.
std::string motion_ended(const JointView& view, const Motion& motion, std::int64_t session_id) {
  if (view.state.session_id != session_id) return "the daemon was restarted";
  const Mode mode = mode_of(view);
  if (mode == Mode::kOff || mode == Mode::kStopping) return "the joint was disabled";
  if (motion.replaced && motion.replaced(view)) return "another command replaced this one";
  return "";
}

/// Watches a joint's motion once its order is in force.
class MotionWatch {
 public:
  /// `done` returns whether the motion has ended as ordered.
  MotionWatch(const Client& client, const std::string& joint, Motion motion,
              std::function<bool(const JointView&)> done)
      : client_(client),
        joint_(joint),
        view_(client.find(joint)),
        motion_(std::move(motion)),
        done_(std::move(done)),
        session_id_(view_->state.session_id) {}

  const JointView& view() const noexcept { return *view_; }

  bool faulted() const { return mode_of(*view_) == Mode::kFaulted; }
  /// Whether the joint has yielded to a load in this motion.
  bool yielded() { return motion_.replaced && in_force() && has_yielded(*view_); }
  Faulted fault() const { return strainwave::faulted(client_, joint_); }
  Yielded yield() const { return strainwave::yielded(joint_, "did not " + motion_.purpose, *view_); }
  /// Returns true once the motion is done. Throws if it ended otherwise, except for a fault, or if the daemon is silent for `silence_s`.
  bool look(double silence_s) {
    if (seconds_between(view_->received, now()) > silence_s)
      throw NoAnswer(
          fmt::format(
              "{}: lost contact with strainwaved during the motion: {}; the joint may still be moving",
              joint_, silence_of(*view_, silence_s)),
          joint_);
    if (motion_.observe && !motion_.replaced(*view_)) motion_.observe(*view_);
    if (!in_force()) return false;
    if (const std::string end = motion_ended(*view_, motion_, session_id_); !end.empty())
      throw NotDone(fmt::format("{}: did not {}: {}", joint_, motion_.purpose, end), joint_);
    return done_(*view_);
  }

 private:
  /// Whether the state shows this motion or a later one.
  bool in_force() {
    seen_ = seen_ || (mode_of(*view_) == motion_.mode && !(motion_.replaced && motion_.replaced(*view_)));
    return seen_ || old_states_.passed();
  }

  std::reference_wrapper<const Client> client_;
  std::string joint_;
  const JointView* view_;
  Motion motion_;
  std::function<bool(const JointView&)> done_;
  std::int64_t session_id_;
  Deadline old_states_{kOldStates_s};
  bool seen_ = false;
};

/// The states of one cycle arrive one by one. Waits until all joints have reached the cycle of the first.
void wait_for_the_others(Client& client, const std::vector<MotionWatch>& motions) {
  constexpr double kSameCycle_s = 0.05;
  const JointView& first = motions.front().view();
  client.wait_until(
      [&] {
        return std::all_of(motions.begin(), motions.end(), [&](const MotionWatch& motion) {
          return motion.view().state.cycle >= first.state.cycle;
        });
      },
      Deadline(kSameCycle_s));
}

/// If a fault or a load stopped any joint, throws an error that names every such joint. First it waits until all joints rest, at
/// most one time-out. Then it waits a moment more, because a joint that stopped with the others may also show a fault or a yield.
void check_stops(Client& client, std::vector<MotionWatch>& motions) {
  constexpr double kMoment_s = 0.3;
  const auto stopped = [](MotionWatch& motion) { return motion.faulted() || motion.yielded(); };
  if (std::none_of(motions.begin(), motions.end(), stopped)) return;
  const auto tracks = [](const MotionWatch& motion) { return mode_of(motion.view()) == Mode::kTracking; };
  client.wait_until([&] { return std::none_of(motions.begin(), motions.end(), tracks); },
                    Deadline(client.options().timeout_s));
  client.wait_until([&] { return std::all_of(motions.begin(), motions.end(), stopped); },
                    Deadline(kMoment_s));
  std::vector<Faulted> faults;
  std::vector<Yielded> yields;
  for (MotionWatch& motion : motions) {
    if (motion.faulted())
      faults.push_back(motion.fault());
    else if (motion.yielded())
      yields.push_back(motion.yield());
  }
  std::vector<ClientError> each(faults.begin(), faults.end());
  each.insert(each.end(), yields.begin(), yields.end());
  const std::string text = lines_of(each);
  if (each.size() == 1) each.clear();
  if (!faults.empty())
    throw Faulted(text, faults.front().details().joint, faults.front().fault(), std::move(each));
  if (!yields.empty())
    throw Yielded(text, yields.front().details().joint, yields.front().to(), std::move(each));
}

/// Returns once all motions are done. Reports a fault or a yield before its effects on the joints that move
/// along. `look`: see wait_until_arrived().
void wait_for_motions(Client& client, std::vector<MotionWatch> motions,
                      const std::function<void()>& look = nullptr) {
  constexpr double kLook_s = 0.01;
  while (!motions.empty()) {
    const JointView& view = motions.front().view();
    const std::int64_t seen = view.messages;
    client.wait_until([&] { return view.messages != seen; }, Deadline(kLook_s));
    wait_for_the_others(client, motions);
    const double timeout_s = client.options().timeout_s;
    check_stops(client, motions);
    std::erase_if(motions, [&](MotionWatch& motion) { return motion.look(timeout_s); });
    if (look && !motions.empty()) look();
  }
}

/// Watches whether a joint is inside the tolerance of its target and stays there.
class ArrivalWatch {
 public:
  ArrivalWatch(double target_rad, double tolerance_rad, double patience_s)
      : target_rad_(target_rad), tolerance_rad_(tolerance_rad), patience_s_(patience_s), start_(now()) {}

  /// Notes the time at which the joint got inside. A short motion may end before its order is known to be in force.
  void observe(const JointView& view) {
    if (!(std::abs(error_rad(view)) <= tolerance_rad_))
      inside_.reset();
    else if (!inside_)
      inside_ = view.received;
  }
  /// Returns true once the joint has been inside for long enough. Throws ClientError (refused) when it holds outside.
  bool reached(const std::string& joint, const JointView& view) {
    constexpr double kStay_s = 0.1;
    if (mode_of(view) != Mode::kHolding) {
      holding_.reset();
      return false;
    }
    if (!holding_) holding_ = now();
    if (inside_ && seconds_between(*inside_, now()) >= kStay_s) return true;
    if (seconds_between(*holding_, now()) > patience_s_)
      throw NotDone(fmt::format("{}: holds {} rad away from {} rad, outside of tolerance_rad {}", joint,
                                error_text(error_rad(view), tolerance_rad_), target_rad_, tolerance_rad_),
                    joint);
    return false;
  }
  /// Time from the start of the watch until the joint stayed inside.
  double duration_s() const { return std::max(0.0, seconds_between(start_, *inside_)); }
  double error_rad(const JointView& view) const {
    return plain_zero(target_rad_ - view.state.joint_position_rad);
  }

 private:
  double target_rad_;
  double tolerance_rad_;
  double patience_s_;
  Instant start_;
  std::optional<Instant> inside_;
  std::optional<Instant> holding_;
};

/// Refuses a move of more than an hour. It is probably a mistake, and no path may take longer either.
void require_quick_enough(const std::string& joint, const MoveOrder& order, double from_rad) {
  const double way_rad = std::abs(order.position_rad - from_rad);
  if (order.speed_limit_rad_s <= 0.0 || way_rad <= order.speed_limit_rad_s * kLongestMove_s) return;
  constexpr double kMargin = 1.01;  // for rounding in the message
  const std::string hint = degrees_hint(order.position_rad);
  throw InvalidInput(
      fmt::format("{}: speed_limit_rad_s = {}: at least {:.3g} is allowed: the way of {:.3g} rad takes "
                  "{:.3g} s at that speed, and a move takes at most {} s{}{}",
                  joint, order.speed_limit_rad_s, kMargin * way_rad / kLongestMove_s, way_rad,
                  way_rad / order.speed_limit_rad_s, kLongestMove_s, hint.empty() ? "" : "; ", hint),
      joint);
}

bool holds(const JointView& view) {
  return mode_of(view) == Mode::kHolding;
}

}  // namespace

std::string degrees_hint(double position_rad) {
  if (!std::isfinite(position_rad) || std::abs(position_rad) <= 2.0 * std::numbers::pi) return "";
  return fmt::format("positions are in rad: {} degrees would be {:.6g}", position_rad,
                     position_rad * std::numbers::pi / 180.0);
}

std::string error_text(double error_rad, double tolerance_rad) {
  constexpr int kFewest = 2;
  constexpr int kAll = 16;
  std::string text;
  for (int digits = kFewest; digits <= kAll; ++digits) {
    text = fmt::format("{:.{}e}", error_rad, digits);
    if ((std::abs(std::stod(text)) <= tolerance_rad) == (std::abs(error_rad) <= tolerance_rad)) break;
  }
  return text;
}

std::string duration_text(double duration_s) {
  constexpr double kShortest_s = 0.01;
  return duration_s < kShortest_s ? fmt::format("less than {} s", kShortest_s)
                                  : fmt::format("{:.3f} s", duration_s);
}

void start_move(Client& client, const std::string& joint, const MoveOrder& order) {
  require_quick_enough(joint, order, client.wait_for_joint(joint).state.setpoint_position_rad);
  setpoint_v1 message{};
  message.position_rad = order.position_rad;
  message.speed_limit_rad_s = order.speed_limit_rad_s;
  message.acknowledge = 1;
  const Answer answer = client.request(joint, channel_kind::kSetpoint, message);
  require_accepted(answer, joint, fmt::format("move to {} rad", order.position_rad),
                   answer.reason == Reason::kOutOfRange ? degrees_hint(order.position_rad) : "");
}

Arrival move_joint(Client& client, const std::string& joint, const MoveOrder& order) {
  start_move(client, joint, order);
  return wait_until_arrived(client, {{joint, order.position_rad}}, order.tolerance_rad).front();
}

std::vector<Arrival> wait_until_arrived(Client& client, const std::vector<JointTarget>& targets,
                                        double tolerance_rad, const std::function<void()>& look) {
  std::vector<ArrivalWatch> arrivals;
  arrivals.reserve(targets.size());
  for (const JointTarget& target : targets)
    arrivals.emplace_back(target.position_rad, tolerance_rad, client.options().timeout_s);
  std::vector<MotionWatch> motions;
  motions.reserve(targets.size());
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const JointTarget& target = targets[i];
    const auto replaced = [target](const JointView& view) {
      return view.state.target_position_rad != target.position_rad;
    };
    const auto done = [target, &arrival = arrivals[i]](const JointView& view) {
      return arrival.reached(target.joint, view);
    };
    const auto observe = [&arrival = arrivals[i]](const JointView& view) { arrival.observe(view); };
    motions.emplace_back(
        client, target.joint,
        Motion{Mode::kTracking, fmt::format("arrive at {} rad", target.position_rad), replaced, observe},
        done);
  }
  wait_for_motions(client, std::move(motions), look);
  std::vector<Arrival> arrived;
  arrived.reserve(targets.size());
  for (std::size_t i = 0; i < targets.size(); ++i)
    arrived.push_back({arrivals[i].duration_s(), arrivals[i].error_rad(*client.find(targets[i].joint))});
  return arrived;
}

void home_joint(Client& client, const std::string& joint) {
  order_accepted(client, joint, Action::kHome);
  wait_for_motions(client, {{client, joint, {Mode::kHoming, "find home"}, holds}});
  if ((client.find(joint)->state.notices & static_cast<std::int32_t>(Notice::kNotHomed)) != 0)
    throw NotDone(joint + ": homing was stopped before it found home", joint);
}

void wait_until_holding(Client& client, const std::string& joint) {
  client.wait_for_joint(joint);
  wait_for_motions(client, {{client, joint, {Mode::kTracking, "hold"}, holds}});
}

}  // namespace strainwave
