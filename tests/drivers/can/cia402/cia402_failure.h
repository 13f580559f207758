// SPDX-License-Identifier: BSD-3-Clause
// Shared by tests of failures: a joint that moves under torque on a bus in virtual time.
#pragma once

#include <gtest/gtest.h>

#include "drivers/can/can_detail.h"
#include "tests/drivers/can/drive_bench.h"

namespace strainwave::testing {

class Cia402Failure : public ::testing::Test {
 protected:
  Cia402Failure() {
    bench_.start();
    EXPECT_TRUE(bench_.enable());
    bench_.run(50, kMoving);
  }
  void expect_fault(ActuatorFault fault, CanDetail detail) {
    EXPECT_EQ(bench_.reading().fault, fault);
    EXPECT_EQ(detail_of(bench_.reading().drive_error), detail)
        << can_detail_text(bench_.reading().drive_error);
  }
  /// The controlword and the torque of the last order to the drive.
  std::uint64_t last_controlword() { return little_endian(last_order().bytes.data(), 2); }
  std::uint64_t last_torque() { return little_endian(&last_order().bytes[2], 2); }
  CanFrame last_order() { return bench_.frames(0x203, 0).back(); }
  bool drive_has_torque() { return bench_.node().drive().torque_demand_Nm() != 0.0; }

  static constexpr ActuatorCommand kMoving{10.0, true};
  DriveBench bench_{{bench_drive(3)}};
};

}  // namespace strainwave::testing
