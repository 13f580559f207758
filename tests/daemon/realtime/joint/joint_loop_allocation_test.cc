// SPDX-License-Identifier: BSD-3-Clause
// The real-time path allocates and frees nothing during commands, tables, faults and records. Virtual time.
#include <gtest/gtest.h>

#include "tests/support/allocation_trap.h"
#include "tests/support/flexible_bench.h"

namespace strainwave::testing {
namespace {

TEST(JointLoopAllocations, AreNoneInAMinuteOfCommandsTableSwapsAndFaults) {
  if (!AllocationTrap::available()) GTEST_SKIP() << "the sanitizer has its own malloc";
  std::vector<BenchJoint> joints(4, demo_joint());
  joints[0].loop.group = joints[1].loop.group = 0;
  joints[3] = flexible_joint();
  JointBench bench(joints);
  std::vector<std::unique_ptr<FlightRecorder>> recorders;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    recorders.push_back(std::make_unique<FlightRecorder>(1000, 100));
    bench.joint(i).record_into(*recorders.back());
    const GainTable& table = i == 3 ? flexible_table() : demo_table();
    bench.bring_to_hold(i, table);
    for (std::size_t slot = 1; slot < JointLoop::kTableSlots; ++slot)
      bench.joint(i).table_slot(slot) = {table, static_cast<std::int64_t>(slot + 1)};
  }
  std::int64_t faults = 0;
  std::int64_t swaps = 0;
  std::int64_t moves = 0;
  const AllocationTrap trap;
  for (int round = 0; round < 240; ++round) {
    for (std::size_t i = 0; i < joints.size(); ++i) {
      Order swap{0, OrderKind::kUseTable, round % 3, 0.0, 0.0, {}};
      swaps += bench.order(i, swap) == Reason::kAccepted ? 1 : 0;
      moves += bench.move(i, 0.1 * (round % 7), round % 2 == 0 ? 0.0 : 0.05) == Reason::kAccepted ? 1 : 0;
    }
    bench.run(0.1);
    const auto kind = static_cast<InjectedFault>(1 + round % (kInjectedFaultCount - 1));
    bench.inject(static_cast<std::size_t>(round) % 4, {kind, 0.0, 0.05, 0.02});
    bench.run(0.1);
    for (std::size_t i = 0; i < joints.size(); ++i) {
      faults += bench.fault(i) != Fault::kNone ? 1 : 0;
      bench.order(i, OrderKind::kClearFault);
      bench.order(i, OrderKind::kEnable);
      if (recorders[i]->frozen()) recorders[i]->release();
    }
    bench.run(0.06);
  }
  EXPECT_EQ(trap.touches(), 0);
  EXPECT_GT(faults, 50);
  EXPECT_GT(swaps, 50);
  EXPECT_GT(moves, 200);
  EXPECT_GE(bench.cycle(), 60'000);
}

}  // namespace
}  // namespace strainwave::testing
