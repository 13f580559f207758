// SPDX-License-Identifier: BSD-3-Clause
// One ODrive axis in the loop, by CANSimple: frames, axis state, orders, and supervision. The rules for calls
// and real time are those of can_node.h; faults are latched as in cia402_node.h.
//
// CANSimple has no SYNC. The drive sends its position by its own clock, at a varying place in the loop's period. Each
// position comes with the velocity of the same instant, which serves to extrapolate it to the start of the cycle.
//
// In CANSimple only the drive's watchdog supervises the host; each order feeds it. There is no boot-up
// message: a restarted drive shows itself by missing heartbeats and by having left closed loop. The
// controller mode is set each time the axis is enabled.
#pragma once

#include <string>
#include <vector>

#include "drivers/can/can_node.h"
#include "drivers/can/kernel_clock.h"
#include "drivers/can/node_watch.h"
#include "drivers/can/odrive/odrive_config.h"
#include "drivers/can/set_up_state.h"

namespace strainwave::odrive {

/// ActuatorReading::drive_error of these drives: an axis error from the drive, or, with the highest bit set,
/// a detail of can_detail.h.
inline constexpr std::uint32_t kOurDetail = 1U << 31U;
std::string drive_error_text(std::uint32_t drive_error);

class Node final : public CanNode {
 public:
  explicit Node(const DriveConfig& config);

  const std::string& name() const noexcept override { return config_.name; }
  std::vector<std::uint32_t> receive_ids() const override;
  std::vector<std::uint32_t> transmit_ids() const override;
  std::vector<std::uint32_t> setup_ids() const override;
  std::vector<FrameTraffic> traffic() const override;
  std::vector<std::string> set_up(CanPort& port) override;
  std::vector<std::string> verify(CanPort& port) override;
  std::vector<std::string> serve(CanPort& port) override;
  void shut_down(CanPort& port) noexcept override;

  void begin_cycle(std::int64_t now_ns) noexcept override;
  void note_own(const CanFrame& frame, std::int64_t kernel_time_ns) noexcept override;
  void receive(const CanFrame& frame, std::int64_t kernel_time_ns) noexcept override;
  void note_bus(const NodeFault& trouble) noexcept override;
  void transmit(CanTransmitter& bus) noexcept override;

  ActuatorReading read(std::int64_t now_ns) noexcept override;
  void write(const ActuatorCommand& command) noexcept override;
  void stop() noexcept override { stop_ordered_ = true; }
  void clear_fault() noexcept override;

 private:
  bool closed_loop() const noexcept { return heartbeat_.state == AxisState::kClosedLoop; }
  bool wants_power() const noexcept;
  void forget_drive() noexcept;
  void supervise() noexcept;
  std::int64_t position_age_ns() const noexcept { return now_ns_ - sampled_ns_; }
  bool has_position() const noexcept;
  NodeFault use_trouble() const noexcept;
  void lead_state(CanTransmitter& bus) noexcept;

  DriveConfig config_;
  std::int64_t arm_timeout_ns_;
  std::int64_t period_ns_;
  SetUpState setup_;

  // Only the loop uses these.
  std::int64_t now_ns_ = 0;
  KernelClock kernel_clock_;
  std::int64_t sampled_ns_ = 0;  ///< of the position, in the loop's time
  std::int64_t heartbeat_ns_ = 0;
  std::int64_t temperature_ns_ = 0;
  std::int64_t enabling_since_ns_ = 0;
  std::int64_t state_sent_ns_ = 0;
  Heartbeat heartbeat_;
  double position_rad_ = 0.0;
  double velocity_rad_s_ = 0.0;
  double temperature_C_ = 0.0;
  double torque_measured_Nm_ = 0.0;
  std::int64_t torque_ns_ = 0;
  int missed_ = 0;
  NodeWatch watch_;
  ActuatorCommand command_;
  ActuatorCommand sent_;  ///< last order; while not enabled: the present position, no torque
  bool fresh_ = false;
  bool has_heartbeat_ = false;
  bool has_temperature_ = false;
  bool was_armed_ = false;  ///< closed loop was reached since enabling
  bool stop_ordered_ = false;
  bool clear_ordered_ = false;
};

}  // namespace strainwave::odrive
