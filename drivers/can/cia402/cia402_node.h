// SPDX-License-Identifier: BSD-3-Clause
// One CiA 402 drive in the loop: frames, power state, orders, and supervision. The constructor takes a
// checked configuration. set_up() and serve() block and run outside the loop. Everything from begin_cycle()
// on is real-time safe.
//
// While the drive is in use, faults are latched. Otherwise they are reported as long as their cause lasts, so
// that a failed enabling has a visible reason. After a restart or a lost connection, clear_fault() makes the
// background thread set the drive up again. Unless its encoder is absolute, its position is then unknown. If
// process data do not reach a drive with torque, last_resort.h disables it.
#pragma once

#include <string>
#include <vector>

#include "base/latest_value.h"
#include "drivers/can/can_detail.h"
#include "drivers/can/can_node.h"
#include "drivers/can/canopen/canopen.h"
#include "drivers/can/cia402/cia402_config.h"
#include "drivers/can/cia402/last_resort.h"
#include "drivers/can/cia402/power_sequence.h"
#include "drivers/can/cia402/touch_probe.h"
#include "drivers/can/node_watch.h"
#include "drivers/can/sample_age.h"
#include "drivers/can/set_up_state.h"
#include "drivers/temperature_sample.h"

namespace strainwave::cia402 {

/// Returns ActuatorReading::drive_error of these drives in words.
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
  void end_operation(CanPort& port) noexcept override;
  void shut_down(CanPort& port) noexcept override;

  void begin_cycle(std::int64_t now_ns) noexcept override;
  void note_sync(std::int64_t kernel_time_ns) noexcept override { age_.sync(kernel_time_ns); }
  void receive(const CanFrame& frame, std::int64_t kernel_time_ns) noexcept override;
  void note_bus(const NodeFault& trouble) noexcept override;
  void transmit(CanTransmitter& bus) noexcept override;
  bool withdraws_heartbeat() const noexcept override { return last_resort_.withdraws_heartbeat(); }

  ActuatorReading read(std::int64_t now_ns) noexcept override;
  void write(const ActuatorCommand& command) noexcept override;
  void stop() noexcept override { stop_ordered_ = true; }
  void clear_fault() noexcept override;

 private:
  void receive_pdo(const canopen::Pdo& pdo, const CanFrame& frame) noexcept;
  void receive_probe(const CanFrame& frame) noexcept;
  void judge_age(std::int64_t kernel_time_ns) noexcept;
  void receive_emergency(const canopen::Emergency& emergency) noexcept;
  void receive_heartbeat(canopen::NmtState state) noexcept;
  void forget_drive() noexcept;
  void supervise() noexcept;
  NodeFault present_trouble() const noexcept;
  NodeFault power_trouble() const noexcept;
  bool out_of_reach() const noexcept;
  bool following() const noexcept;
  bool late() const noexcept { return late_samples_ > config_.zero_torque_after; }
  void transmit_order(CanTransmitter& bus) noexcept;
  Goal goal() const noexcept;
  DriveState drive_state() const noexcept;
  void fill_temperature(ActuatorReading& reading) const noexcept;
  void see_mode(std::uint8_t mode) noexcept;
  bool reads_temperature() const noexcept {
    return config_.temperature && config_.temperature->way == TemperatureObject::Way::kSdo;
  }
  bool reads_mode() const noexcept { return layout_.mode.pdo == 0; }
  void read_by_sdo(CanPort& port, std::vector<std::string>& messages);

  DriveConfig config_;
  PdoLayout layout_;
  std::int64_t step_timeout_ns_;
  std::int64_t period_ns_;

  // Written by set-up, read by the loop while setup_ is ready.
  OperationMode mode_ = OperationMode::kCyclicTorque;
  TorqueScale torque_scale_;
  std::uint16_t initial_error_ = 0;
  std::int64_t sync_to_position_ns_ = 0;
  SetUpState setup_;
  LatestValue<TemperatureSample> sdo_temperature_;  ///< from the background thread
  LatestValue<std::uint8_t> sdo_mode_;              ///< from the background thread
  // Only start-up and the background thread use these.
  bool identified_ = false;  ///< the drive has the configured identity and may be written to
  std::int64_t sdo_due_ns_ = 0;
  bool sdo_failed_ = false;

  // Only the loop uses these.
  std::int64_t now_ns_ = 0;
  int skipped_syncs_ = 0;  ///< SYNCs not sent before this period
  PowerSequence power_;
  PositionScale position_scale_;
  TouchProbe probe_;
  double position_rad_ = 0.0;
  double velocity_rad_s_ = 0.0;
  double torque_applied_Nm_ = 0.0;
  JointInputs inputs_;
  double pdo_temperature_C_ = 0.0;
  std::int64_t pdo_temperature_ns_ = 0;
  std::int64_t followed_ns_ = 0;  ///< when the drive last followed its setpoint, or had no torque
  bool followed_ = false;         ///< the drive has followed since operation was enabled
  int missed_ = 0;
  std::uint32_t emergency_ = 0;  ///< the last one, until the drive withdraws it
  NodeFault restarted_;          ///< boot-up or another network state; ends by a new set-up
  NodeWatch watch_;
  SampleAge age_;
  int late_samples_ = 0;  ///< consecutive samples later than delay_periods allows
  LastResort last_resort_;
  ActuatorCommand command_;
  bool fresh_ = false;
  bool has_status_ = false;
  bool has_pdo_temperature_ = false;
  bool wrong_mode_ = false;
  std::uint8_t shown_mode_ = 0;
  bool stop_ordered_ = false;
  bool clear_ordered_ = false;  ///< the fault is to be cleared after the pending set-up
};

}  // namespace strainwave::cia402
