// SPDX-License-Identifier: BSD-3-Clause
// Prints reference data of the C++ side for the tests of the Python package: bytes of every message type, a signature, an identity. One line each: a
// name, a space, and hex digits or a number.
#include <cstdint>
#include <iomanip>
#include <iostream>
#include <span>
#include <strainwave/ack_v1.hpp>
#include <strainwave/command_v1.hpp>
#include <strainwave/gain_table_v1.hpp>
#include <strainwave/inject_v1.hpp>
#include <strainwave/limits_v1.hpp>
#include <strainwave/path_v1.hpp>
#include <strainwave/setpoint_v1.hpp>
#include <strainwave/state_v1.hpp>
#include <strainwave/temperature_v1.hpp>
#include <strainwave/timing_v1.hpp>
#include <string>

#include "client/protocol/sender.h"
#include "lcmtypes/oscillation_evidence.h"
#include "lcmtypes/reading_doubt.h"
#include "lcmtypes/signing.h"
#include "lcmtypes/wire.h"

namespace {

using namespace strainwave;

void print(const std::string& name, std::span<const std::uint8_t> bytes) {
  std::cout << name << ' ' << std::hex << std::setfill('0');
  for (const std::uint8_t byte : bytes) std::cout << std::setw(2) << static_cast<int>(byte);
  std::cout << std::dec << '\n';
}

/// A message whose bytes after the fingerprint are 1, 2, 3, ..., so that every field has a different value.
template <typename Message>
void print_counting(const std::string& name) {
  std::vector<std::uint8_t> bytes = encode(Message{});
  for (std::size_t i = 8; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(i % 120 + 1);
  print(name, encode(*decode_exactly<Message>(bytes)));
}

/// fault_FAULT_DRIVE-ERROR: the text that describes the fault.
void print_words(Fault fault, std::uint32_t drive_error) {
  const std::string words = fault_words(fault, drive_error);
  print("fault_" + std::to_string(static_cast<int>(fault)) + "_" + std::to_string(drive_error),
        {reinterpret_cast<const std::uint8_t*>(words.data()), words.size()});
}

setpoint_v1 setpoint() {
  setpoint_v1 message{};
  message.utime = 1;
  message.session_id = -2;
  message.challenge = 3;
  message.sender_id = 4;
  message.sequence = 5;
  message.stream_id = 6;
  message.position_rad = 0.25;
  message.velocity_rad_s = -1.5;
  message.acceleration_rad_s2 = 1e-300;
  message.torque_Nm = -3.5;
  message.load_inertia_kgm2 = 0.125;
  message.at_cycle = 7;
  message.derivatives = 2;
  message.valid_for_s = 0.5;
  message.speed_limit_rad_s = 2.0;
  message.begins_stream = 1;
  message.approach = 1;
  message.acknowledge = 0;
  return message;
}

}  // namespace

int main() {
  print_counting<ack_v1>("ack_v1");
  print_counting<command_v1>("command_v1");
  print_counting<gain_table_v1>("gain_table_v1");
  print_counting<inject_v1>("inject_v1");
  print_counting<limits_v1>("limits_v1");
  print_counting<path_v1>("path_v1");
  print_counting<setpoint_v1>("setpoint_v1");
  print_counting<state_v1>("state_v1");
  print_counting<temperature_v1>("temperature_v1");
  print_counting<timing_v1>("timing_v1");
  for (const ReadingDoubt doubt : {ReadingDoubt::kJump, ReadingDoubt::kStuck, ReadingDoubt::kCountsMissing})
    for (const double size_rad : {2e-5, 0.05, 1e9})
      print_words(Fault::kImplausibleReading, doubt_number(doubt, size_rad));
  for (const double ratio : {0.0, 0.5, 0.75, 1.0, 1.25, 1.5, 9.0})
    print_words(Fault::kChatter, evidence_number({31.4, 20.3, ratio}));
  print_words(Fault::kDriveFault, 0x1234);
  SecretKey::Seed seed{};
  for (std::size_t i = 0; i < seed.size(); ++i) seed[i] = static_cast<std::uint8_t>(i);
  const SecretKey key(seed);
  std::vector<std::uint8_t> bytes = encode(setpoint());
  print("unsigned_setpoint", bytes);
  sign("SW.elbow.SETPOINT", key, bytes);
  print("signed_setpoint", bytes);
  print("public_key", key.public_key().bytes);
  std::cout << "identity " << Sender().sender_id() << '\n';
  return 0;
}
