// SPDX-License-Identifier: BSD-3-Clause
// The contents of the messages of odrive_node.h.
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "tests/support/can_nodes/odrive_node.h"

namespace strainwave::can_nodes {

namespace {

using Content = std::array<std::uint8_t, 8>;

Content two_words(std::uint32_t first, std::uint32_t second) {
  std::vector<std::uint8_t> bytes;
  append_little_endian(bytes, first, 4);
  append_little_endian(bytes, second, 4);
  Content content{};
  std::copy(bytes.begin(), bytes.end(), content.begin());
  return content;
}

Content two_floats(double first, double second) {
  return two_words(std::bit_cast<std::uint32_t>(static_cast<float>(first)),
                   std::bit_cast<std::uint32_t>(static_cast<float>(second)));
}

}  // namespace

void OdriveNode::answer_endpoint(const Frame& frame) {
  const auto endpoint = static_cast<std::uint16_t>(little_endian(frame.bytes().subspan(1, 2)));
  const bool reads = frame.data[0] == 0;
  const bool enabled = endpoint == config_.watchdog_enabled_endpoint;
  if (!enabled && endpoint != config_.watchdog_timeout_endpoint) return;
  if (!reads) {
    if (enabled && frame.length >= 5) config_.watchdog_enabled = frame.data[4] != 0;
    if (!enabled && frame.length == 8) config_.watchdog_timeout_s = static_cast<double>(float_at(frame, 4));
    return;
  }
  std::vector<std::uint8_t> bytes{0, frame.data[1], frame.data[2], 0};
  if (enabled)
    bytes.push_back(config_.watchdog_enabled ? 1 : 0);
  else
    append_little_endian(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(config_.watchdog_timeout_s)),
                         4);
  if (!cable_cut_) output_.send({id_of(OdriveCommand::kValue), bytes});
}

double OdriveNode::encoder_turns() const {
  return plant_.measured_position_rad() / (2.0 * std::numbers::pi) / config_.joint_turns_per_encoder_turn;
}

std::optional<Content> OdriveNode::content_of(OdriveCommand command) const {
  const double motor_Nm = plant_.applied_torque_Nm() / config_.joint_torque_per_drive_torque;
  switch (command) {
    case OdriveCommand::kGetVersion: {
      const OdriveVersion& v = config_.version;
      return Content{v.protocol,    v.hardware[0], v.hardware[1], v.hardware[2],
                     v.firmware[0], v.firmware[1], v.firmware[2], 0};
    }
    case OdriveCommand::kHeartbeat: {
      Content content = two_words(errors_, 0);
      content[4] = static_cast<std::uint8_t>(state_);
      content[5] = procedure_result_;
      return content;
    }
    case OdriveCommand::kGetError:
      return two_words(errors_, disarm_reason_);
    case OdriveCommand::kEncoderEstimates: {
      const double wrong = std::numeric_limits<double>::quiet_NaN();
      return wrong_encoder_ ? two_floats(wrong, wrong) : two_floats(encoder_turns(), encoder_turns_s_);
    }
    case OdriveCommand::kIq:
      return two_floats(input_torque_Nm_ / config_.torque_constant_Nm_A,
                        motor_Nm / config_.torque_constant_Nm_A);
    case OdriveCommand::kTorques:
      return two_floats(torque_Nm_ / config_.joint_torque_per_drive_torque, motor_Nm);
    case OdriveCommand::kTemperature:
      return two_floats(plant_.sensor_temperature_C() + 5.0, plant_.sensor_temperature_C());
    case OdriveCommand::kBusVoltageCurrent: {
      const double power_W = plant_.applied_torque_Nm() * plant_.state().velocity_rad_s;
      return two_floats(bus_V_, bus_V_ > 0.0 ? power_W / bus_V_ : 0.0);
    }
    default:
      return std::nullopt;
  }
}

void OdriveNode::send(OdriveCommand command) {
  if (command == OdriveCommand::kEncoderEstimates && skipped_encoders_ > 0) {
    --skipped_encoders_;
    return;
  }
  if (const auto content = content_of(command); content && !cable_cut_)
    output_.send({id_of(command), *content});
}

}  // namespace strainwave::can_nodes
