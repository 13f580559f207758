// SPDX-License-Identifier: BSD-3-Clause
// A simulated CANopen servo drive: network management, SYNC, heartbeats, EMCY, SDO and PDO around
// servo_drive.h. It is written from the standards alone and shares no code with drivers/, so that errors in
// either one show. Time is an argument and frames go to a NodeOutput: it uses no sockets and no clocks.
// Commands make it misbehave (command()). Source: CiA 301 (4.2.0), CiA 402-2, CiA 402-3.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/can_nodes/heartbeat_consumer.h"
#include "tests/support/can_nodes/node.h"
#include "tests/support/can_nodes/object_dictionary.h"
#include "tests/support/can_nodes/pdo_table.h"
#include "tests/support/can_nodes/sdo_server.h"
#include "tests/support/can_nodes/servo_drive.h"

namespace strainwave::can_nodes {

struct Cia402NodeConfig {
  std::uint8_t node_id = 1;
  std::uint32_t vendor = 0x000000FB;
  std::uint32_t product = 0x61500000;
  std::uint32_t revision = 0x01700000;
  std::uint32_t serial = 0x00000001;
  std::string device_name = "Strainwave simulated servo drive";
  std::int64_t boot_us = 50000;  ///< from power-on or reset to the boot-up message
  std::int64_t start_us = 0;     ///< from NMT start to operational
  std::int64_t sdo_answer_us = 0;
  std::int64_t late_at_rate_us = 0;    ///< like the command late-tpdo-at-rate
  std::vector<std::uint16_t> lacks{};  ///< indices that this drive does not have
  std::vector<Key> read_only{};        ///< entries that are writable in other drives
  ServoDriveConfig drive;
};

enum class NmtState : std::uint8_t { kBooting = 0, kStopped = 4, kOperational = 5, kPreOperational = 127 };
/// The state's name in the record.
const char* to_text(NmtState state);

class Cia402Node final : public Node {
 public:
  /// Throws InputError for an impossible drive.
  Cia402Node(const Cia402NodeConfig& config, NodeOutput& output);

  void power_on(std::int64_t now_us) override;
  void receive(const Frame& frame, std::int64_t now_us) override;
  /// Does everything that is due by `now_us`. Call it at next_deadline_us().
  void advance(std::int64_t now_us) override;
  std::int64_t next_deadline_us() const override;

  /// Obeys one line that makes the node misbehave; cia402_commands.cc lists them. Returns the error in the line, or nothing.
  std::string command(std::string_view line, std::int64_t now_us) override;

  NmtState nmt() const { return nmt_; }
  const ServoDrive& drive() const { return drive_; }
  ObjectDictionary& dictionary() { return dictionary_; }
  const PdoCounts& pdo_counts() const { return pdos_.counts(); }

 private:
  static constexpr int kErrorHistory = 8;
  void add_objects();
  void written(Key key);
  void send(const Frame& frame);
  void change_nmt(NmtState state);
  void obey_nmt(const Frame& frame);
  enum class Reset { kNode, kCommunication };
  void reset(Reset what);
  void leave_operation();
  void finish_boot();
  void finish_start();
  void on_sync();
  void step_drive();
  void send_synchronous();
  void send_emergency(std::uint16_t code);
  void on_heartbeat_lost(std::uint8_t node_id);
  void answer_sdo(const Frame& frame);
  void receive_pdo(const Frame& frame);
  void note_power(PowerState from, PowerState to);
  void note_torque();
  std::string report() const;
  std::int64_t sync_period_us() const;

  Cia402NodeConfig config_;
  NodeOutput& output_;
  ObjectDictionary dictionary_;
  HeartbeatConsumer consumer_;
  PdoTable pdos_;
  SdoServer sdo_;
  ServoDrive drive_;

  std::int64_t now_us_ = 0;
  NmtState nmt_ = NmtState::kBooting;
  std::int64_t boot_done_us_ = 0;
  std::optional<std::int64_t> start_done_us_;
  std::int64_t next_heartbeat_us_ = 0;
  std::int64_t next_step_us_ = 0;  ///< of the drive's own clock, without a SYNC
  std::optional<std::int64_t> last_sync_us_;
  long syncs_ = 0;
  std::int64_t longest_sync_gap_us_ = 0;

  // Misbehaviour that commands request.
  bool cable_cut_ = false;
  bool heartbeat_off_ = false;
  bool ignores_nmt_ = false;
  long skipped_syncs_ = 0;
  long late_syncs_ = 0;
  std::int64_t late_us_ = 0;
  std::int64_t late_at_rate_us_ = config_.late_at_rate_us;  ///< unless the last SYNC was 10 ms ago or more
  struct Late {
    std::int64_t due_us;
    Frame frame;
  };
  std::deque<Late> late_;
  std::deque<Late> answers_;
  bool notes_torque_ = false;
  bool had_torque_ = false;
};

}  // namespace strainwave::can_nodes
