// SPDX-License-Identifier: BSD-3-Clause
// Commands that make a simulated drive misbehave, one per line; numbers in C's notation (0x.. is hexadecimal):
//
//   cut | reconnect               the cable: no frame in or out; the drive keeps running
//   reboot [MS]                   power off and on; silent for MS (default: its boot time)
//   emcy CODE                     a fault of the drive with this error code, and its reaction
//   pretend INDEX SUB VALUE       show this value to every reader (6061h: wrong mode; 1018h: wrong identity; 6076h: unit)
//   pretend nothing
//   skip-tpdo COUNT               no TPDO at the next COUNT SYNCs
//   late-tpdo US COUNT            TPDOs late by US at the next COUNT SYNCs
//   late-tpdo-at-rate US          the same, but never at a SYNC that comes 10 ms after the last one or later
//   heartbeat on|off              the producer
//   ignore-nmt on|off             ignore network management
//   refuse INDEX SUB ABORT        answer SDOs to this object with the abort code; 0: no longer
//   load TORQUE_NM                an external torque on the joint
//   note-torque on|off            record the beginning and the end of torque
//   clear | report                the counts
#include "tests/support/can_nodes/cia402_node.h"
#include "tests/support/can_nodes/text.h"

namespace strainwave::can_nodes {

namespace {

Key key_of(const std::vector<std::int64_t>& numbers) {
  return {static_cast<std::uint16_t>(numbers[0]), static_cast<std::uint8_t>(numbers[1])};
}

}  // namespace

std::string Cia402Node::command(std::string_view line, std::int64_t now_us) {
  advance(now_us);
  const std::vector<std::string> words = words_of(line);
  if (words.empty()) return "";
  output_.note("command " + std::string(line));
  const std::string& verb = words[0];
  std::vector<std::int64_t> n;
  bool on = false;
  double number = 0.0;

  if ((verb == "cut" || verb == "reconnect") && words.size() == 1) {
    cable_cut_ = verb == "cut";
  } else if (verb == "reboot" && (words.size() == 1 || numbers_of(words, 1, n))) {
    reset(Reset::kNode);
    if (!n.empty()) boot_done_us_ = now_us + n[0] * 1000;
  } else if (verb == "emcy" && numbers_of(words, 1, n)) {
    drive_.raise_error(static_cast<std::uint16_t>(n[0]));
  } else if (verb == "pretend" && words.size() == 2 && words[1] == "nothing") {
    dictionary_.pretend_nothing();
  } else if (verb == "pretend" && numbers_of(words, 3, n)) {
    if (dictionary_.find(key_of(n)) == nullptr) return "no such object";
    dictionary_.pretend(key_of(n), n[2]);
  } else if (verb == "skip-tpdo" && numbers_of(words, 1, n)) {
    skipped_syncs_ = n[0];
  } else if (verb == "late-tpdo" && numbers_of(words, 2, n)) {
    late_us_ = n[0];
    late_syncs_ = n[1];
  } else if (verb == "late-tpdo-at-rate" && numbers_of(words, 1, n)) {
    late_at_rate_us_ = n[0];
  } else if (verb == "heartbeat" && switch_of(words, on)) {
    heartbeat_off_ = !on;
  } else if (verb == "ignore-nmt" && switch_of(words, on)) {
    ignores_nmt_ = on;
  } else if (verb == "refuse" && numbers_of(words, 3, n)) {
    sdo_.refuse(key_of(n), static_cast<Abort>(n[2]));
  } else if (verb == "load" && number_of(words, number)) {
    drive_.set_load_torque_Nm(number);
  } else if (verb == "note-torque" && switch_of(words, on)) {
    notes_torque_ = on;
  } else if (verb == "clear" && words.size() == 1) {
    pdos_.clear_counts();
    syncs_ = 0;
    longest_sync_gap_us_ = 0;
  } else if (verb == "report" && words.size() == 1) {
    output_.note(report());
  } else {
    return "unknown command, or wrong arguments: " + std::string(line);
  }
  return "";
}

}  // namespace strainwave::can_nodes
