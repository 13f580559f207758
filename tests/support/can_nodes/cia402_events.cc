// SPDX-License-Identifier: BSD-3-Clause
// The events of cia402_node.h: emergencies, and the record of what happened.
#include <cmath>

#include "tests/support/can_nodes/cia402_node.h"
#include "tests/support/can_nodes/text.h"

namespace strainwave::can_nodes {

namespace {

// The bits of the error register that a code sets: CiA 301, table 26 and object 1001h.
std::int64_t error_register_of(std::uint16_t code) {
  switch (code >> 12) {
    case 0:
      return 0;
    case 2:
      return 0x03;
    case 3:
      return 0x05;
    case 4:
      return 0x09;
    case 8:
      return 0x11;
    default:
      return 0x01;
  }
}

}  // namespace

const char* to_text(NmtState state) {
  switch (state) {
    case NmtState::kBooting:
      return "booting";
    case NmtState::kStopped:
      return "stopped";
    case NmtState::kOperational:
      return "operational";
    case NmtState::kPreOperational:
      return "pre-operational";
  }
  return "?";
}

void Cia402Node::on_heartbeat_lost(std::uint8_t node_id) {
  output_.note(format("heartbeat-lost node=%u", node_id));
  send_emergency(kErrorHeartbeat);
  drive_.lose_connection();
  // 1029h:1, behaviour at a communication error: 0 leaves the operational state, 1 keeps the state, 2 stops.
  const std::int64_t behaviour = dictionary_.number({0x1029, 1});
  if (behaviour == 0 && nmt_ == NmtState::kOperational) change_nmt(NmtState::kPreOperational);
  if (behaviour == 2) change_nmt(NmtState::kStopped);
}

void Cia402Node::send_emergency(std::uint16_t code) {
  output_.note(format("emcy %04X", code));
  dictionary_.set({0x1001, 0}, error_register_of(code));
  if (code != 0) {
    for (int n = kErrorHistory; n > 1; --n)
      dictionary_.set({0x1003, static_cast<std::uint8_t>(n)},
                      dictionary_.number({0x1003, static_cast<std::uint8_t>(n - 1)}));
    dictionary_.set({0x1003, 1}, code);
    dictionary_.set({0x1003, 0}, std::min<std::int64_t>(dictionary_.number({0x1003, 0}) + 1, kErrorHistory));
  }
  if (nmt_ != NmtState::kPreOperational && nmt_ != NmtState::kOperational) return;
  send({static_cast<std::uint32_t>(dictionary_.number({0x1014, 0}) & 0x7FF),
        {static_cast<std::uint8_t>(code & 0xFF), static_cast<std::uint8_t>(code >> 8),
         static_cast<std::uint8_t>(dictionary_.number({0x1001, 0})), 0, 0, 0, 0, 0}});
}

void Cia402Node::written(Key key) {
  if (key.index == 0x6040) drive_.obey_controlword();
  if (key.index == 0x1016) consumer_.restart();
  if (key.index == 0x1017) next_heartbeat_us_ = now_us_;
  if (key.index == 0x1003)
    for (int n = 1; n <= kErrorHistory; ++n) dictionary_.set({0x1003, static_cast<std::uint8_t>(n)}, 0);
}

void Cia402Node::note_power(PowerState from, PowerState to) {
  const JointState& joint = drive_.plant().state();
  output_.note(format("power %s from=%s position_rad=%.6f velocity_rad_s=%.6f",
                      strainwave::can_nodes::to_text(to), strainwave::can_nodes::to_text(from),
                      joint.position_rad, joint.velocity_rad_s));
}

// Records only the beginning and the end of torque, with one line per change.
void Cia402Node::note_torque() {
  const bool has_torque = drive_.torque_demand_Nm() != 0.0;
  if (has_torque != had_torque_) output_.note(has_torque ? "torque on" : "torque zero");
  had_torque_ = has_torque;
}

std::string Cia402Node::report() const {
  const PdoCounts& pdos = pdos_.counts();
  const JointState& joint = drive_.plant().state();
  return format("report nmt=%s power=%s syncs=%ld longest_sync_gap_us=%lld", to_text(nmt_),
                strainwave::can_nodes::to_text(drive_.power()), syncs_,
                static_cast<long long>(longest_sync_gap_us_)) +
         format(" rpdos=%ld superseded=%ld syncs_without_rpdo=%ld tpdos=%ld", pdos.received, pdos.superseded,
                pdos.syncs_without_rpdo, pdos.transmitted) +
         format(" position_rad=%.6f velocity_rad_s=%.6f torque_Nm=%.4f", joint.position_rad,
                joint.velocity_rad_s, drive_.torque_demand_Nm());
}

}  // namespace strainwave::can_nodes
