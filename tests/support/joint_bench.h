// SPDX-License-Identifier: BSD-3-Clause
// Joints in virtual time, for tests and benchmarks of the loop: real JointLoops with simulated drives, which
// may be faulty. A step is one period, and nothing depends on the host's clock.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "daemon/realtime/joint/joint_loop.h"
#include "daemon/realtime/loop/overrun_watch.h"
#include "daemon/realtime/path/path_follower.h"
#include "drivers/faulty_actuator.h"
#include "drivers/simulated_actuator.h"

namespace strainwave::testing {

/// The joint of config/demo.toml.
struct BenchJoint {
  JointLoopConfig loop;
  SimulatedActuatorConfig drive;
  std::vector<Injection> faults;
};
BenchJoint demo_joint();
/// Multiplies the joint's static and Coulomb friction by `scale`. Its table still has the old friction.
void scale_friction(BenchJoint& joint, double scale);
/// The same joint with static and Coulomb friction `scale` times that of its table.
BenchJoint demo_joint_with_friction(double scale);

/// The table shipped for the joint.
const GainTable& demo_table();

/// Forwards everything and remembers the last command.
class WatchedActuator final : public Actuator {
 public:
  explicit WatchedActuator(std::unique_ptr<SimulatedActuator> actuator) : actuator_(std::move(actuator)) {}
  ActuatorReading read(std::int64_t now_ns) noexcept override { return actuator_->read(now_ns); }
  void write(const ActuatorCommand& command) noexcept override {
    command_ = command;
    actuator_->write(command);
  }
  void stop() noexcept override {
    command_ = {};
    ++stops_;
    actuator_->stop();
  }
  void clear_fault() noexcept override { actuator_->clear_fault(); }

  const ActuatorCommand& command() const noexcept { return command_; }
  int stops() const noexcept { return stops_; }
  SimulatedActuator& simulated() noexcept { return *actuator_; }

 private:
  std::unique_ptr<SimulatedActuator> actuator_;
  ActuatorCommand command_;
  int stops_ = 0;
};

class JointBench {
 public:
  explicit JointBench(const std::vector<BenchJoint>& joints, const OverrunLimits& overruns = {});
  /// One joint on a drive that the test supplies.
  JointBench(const JointLoopConfig& loop, std::unique_ptr<Actuator> drive);

  /// One period of every joint. If a drive takes longer than a period, the next periods are skipped, as in
  /// the daemon.
  void step();
  void run(double duration_s);
  /// Before the next step, the loop stalls for `periods` periods.
  void stall(std::int64_t periods);
  /// Steps until `condition` holds. Returns the number of steps, or -1 after `limit` of them.
  std::int64_t step_until(const std::function<bool()>& condition, std::int64_t limit);

  /// Gives the order and makes one step. Returns the loop's answer.
  Reason order(std::size_t joint, Order order);
  const Reply& last_reply() const noexcept { return last_reply_; }
  Reason order(std::size_t joint, OrderKind kind) { return this->order(joint, Order{.kind = kind}); }
  /// A move, or with `valid_for_s` a setpoint of stream 1. The stream begins with it unless `begins` is false.
  Reason move(std::size_t joint, double position_rad, double valid_for_s = 0.0, bool begins = true) {
    const bool streamed = valid_for_s > 0.0;
    return order(joint, Order{.kind = OrderKind::kSetpoint,
                              .position_rad = position_rad,
                              .valid_for_s = valid_for_s,
                              .stream_id = streamed ? 1 : 0,
                              .begins_stream = streamed && begins,
                              .approaches = true,
                              .sent_us = sent_us()});
  }
  Reason inject(std::size_t joint, const Injection& injection) {
    return order(joint, Order{.kind = OrderKind::kInject, .injection = injection});
  }
  /// Loads `table`, enables, and runs until the joint holds.
  void bring_to_hold(std::size_t joint, const GainTable& table = demo_table());

  JointLoop& joint(std::size_t index) { return *joints_[index]; }
  const state_v1& state(std::size_t joint) const { return joints_[joint]->record().state; }
  Fault fault(std::size_t joint) const { return static_cast<Fault>(state(joint).fault); }
  Mode mode(std::size_t joint) const { return static_cast<Mode>(state(joint).mode); }
  bool has_notice(std::size_t joint, Notice notice) const {
    return (state(joint).notices & static_cast<std::int32_t>(notice)) != 0;
  }
  /// The present time of a sender's clock.
  std::int64_t sent_us() const { return 1'700'000'000'000'000 + 1000 * time_.cycle; }
  WatchedActuator& drive(std::size_t joint) { return *drives_[joint]; }
  std::int64_t cycle() const { return time_.cycle; }
  const CycleTime& time() const { return time_; }
  EventQueue& events() { return *events_; }
  std::int64_t skipped_periods() const { return skipped_periods_; }

 private:
  JointBench(double period_s, const OverrunLimits& overruns);
  void add(const JointLoopConfig& loop, std::unique_ptr<Actuator> drive);

  std::unique_ptr<ReplyQueue> replies_ = std::make_unique<ReplyQueue>();
  Reply last_reply_;
  std::unique_ptr<EventQueue> events_ = std::make_unique<EventQueue>();
  std::vector<std::unique_ptr<JointLoop>> joints_;
  std::unique_ptr<PathFollower> paths_;
  std::vector<WatchedActuator*> drives_;
  std::int64_t period_ns_;
  CycleTime time_;
  OverrunWatch overruns_;
  std::int64_t skipped_periods_ = 0;
  std::int64_t next_order_id_ = 1;
};

}  // namespace strainwave::testing
