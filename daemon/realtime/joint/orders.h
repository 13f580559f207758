// SPDX-License-Identifier: BSD-3-Clause
// The data exchanged between the supervisor's thread and the real-time thread. Plain data. Real-time safe.
#pragma once

#include <cstdint>
#include <optional>

#include "base/spsc_queue.h"
#include "drivers/injected_fault.h"
#include "strainwave/vocabulary.h"

namespace strainwave {

enum class OrderKind : std::int32_t {
  kEnable,
  kDisable,
  kHold,
  kClearFault,
  kSetpoint,
  kUseTable,
  kInject,
  kHome,
  kLoadPath,
  kPausePath,
  kResumePath,
  kResetLearning,
  kFreezeLearning,
  kResumeLearning,
  kEndStream  ///< ends the previous owner's stream: the joint comes to rest; a move or path continues
};

/// One admitted message on its way to a joint. The joint obeys orders in their sequence: a hold after a setpoint wins.
struct Order {
  std::int64_t id = 0;  ///< quoted in the reply; 0: no reply is wanted
  OrderKind kind = OrderKind::kDisable;
  std::int32_t table_slot = 0;       ///< kUseTable
  double position_rad = 0.0;         ///< kSetpoint
  double valid_for_s = 0.0;          ///< kSetpoint; 0: a move
  Injection injection{};             ///< kInject
  double speed_limit_rad_s = 0.0;    ///< kSetpoint; 0: the joint's own
  std::int64_t stream_id = 0;        ///< kSetpoint; 0: a move
  bool begins_stream = false;        ///< kSetpoint: the stream begins with this one
  double velocity_rad_s = 0.0;       ///< kSetpoint of a stream, with derivatives >= 1
  double acceleration_rad_s2 = 0.0;  ///< kSetpoint of a stream, with derivatives 2
  double torque_Nm = 0.0;            ///< kSetpoint of a stream: added to the planned torque
  double load_inertia_kgm2 = 0.0;    ///< kSetpoint of a stream: added to the joint's own
  std::int32_t derivatives = 0;      ///< kSetpoint of a stream: 0..2 are given
  bool approaches = false;           ///< kSetpoint that begins a stream: may begin far from the joint
  std::int64_t at_cycle = 0;         ///< kSetpoint of a stream: its cycle; 0: sent_us gives its time
  std::int64_t sent_us = 0;          ///< kSetpoint of a stream with at_cycle 0: on the sender's clock, > 0
  std::int64_t expires_cycle = -1;   ///< in a later cycle the order is too old; -1: never
  std::int64_t challenge_cycle =
      -1;  ///< draw of its challenge: a fault in or after it makes the order too old; -1: none
  std::int32_t path_slot = 0;  ///< kLoadPath
};

/// The loop's decision on an order. A refusal for a number also has that number and its bound; otherwise both are 0:
///   kMoving of an enable            the joint's speed, rad/s, and joint.supervision.standstill_rad_s
///   kOutOfRange of a setpoint       how far its at_cycle is ahead, and how far it may be, s
///   kFarFromJoint of a setpoint     how far from the joint its stream begins, and how far it may, rad
///   kOutOfRange of a table          its torque or load limit, and the torque or load that the joint holds, N.m
///   kOutOfRange of a path           how far from the joint's target it begins, and how far it may, rad
///   kWrongMode of a resume          joints that have their part of the path, and how many there must be
///   kStreamEnded of a setpoint      the load to which the joint yielded, which ended its stream, and the allowed load, N.m
///   kCycleIsOver of a setpoint      its at_cycle, and the present cycle
///   kVelocitiesContradict           its velocities over the rate of its positions, and 1; 0 and 0 where the positions stand
struct Ruling {
  Ruling(Reason given) noexcept : reason(given) {}  // implicit: most are a reason alone
  Ruling(Reason given, double refused, double bound) noexcept : reason(given), value(refused), limit(bound) {}
  Reason reason;
  double value = 0.0;
  double limit = 0.0;
};

/// The outcome of an order. The real-time thread decides, because only it knows the mode in the cycle that counts.
struct Reply {
  std::int64_t id = 0;
  Reason reason = Reason::kAccepted;
  Mode mode = Mode::kOff;  ///< at that moment
  double value = 0.0;      ///< as in Ruling
  double limit = 0.0;      ///< as in Ruling
};

/// The load that made a joint yield, joint side.
struct Yield {
  double load_Nm = 0.0;       ///< as estimated; > 0 pushes towards negative positions
  double limit_Nm = 0.0;      ///< > 0, the allowed load
  double position_rad = 0.0;  ///< where the joint was
};

/// An event for the log: a change of mode, or the start of a yield.
struct LoopEvent {
  std::int64_t joint = 0;
  std::int64_t cycle = 0;
  Mode from = Mode::kOff;
  Mode to = Mode::kOff;
  Fault fault = Fault::kNone;
  std::uint32_t drive_error = 0;  ///< with a fault: number from the driver or the daemon
  std::optional<Yield> yield{};   ///< the joint began to yield in this mode; none: its mode changed
};

/// Orders of a joint that may wait for its loop.
inline constexpr std::size_t kMostWaitingOrders = 64;
using JointOrderQueue = SpscQueue<Order, kMostWaitingOrders>;
using ReplyQueue = SpscQueue<Reply, 4096>;
using EventQueue = SpscQueue<LoopEvent, 1024>;

}  // namespace strainwave
