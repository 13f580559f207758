// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/joint/joint_in_loop.h"

#include <utility>

namespace strainwave {

JointInLoop::JointInLoop(std::int64_t joint, const JointLoopConfig& joint_config,
                         std::unique_ptr<Actuator> actuator, EventQueue& event_queue)
    : index(joint),
      config(joint_config),
      events(event_queue),
      drive(config, std::move(actuator)),
      law(config),
      zero(config.homing.required),
      homing(config.homing),
      motion_watch(config) {}

bool JointInLoop::change_mode(ModeEvent event, const CycleTime& time) noexcept {
  const Mode from = mode.mode();
  if (!mode.apply(event, time.now_ns)) return false;
  if (!mode.is(from)) mode_changed(from, time);
  return true;
}

void JointInLoop::raise_fault(Fault fault, const CycleTime& time,
                              std::optional<std::uint32_t> own_finding) noexcept {
  const Mode from = mode.mode();
  if (!mode.latch(fault, own_finding.value_or(drive.reading().drive_error), time.now_ns)) return;
  // Encoder counts may be missing from now on.
  if (fault == Fault::kReadFailed || fault == Fault::kImplausibleReading || fault == Fault::kConnectionLost ||
      fault == Fault::kDriveRestarted)
    zero.forget();
  mode_changed(from, time);
}

void JointInLoop::mode_changed(Mode from, const CycleTime& time) noexcept {
  (void)events.push({index, time.cycle, from, mode.mode(), mode.fault(), mode.drive_error(), {}});
  if (mode.is(Mode::kFaulted)) faulted_cycle = time.cycle;
  if (from == Mode::kHoming) homing.abort();
  if (mode.is(Mode::kStopping)) law.controller().stop();
  // The joint rests, so its load is known now.
  if (from == Mode::kStopping && mode.is(Mode::kOff)) law.keep_held_load(drive.position_rad());
  if (mode.is(Mode::kStopping) || !mode.controlled()) end_orders();
}

bool JointInLoop::stops_group(const CycleTime& time) const noexcept {
  return config.group >= 0 && mode.is(Mode::kFaulted) && mode.began(time.now_ns) &&
         mode.fault() != Fault::kGroup;
}

void JointInLoop::drop_path() noexcept {
  path = nullptr;
  path_slots.drop();
}

void JointInLoop::end_orders() noexcept {
  ordered.end();
  drop_path();
}

}  // namespace strainwave
