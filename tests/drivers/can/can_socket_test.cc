// SPDX-License-Identifier: BSD-3-Clause
// The checks of the socket that need no kernel with CAN. The rest is tested in the virtual machine.
#include "drivers/can/can_socket.h"

#include <gtest/gtest.h>
#include <linux/can/error.h>

#include "tests/support/refusal.h"

namespace strainwave {
namespace {

using Bytes = std::array<std::uint8_t, kMaxCanBytes>;

bool has(std::uint32_t troubles, CanTrouble trouble) {
  return (troubles & static_cast<std::uint32_t>(trouble)) != 0;
}

TEST(CanErrorFrame, TellsBusOffFromEverythingElse) {
  EXPECT_TRUE(has(troubles_of(CAN_ERR_BUSOFF, Bytes{}), CanTrouble::kBusOff));
  EXPECT_FALSE(has(troubles_of(CAN_ERR_ACK | CAN_ERR_RESTARTED, Bytes{}), CanTrouble::kBusOff));
}

TEST(CanErrorFrame, TellsTheControllersState) {
  for (const int passive : {CAN_ERR_CRTL_RX_PASSIVE, CAN_ERR_CRTL_TX_PASSIVE}) {
    const std::uint32_t troubles = troubles_of(CAN_ERR_CRTL, Bytes{0, static_cast<std::uint8_t>(passive)});
    EXPECT_TRUE(has(troubles, CanTrouble::kErrorPassive));
    EXPECT_FALSE(has(troubles, CanTrouble::kErrorWarning));
  }
  EXPECT_TRUE(has(troubles_of(CAN_ERR_CRTL, Bytes{0, CAN_ERR_CRTL_ACTIVE}), CanTrouble::kErrorActive));
  EXPECT_EQ(troubles_of(CAN_ERR_BUSERROR, Bytes{0, CAN_ERR_CRTL_TX_PASSIVE}), 0U)
      << "only CAN_ERR_CRTL fills byte 1";
}

TEST(CanSocket, SaysWhatToDoWhenThereIsNoInterface) {
  const std::string text = testing::refusal_of([&] { const CanSocket socket("no-such-can", {}); });
  const bool helpful = text.find("can_raw") != std::string::npos || text.find("ip link") != std::string::npos;
  EXPECT_TRUE(helpful) << text;
}

}  // namespace
}  // namespace strainwave
