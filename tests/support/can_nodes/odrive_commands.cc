// SPDX-License-Identifier: BSD-3-Clause
// Commands that make a simulated ODrive misbehave, one per line; numbers in C's notation (0x.. is hexadecimal):
//
//   cut | reconnect               the cable: no frame in or out; the drive keeps running
//   reboot [MS]                   power off and on; silent for MS (default: its boot time)
//   error BITS                    an axis error, which disarms
//   firmware MAJOR MINOR REVISION
//   skip-encoder COUNT            the next COUNT encoder messages are missing
//   bad-encoder on|off            estimates that are not a number
//   heartbeat on|off
//   arming on|off                 off: it never reaches closed loop
//   mode CONTROL INPUT            another client changed the controller's mode
//   bus VOLT                      the supply
//   note-torque on|off            record the beginning and the end of torque
//   report
#include "tests/support/can_nodes/odrive_node.h"
#include "tests/support/can_nodes/text.h"

namespace strainwave::can_nodes {

std::string OdriveNode::command(std::string_view line, std::int64_t now_us) {
  advance(now_us);
  const std::vector<std::string> words = words_of(line);
  if (words.empty()) return "";
  output_.note("command " + std::string(line));
  const std::string& verb = words[0];
  std::vector<std::int64_t> n;
  double number = 0.0;
  bool on = false;

  if ((verb == "cut" || verb == "reconnect") && words.size() == 1) {
    cable_cut_ = verb == "cut";
  } else if (verb == "reboot" && (words.size() == 1 || numbers_of(words, 1, n))) {
    boot();
    if (!n.empty()) boot_done_us_ = now_us + n[0] * 1000;
  } else if (verb == "error" && numbers_of(words, 1, n)) {
    disarm(static_cast<std::uint32_t>(n[0]));
  } else if (verb == "firmware" && numbers_of(words, 3, n)) {
    for (std::size_t i = 0; i < 3; ++i) config_.version.firmware[i] = static_cast<std::uint8_t>(n[i]);
  } else if (verb == "skip-encoder" && numbers_of(words, 1, n)) {
    skipped_encoders_ = n[0];
  } else if (verb == "bad-encoder" && switch_of(words, on)) {
    wrong_encoder_ = on;
  } else if (verb == "heartbeat" && switch_of(words, on)) {
    heartbeat_off_ = !on;
  } else if (verb == "arming" && switch_of(words, on)) {
    refuses_to_arm_ = !on;
  } else if (verb == "mode" && numbers_of(words, 2, n)) {
    control_mode_ = static_cast<std::uint32_t>(n[0]);
    input_mode_ = static_cast<std::uint32_t>(n[1]);
  } else if (verb == "bus" && number_of(words, number)) {
    bus_V_ = number;
  } else if (verb == "note-torque" && switch_of(words, on)) {
    notes_torque_ = on;
  } else if (verb == "report" && words.size() == 1) {
    output_.note(report());
  } else {
    return "unknown command, or wrong arguments: " + std::string(line);
  }
  return "";
}

}  // namespace strainwave::can_nodes
