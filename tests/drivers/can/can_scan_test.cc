// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/can/can_scan.h"

#include <gtest/gtest.h>

#include "tests/drivers/can/drive_bench.h"

namespace strainwave::testing {
namespace {

bool any_contains(const std::vector<std::string>& lines, const std::string& part) {
  for (const std::string& line : lines)
    if (line.find(part) != std::string::npos) return true;
  return false;
}

class CanScan : public ::testing::Test {
 protected:
  std::vector<ScannedNode> scan() {
    // Gives the drives time to boot.
    bench_.can().run_to(bench_.can().now_ns() + 200'000'000);
    return scan_can_bus(bench_.can().factory(), 20'000'000);
  }
  DriveBench bench_{{bench_drive(3), bench_drive(100)}};
};

TEST_F(CanScan, FindsEveryNodeWithIdentityModesAndTemperature) {
  const std::vector<ScannedNode> nodes = scan();
  ASSERT_EQ(nodes.size(), 2U);
  EXPECT_EQ(nodes[0].node_id, 3);
  EXPECT_EQ(nodes[1].node_id, 100);
  EXPECT_NE(nodes[0].identity.find("vendor 000000FBh"), std::string::npos) << nodes[0].identity;
  EXPECT_EQ(nodes[0].modes, "TQ CST");
  EXPECT_TRUE(any_contains(nodes[0].temperatures, "3201h:01")) << "it has one at 25 degC";
  EXPECT_TRUE(any_contains(nodes[0].temperatures, "raw 250"));
  EXPECT_TRUE(any_contains(nodes[0].mapped, "TPDO1 6041h:00 16 bit"));
  EXPECT_EQ(nodes[0].trouble, "");
}

TEST_F(CanScan, WritesNothingAndOrdersNothing) {
  (void)scan();
  for (const VirtualCan::Entry& entry : bench_.can().trace()) {
    if (entry.from_node) continue;
    ASSERT_GE(entry.frame.id, 0x601U) << "only SDO requests";
    ASSERT_LE(entry.frame.id, 0x67FU);
    const unsigned specifier = entry.frame.bytes[0] >> 5U;
    EXPECT_TRUE(specifier == 2 || specifier == 3 || specifier == 4) << "an upload, its segment, or giving up";
  }
}

TEST_F(CanScan, SaysWhatItCouldNotRead) {
  bench_.can().run_to(bench_.can().now_ns() + 200'000'000);
  bench_.tell_node("refuse 0x1018 1 0x08000022");
  const std::vector<ScannedNode> nodes = scan();
  ASSERT_EQ(nodes.size(), 2U);
  EXPECT_NE(nodes[0].trouble.find("1018h:01"), std::string::npos) << nodes[0].trouble;
  EXPECT_EQ(nodes[1].trouble, "");
}

}  // namespace
}  // namespace strainwave::testing
