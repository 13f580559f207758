// SPDX-License-Identifier: BSD-3-Clause
// A simulated ODrive axis with a joint, which speaks CANSimple as firmware 0.6 does. Like cia402_node.h it
// shares no code with drivers/, uses no sockets and no clock, and misbehaves on command.
// Source: ODrive's documentation, "CAN Protocol" and the reference of ODrive.Axis.Error, firmware 0.6.
//
// If the documentation leaves a choice, the node is strict: only input messages feed the watchdog, which runs
// from the first of them on, armed or not. Closed loop begins at the last input, wherever the joint is.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>

#include "sim/joint/joint_plant.h"
#include "sim/joint/temperature_profile.h"
#include "tests/support/can_nodes/node.h"

namespace strainwave::can_nodes {

enum class OdriveCommand : std::uint8_t {
  kGetVersion = 0x00,
  kHeartbeat = 0x01,
  kEstop = 0x02,
  kGetError = 0x03,
  kReadOrWrite = 0x04,  ///< RxSdo in the documentation: opcode 0 reads an endpoint, 1 writes it
  kValue = 0x05,        ///< TxSdo in the documentation
  kSetAxisState = 0x07,
  kEncoderEstimates = 0x09,
  kSetControllerMode = 0x0B,
  kSetInputPosition = 0x0C,
  kSetInputVelocity = 0x0D,
  kSetInputTorque = 0x0E,
  kIq = 0x14,
  kTemperature = 0x15,
  kReboot = 0x16,
  kBusVoltageCurrent = 0x17,
  kClearErrors = 0x18,
  kTorques = 0x1C,
};

enum class OdriveState : std::uint8_t { kUndefined = 0, kIdle = 1, kClosedLoop = 8 };

inline constexpr std::uint32_t kOdriveUnderVoltage = 0x200;
inline constexpr std::uint32_t kOdriveMotorOverTemperature = 0x2000;
inline constexpr std::uint32_t kOdriveWatchdogExpired = 0x1000000;
inline constexpr std::uint32_t kOdriveEstopRequested = 0x2000000;

struct OdriveVersion {
  std::uint8_t protocol = 2;
  std::array<std::uint8_t, 3> hardware{4, 4, 58};
  std::array<std::uint8_t, 3> firmware{0, 6, 10};
};

struct OdriveNodeConfig {
  std::uint8_t node_id = 0;  ///< 0..63
  OdriveVersion version;
  JointPlantConfig plant;
  TemperatureProfile ambient;
  double counts_per_joint_revolution = 320000;  ///< of the encoder that the estimates use
  double joint_turns_per_encoder_turn =
      0.02;  ///< 1 / gear ratio, or 1 for an encoder at the joint; < 0: reversed
  double joint_torque_per_drive_torque = 50.0;  ///< gear ratio, with the same sign
  double torque_limit_Nm = 1.0;                 ///< of the drive
  double velocity_bandwidth_rad_s = 200.0;      ///< of its own velocity loop; the position loop has a quarter
  double velocity_units_per_turn_s = 1000.0;    ///< axis0.config.can.input_vel_scale
  double torque_units_per_Nm = 1000.0;          ///< axis0.config.can.input_torque_scale
  double torque_constant_Nm_A = 0.192;
  double bus_V = 48.0;
  double under_voltage_V = 10.0;
  double motor_limit_C = 100.0;
  std::int64_t boot_us = 50000;
  std::int64_t arming_us = 5000;
  double watchdog_timeout_s = 0.1;
  bool watchdog_enabled = true;
  std::uint16_t watchdog_enabled_endpoint = 190;  ///< of axis0.config.enable_watchdog
  std::uint16_t watchdog_timeout_endpoint = 191;
  std::int64_t heartbeat_us = 100000;
  std::int64_t encoder_us = 10000;  ///< cyclic messages; 0: on request only
  std::int64_t temperature_us = 0;
  std::int64_t torques_us = 0;
  std::int64_t bus_us = 0;
  std::int64_t error_us = 0;
};

class OdriveNode final : public Node {
 public:
  /// Throws InputError for an impossible plant.
  OdriveNode(const OdriveNodeConfig& config, NodeOutput& output);

  void power_on(std::int64_t now_us) override;
  void receive(const Frame& frame, std::int64_t now_us) override;
  void advance(std::int64_t now_us) override;
  std::int64_t next_deadline_us() const override;
  /// Obeys one line that makes the node misbehave; odrive_commands.cc lists them.
  std::string command(std::string_view line, std::int64_t now_us) override;

  OdriveState state() const { return state_; }
  std::uint32_t errors() const { return errors_; }
  double torque_Nm() const { return torque_Nm_; }
  const JointPlant& plant() const { return plant_; }

 private:
  std::uint32_t id_of(OdriveCommand command) const {
    return static_cast<std::uint32_t>(config_.node_id) << 5 | static_cast<std::uint32_t>(command);
  }
  void boot();
  void obey(OdriveCommand command, const Frame& frame);
  void request_state(std::uint32_t state);
  void set_state(OdriveState state);
  void disarm(std::uint32_t error);
  void feed_watchdog();
  void answer_endpoint(const Frame& frame);
  void send(OdriveCommand command);
  void send_cyclic();
  std::optional<std::array<std::uint8_t, 8>> content_of(OdriveCommand command) const;
  void step();
  double wanted_torque_Nm();
  double encoder_turns() const;
  std::string report() const;

  OdriveNodeConfig config_;
  NodeOutput& output_;
  JointPlant plant_;
  std::int64_t step_us_;
  std::int64_t now_us_ = 0;
  std::int64_t next_step_us_ = 0;
  std::int64_t boot_done_us_ = 0;
  std::map<OdriveCommand, std::int64_t> next_cyclic_us_;
  std::optional<std::int64_t> arming_done_us_;
  std::optional<std::int64_t> watchdog_deadline_us_;

  bool booting_ = true;
  OdriveState state_ = OdriveState::kIdle;
  std::uint32_t errors_ = 0;
  std::uint32_t disarm_reason_ = 0;
  std::uint8_t procedure_result_ = 0;
  std::uint32_t control_mode_ = 3;  ///< position, as after power-on
  std::uint32_t input_mode_ = 1;
  // Drive side.
  double input_position_turns_ = 0.0;
  double input_velocity_turns_s_ = 0.0;
  double input_torque_Nm_ = 0.0;
  double integral_Nm_ = 0.0;
  double torque_Nm_ = 0.0;  ///< joint side, as demanded
  double encoder_turns_s_ = 0.0;
  double bus_V_;
  long inputs_ = 0;

  // Misbehaviour that commands request.
  bool cable_cut_ = false;
  bool heartbeat_off_ = false;
  bool refuses_to_arm_ = false;
  bool notes_torque_ = false;
  bool awaiting_rest_ = false;
  bool wrong_encoder_ = false;
  long skipped_encoders_ = 0;
};

}  // namespace strainwave::can_nodes
