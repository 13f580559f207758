// SPDX-License-Identifier: BSD-3-Clause
#include "tests/doctor/patient.h"

#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <stdexcept>

#include "control/table/gain_table_json.h"
#include "daemon/realtime/joint/joint_loop.h"
#include "daemon/realtime/loop/overrun_watch.h"
#include "doctor/test_motion.h"
#include "drivers/faulty_actuator.h"
#include "tests/doctor/dice.h"
#include "tests/support/flexible_bench.h"

namespace strainwave::testing {

namespace {

constexpr double kPeriod_s = 1e-3;

const Gear& gear() {
  return *find_gear("csf-17-50");
}

void scale_all(ExponentialTemperatureLaw& law, double scale) {
  for (FrictionParameters* part : {&law.asymptote, &law.amplitude}) {
    part->static_Nm *= scale;
    part->coulomb_Nm *= scale;
    part->viscous_Nms_rad *= scale;
  }
}

BenchJoint healthy_joint(Dice& dice, bool flexible) {
  BenchJoint joint = flexible ? flexible_joint() : demo_joint();
  JointPlantConfig& plant = joint.drive.plant;
  plant.effects.gear_ratio = 50.0;
  plant.effects.friction.presliding_rad = dice.between(2e-5, 2e-4);
  plant.effects.drive.ripple_share = dice.between(0.0, 0.01);
  plant.effects.drive.current_loop_s = dice.between(0.0, 3e-4);
  plant.thermal = reference_thermal();
  if (flexible) {
    plant.effects.transmission->kinematic_error.amplitude_rad = {dice.between(0.0, 5e-5),
                                                                 dice.between(0.0, 2e-4)};
    plant.effects.transmission->spring = plant.effects.transmission->spring.scaled(dice.between(0.92, 1.08));
    plant.effects.transmission->link_inertia_kgm2 *= dice.between(0.95, 1.05);
    plant.effects.transmission->lost_motion.width_rad = dice.between(0.5, 1.0) * gear().lost_motion_rad;
  } else {
    plant.joint.inertia_kgm2 *= dice.between(0.95, 1.05);
  }
  scale_all(plant.joint.friction, dice.between(0.85, 1.15));
  joint.drive.ambient = TemperatureProfile::parse("constant:" + std::to_string(dice.between(-5.0, 40.0)), {});
  joint.loop.controller.motion = {4.0, 30.0, 30.0};
  joint.loop.limits.following_error_rad = 0.1;
  return joint;
}

void make_ill(const std::string& cause, int index, Dice& dice, Patient& patient) {
  JointPlantConfig& plant = patient.drive.plant;
  Mistakes& mistakes = patient.mistakes;
  const bool flexible = patient.told.link.has_value();
  const auto encoder_at_link = [&] { plant.link_encoder.counts_per_joint_revolution = 1e6; };
  if (cause == "wrong sign") mistakes.torque_scale = -1.0;
  if (cause == "gear ratio") {
    const double ratio = std::array{0.6, 1.6, 2.0}[static_cast<std::size_t>(index % 3)];
    mistakes.torque_scale = mistakes.position_scale = ratio;
  }
  if (cause == "encoder counts") mistakes.position_scale = dice.off(1.6, 2.5);
  if (cause == "torque constant") mistakes.torque_scale = dice.off(1.5, 2.2);
  if (cause == "delay") plant.delay.periods += 1.0 + index % 3;
  if (cause == "inertia") {
    const double factor = dice.off(1.5, 2.2);
    plant.joint.inertia_kgm2 *= flexible ? 1.0 : factor;
    if (flexible) plant.effects.transmission->link_inertia_kgm2 *= factor > 1.0 ? 2.0 * factor - 1.0 : 0.2;
  }
  if (cause == "stiffness")
    plant.effects.transmission->spring = plant.effects.transmission->spring.scaled(dice.off(1.8, 2.5));
  if (cause == "gravity") plant.effects.gravity = {dice.between(4.0, 8.0), dice.between(-0.1, 0.1)};
  if (cause == "sagging supply") plant.motor.stall_torque_Nm = dice.between(55.0, 78.0);
  if (cause == "temperature sensor wrong") {
    if (index % 2 == 0)
      mistakes.temperature_open = true;
    else
      mistakes.temperature_offset_C = index % 4 == 1 ? 30.0 : -30.0;
  }
  if (cause == "temperature sensor unplugged")
    patient.faults.push_back({InjectedFault::kTemperatureLost, dice.between(0.0, 5.0)});
  if (cause == "friction") scale_all(plant.joint.friction, dice.off(2.0, 2.8));
  if (cause == "slipping coupling") {
    encoder_at_link();
    mistakes.slip_above_Nm = dice.between(3.0, 5.0);
    mistakes.slip_rad_s = dice.between(0.3, 0.6);
  }
  if (cause == "dragging brake") {
    const double drag_Nm = dice.between(3.0, 6.0);
    plant.joint.friction.asymptote.coulomb_Nm += drag_Nm;
    plant.joint.friction.asymptote.static_Nm += drag_Nm;
  }
  if (cause == "missing counts") {
    mistakes.lose_above_rad_s = dice.between(1.5, 2.2);
    mistakes.lost_share = dice.between(0.02, 0.05);
    mistakes.drive_finds_losses = index % 2 == 0;
    encoder_at_link();
  }
  if (cause == "electrical noise")
    patient.faults.push_back({InjectedFault::kSensorNoisy, 0.0, 0.0, dice.between(8e-5, 2e-4)});
  if (cause == "no real time") {
    // Many short stalls, or a few that may be longer than stall_limit_s.
    patient.stall_share = index % 2 == 0 ? dice.between(0.1, 0.2) : dice.between(0.0005, 0.001);
    patient.stall_periods = index % 2 == 0 ? 3 : 60;
  }
  if (cause == "bus overloaded") {
    mistakes.missed_share = dice.between(0.01, 0.03);
    mistakes.late_share = dice.between(0.02, 0.1);
  }
  if (cause == "late drive") mistakes.late_share = 1.0;
  if (cause == "clock trouble") {
    patient.clock_rate = index % 2 == 0 ? dice.between(0.005, 0.02) : 0.0;
    patient.clock_jump_s = index % 2 == 0 ? 0.0 : dice.between(0.1, 5.0);
  }
}

/// The daemon's loop of one joint with its drive. Each step() is one cycle.
class Bed {
 public:
  explicit Bed(const Patient& patient) : patient_(patient), random_(patient.seed + 7U) {
    auto simulated = std::make_unique<SimulatedActuator>(patient.drive);
    auto mistaken =
        std::make_unique<MistakenDrive>(std::move(simulated), patient.mistakes, kPeriod_s, patient.seed);
    auto faulty = std::make_unique<FaultyActuator>(
        std::move(mistaken), FaultyActuatorConfig{kPeriod_s, patient.faults, nullptr, patient.seed});
    joint_ = std::make_unique<JointLoop>(1, patient.loop, std::move(faulty), *replies_, *events_);
    time_.now_ns = 1'000'000'000;
  }

  void step() {
    std::int64_t periods = 1;
    if (patient_.stall_share > 0.0 &&
        std::uniform_real_distribution<double>(0.0, 1.0)(random_) < patient_.stall_share)
      periods +=
          1 + static_cast<std::int64_t>(random_() % static_cast<std::uint64_t>(patient_.stall_periods));
    overruns_ += periods - 1;
    time_.elapsed_periods = periods;
    time_.cycle += periods;
    time_.now_ns += periods * 1'000'000;
    if (const Fault fault = watch_.judge(periods - 1); fault != Fault::kNone && joint_->mode() != Mode::kOff)
      joint_->joint().raise_fault(fault, time_);
    joint_->step(time_);
    Reply reply;
    while (replies_->pop(reply)) {
    }
  }
  void order(Order order) {
    order.id = ++orders_;
    joint_->orders().push(order);
    step();
  }
  JointLoop& joint() { return *joint_; }
  const CycleTime& time() const { return time_; }
  std::int64_t overruns() const { return overruns_; }
  const state_v1& state() const { return joint_->record().state; }
  bool faulted() const { return joint_->mode() == Mode::kFaulted; }

 private:
  const Patient& patient_;
  std::mt19937_64 random_;
  std::unique_ptr<ReplyQueue> replies_ = std::make_unique<ReplyQueue>();
  std::unique_ptr<EventQueue> events_ = std::make_unique<EventQueue>();
  std::unique_ptr<JointLoop> joint_;
  OverrunWatch watch_{OverrunLimits{}, kPeriod_s};
  CycleTime time_;
  std::int64_t overruns_ = 0;
  std::int64_t orders_ = 0;
};

limits_v1 limits_of(const Patient& patient) {
  limits_v1 limits{};
  limits.position_min_rad = patient.loop.limits.position_min_rad;
  limits.position_max_rad = patient.loop.limits.position_max_rad;
  limits.speed_limit_rad_s = patient.loop.controller.motion.velocity_rad_s;
  limits.acceleration_rad_s2 = patient.loop.controller.motion.acceleration_rad_s2;
  limits.deceleration_rad_s2 = patient.loop.controller.motion.deceleration_rad_s2;
  limits.torque_limit_Nm = patient.loop.controller.torque_limit_Nm;
  limits.period_s = kPeriod_s;
  limits.gear_ratio = 50.0;
  limits.inertia_kgm2 = *patient.told.inertia_kgm2;
  return limits;
}

/// Runs the bed and records the messages that the daemon would publish.
class Examination {
 public:
  Examination(const Patient& patient, std::int64_t stride)
      : patient_(patient), stride_(stride), bed_(patient) {
    evidence_.told = patient.told;
    evidence_.take(limits_of(patient));
  }

  Evidence run(double& seconds) {
    bed_.joint().table_slot(0) = {*patient_.table, 1};
    bed_.order({.kind = OrderKind::kUseTable});
    wait_s(0.5);
    bed_.order({.kind = OrderKind::kEnable});
    for (int i = 0; i < 500 && bed_.joint().mode() != Mode::kHolding; ++i) step();
    for (const TestStroke& stroke :
         plan_test_motion(*evidence_.limits, bed_.state().joint_position_rad, 0.5)) {
      if (bed_.faulted()) break;
      bed_.order({.kind = OrderKind::kSetpoint,
                  .position_rad = stroke.position_rad,
                  .speed_limit_rad_s = stroke.speed_rad_s});
      for (int i = 0; i < 10'000 && !bed_.faulted() && (i < 20 || bed_.joint().mode() != Mode::kHolding); ++i)
        step();
      wait_s(stroke.rest_s);
    }
    wait_s(0.1);
    seconds = static_cast<double>(bed_.time().cycle) * kPeriod_s;
    return std::move(evidence_);
  }

 private:
  void wait_s(double duration_s) {
    for (int i = 0; i < duration_s / kPeriod_s; ++i) step();
  }
  void step() {
    bed_.step();
    const std::int64_t cycle = bed_.time().cycle;
    state_v1 state = bed_.state();
    const double at_s = static_cast<double>(cycle) * kPeriod_s;
    const double sender_s = at_s * (1.0 + patient_.clock_rate) + (at_s > 8.0 ? patient_.clock_jump_s : 0.0);
    state.utime = 1'700'000'000'000'000 + static_cast<std::int64_t>(std::llround(1e6 * sender_s));
    if (cycle / stride_ != published_ / stride_) evidence_.take(state);
    published_ = cycle;
    if (cycle % 1000 < 3 && cycle - timed_ > 500) time_message(cycle);
  }
  void time_message(std::int64_t cycle) {
    timing_v1 timing{};
    timing.period_s = kPeriod_s;
    timing.cycles = cycle - bed_.overruns();
    timing.overruns = bed_.overruns();
    timing.real_time = patient_.real_time ? 1 : 0;
    evidence_.take(timing);
    timed_ = cycle;
  }

  const Patient& patient_;
  std::int64_t stride_;
  Bed bed_;
  Evidence evidence_;
  std::int64_t published_ = 0, timed_ = 0;
};

}  // namespace

Patient random_patient(const std::string& cause, int index) {
  unsigned seed = 1000U + static_cast<unsigned>(index);
  for (const char c : cause) seed = 31U * seed + static_cast<unsigned char>(c);
  Dice dice(seed);
  const bool flexible = index % 2 == 1 || cause == "stiffness" || cause == "slipping coupling";
  const BenchJoint joint = healthy_joint(dice, flexible);
  Patient patient{.loop = joint.loop,
                  .drive = joint.drive,
                  .mistakes = {},
                  .faults = {},
                  .told = {},
                  .table = flexible ? &flexible_table() : &demo_table(),
                  .seed = seed};
  ConfiguredJoint& told = patient.told;
  told.inertia_kgm2 = patient.table->plant.inertia_kgm2;
  told.delay_periods = patient.loop.controller.delay_periods;
  told.count_rad = patient.loop.controller.encoder_resolution_rad;
  told.gravity = GravityLoad{};
  told.friction = patient.table->friction;
  if (const auto& link = patient.loop.controller.link)
    told.link = {link->motor_inertia_kgm2,
                 link->link_inertia_kgm2,
                 gear().spring,
                 link->damping_Nms_rad,
                 false,
                 kUsualLostMotion * gear().lost_motion_rad};
  // Half of the daemons run on a desktop without real time, as a newcomer's does.
  patient.real_time = index % 4 >= 2;
  if (!patient.real_time) patient.stall_share = 0.002;
  make_ill(cause, index, dice, patient);
  return patient;
}

Evidence examine(const Patient& patient, std::int64_t stride_periods, double& seconds) {
  return Examination(patient, stride_periods).run(seconds);
}

}  // namespace strainwave::testing
