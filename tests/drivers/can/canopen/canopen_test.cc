// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/can/canopen/canopen.h"

#include <gtest/gtest.h>

#include "drivers/can/can_detail.h"
#include "drivers/can/cia402/cia402_node.h"

namespace strainwave::canopen {
namespace {

CanFrame frame(std::uint32_t id, std::initializer_list<std::uint8_t> bytes) {
  CanFrame result;
  result.id = id;
  for (const std::uint8_t byte : bytes) result.bytes[result.size++] = byte;
  return result;
}

TEST(Canopen, HasTheStandardsNetworkManagement) {
  EXPECT_EQ(nmt_frame(NmtCommand::kStart, 3), frame(0x000, {0x01, 3}));
  EXPECT_EQ(nmt_frame(NmtCommand::kStop, 3), frame(0x000, {0x02, 3}));
  EXPECT_EQ(nmt_frame(NmtCommand::kEnterPreOperational, 0), frame(0x000, {0x80, 0}));
  EXPECT_EQ(nmt_frame(NmtCommand::kResetCommunication, 127), frame(0x000, {0x82, 127}));
  EXPECT_EQ(sync_frame(), frame(0x080, {}));
  EXPECT_EQ(heartbeat_frame(127, NmtState::kOperational), frame(0x77F, {0x05}));
}

TEST(Canopen, TakesOnlyHeartbeatsThatTheStandardKnows) {
  EXPECT_EQ(decode_heartbeat(frame(0x703, {0x00})), NmtState::kBootUp);
  EXPECT_EQ(decode_heartbeat(frame(0x703, {0x05})), NmtState::kOperational);
  int known = 0;
  for (int byte = 0; byte <= 0xFF; ++byte)
    known += decode_heartbeat(frame(0x703, {static_cast<std::uint8_t>(byte)})).has_value() ? 1 : 0;
  EXPECT_EQ(known, 4);
  EXPECT_FALSE(decode_heartbeat(frame(0x703, {})));
  EXPECT_FALSE(decode_heartbeat(frame(0x703, {0x05, 0x00})));
}

TEST(Canopen, DecodesAnEmergencyOfExactlyEightBytes) {
  const auto emergency = decode_emergency(frame(0x083, {0x30, 0x81, 0x11, 1, 2, 3, 4, 5}));
  ASSERT_TRUE(emergency);
  EXPECT_EQ(emergency->code, 0x8130);
  EXPECT_EQ(emergency->error_register, 0x11);
  EXPECT_FALSE(decode_emergency(frame(0x083, {0x30, 0x81, 0x11, 1, 2, 3, 4})));
}

TEST(Canopen, PutsEveryEmergencyCodeIntoWords) {
  for (std::uint32_t code = 0; code <= 0xFFFF; ++code)
    EXPECT_FALSE(emergency_text(static_cast<std::uint16_t>(code)).empty()) << code;
  EXPECT_EQ(emergency_text(0x4310), "drive temperature: too hot");
  EXPECT_EQ(emergency_text(0x43FF), "temperature") << "a vendor's code is known by its class";
  EXPECT_EQ(emergency_text(0x8130), "bus: our heartbeat was missed");
  EXPECT_EQ(emergency_text(0xFF07), "device-specific");
}

TEST(DriveErrorText, TellsTheDrivesNumbersFromOurs) {
  EXPECT_EQ(cia402::drive_error_text(drive_error_of({0x3220, 0x05})),
            "emergency 3220h, under-voltage of the supply (register 05h)");
  const std::string ours =
      cia402::drive_error_text(strainwave::drive_error_of(CanDetail::kNetworkState, 0x7F));
  EXPECT_NE(ours.find("pre-operational"), std::string::npos) << ours;
  for (std::uint32_t detail = 1; detail <= 17; ++detail)
    EXPECT_EQ(cia402::drive_error_text(detail << 24U).find("unknown"), std::string::npos) << detail;
}

}  // namespace
}  // namespace strainwave::canopen
