// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/joint_bench.h"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "control/table/gain_table_json.h"
#include "sim/joint/reference_plant.h"

namespace strainwave::testing {

namespace {

/// Virtual time that drives have taken in the current period.
std::int64_t burned_ns = 0;

void burn(std::int64_t duration_ns) noexcept {
  burned_ns += duration_ns;
}

}  // namespace

BenchJoint demo_joint() {
  BenchJoint joint;
  joint.drive.plant = realistic_plant();
  joint.drive.temperature_noise_C = 0.02;
  JointControllerConfig& controller = joint.loop.controller;
  controller.encoder_resolution_rad = joint.drive.plant.encoder.resolution_rad();
  controller.delay_periods = static_cast<int>(std::lround(joint.drive.plant.delay.periods));
  controller.motor = joint.drive.plant.motor;
  controller.torque_limit_Nm = kReferencePeakTorque_Nm;
  controller.motion = {6.0, 150.0, 150.0};
  joint.loop.limits = {-3.2, 3.2, 0.05, 7.6, 0.1, 70.0, 80.0, {}};
  joint.loop.limits.load.load_Nm = kReferencePeakTorque_Nm;
  joint.loop.limits.load.notice_Nm = kReferencePeakTorque_Nm;
  return joint;
}

void scale_friction(BenchJoint& joint, double scale) {
  for (FrictionParameters* part :
       {&joint.drive.plant.joint.friction.asymptote, &joint.drive.plant.joint.friction.amplitude}) {
    part->static_Nm *= scale;
    part->coulomb_Nm *= scale;
  }
}

BenchJoint demo_joint_with_friction(double scale) {
  BenchJoint joint = demo_joint();
  scale_friction(joint, scale);
  return joint;
}

const GainTable& demo_table() {
  static const GainTable table =
      read_gain_table(std::filesystem::path(STRAINWAVE_SOURCE_DIR) / "data" / "tables" / "rhs17-6006.json");
  return table;
}

JointBench::JointBench(double period_s, const OverrunLimits& overruns)
    : period_ns_(std::llround(period_s * 1e9)), overruns_(overruns, period_s) {
  time_.now_ns = 1'000'000'000;
  burned_ns = 0;
}

JointBench::JointBench(const JointLoopConfig& loop, std::unique_ptr<Actuator> drive)
    : JointBench(loop.controller.period_s, OverrunLimits{}) {
  add(loop, std::move(drive));
}

JointBench::JointBench(const std::vector<BenchJoint>& joints, const OverrunLimits& overruns)
    : JointBench(joints.at(0).loop.controller.period_s, overruns) {
  for (const BenchJoint& joint : joints) {
    auto watched = std::make_unique<WatchedActuator>(std::make_unique<SimulatedActuator>(joint.drive));
    drives_.push_back(watched.get());
    auto faulty = std::make_unique<FaultyActuator>(
        std::move(watched), FaultyActuatorConfig{joint.loop.controller.period_s, joint.faults, &burn, 1});
    add(joint.loop, std::move(faulty));
  }
}

void JointBench::add(const JointLoopConfig& loop, std::unique_ptr<Actuator> drive) {
  joints_.push_back(std::make_unique<JointLoop>(static_cast<std::int64_t>(joints_.size()), loop,
                                                std::move(drive), *replies_, *events_));
  paths_ = std::make_unique<PathFollower>(joints_, loop.controller.period_s);
}

void JointBench::step() {
  const std::int64_t skipped = std::exchange(burned_ns, 0) / period_ns_;
  skipped_periods_ += skipped;
  time_.elapsed_periods = 1 + skipped;
  time_.cycle += 1 + skipped;
  time_.now_ns += (1 + skipped) * period_ns_;
  if (const Fault fault = overruns_.judge(skipped); fault != Fault::kNone)
    fault_driven_joints(joints_, fault, time_);
  paths_->advance(time_);
  for (const auto& joint : joints_) joint->step(time_);
  stop_groups_of_the_faulted(joints_, time_);
}

void JointBench::stall(std::int64_t periods) {
  burned_ns += periods * period_ns_;
}

void JointBench::run(double duration_s) {
  for (std::int64_t left = std::llround(duration_s * 1e9) / period_ns_; left > 0; --left) step();
}

std::int64_t JointBench::step_until(const std::function<bool()>& condition, std::int64_t limit) {
  for (std::int64_t steps = 0; steps <= limit; ++steps) {
    if (condition()) return steps;
    step();
  }
  return -1;
}

Reason JointBench::order(std::size_t joint, Order order) {
  order.id = next_order_id_++;
  if (!joints_[joint]->orders().push(order)) throw std::runtime_error("the queue of orders is full");
  step();
  while (replies_->pop(last_reply_))
    if (last_reply_.id == order.id) return last_reply_.reason;
  throw std::runtime_error("the loop did not answer an order");
}

void JointBench::bring_to_hold(std::size_t index, const GainTable& table) {
  joint(index).table_slot(0) = {table, 1};
  if (order(index, OrderKind::kUseTable) != Reason::kAccepted) throw std::runtime_error("table refused");
  if (order(index, OrderKind::kEnable) != Reason::kAccepted) throw std::runtime_error("enable refused");
  if (step_until([&] { return mode(index) == Mode::kHolding; }, 1000) < 0)
    throw std::runtime_error("does not hold");
}

}  // namespace strainwave::testing
