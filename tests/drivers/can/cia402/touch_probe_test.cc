// SPDX-License-Identifier: BSD-3-Clause
// A joint that is homed by the index of its encoder: touch probe 1 of the drive, alone and on the bus.
#include "drivers/can/cia402/touch_probe.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/drivers/can/drive_bench.h"

namespace strainwave::testing {
namespace {

using cia402::ProbeSource;
using cia402::TouchProbe;

TEST(TouchProbe, ArmsForTheRisingEdgeOfWhatItIsToldAndOfNothingElse) {
  TouchProbe index(ProbeSource::kIndex);
  TouchProbe input(ProbeSource::kInput);
  TouchProbe none;
  for (TouchProbe* probe : {&index, &input, &none}) {
    EXPECT_EQ(probe->function(), 0) << "whatever the drive was told before";
    EXPECT_FALSE(probe->see(0));
  }
  EXPECT_EQ(index.function(), 0x0015);
  EXPECT_EQ(input.function(), 0x0011);
  EXPECT_EQ(none.function(), 0);
}

TEST(TouchProbe, CountsAPulseOnceAndTheSamePulseAgainAfterAnotherArming) {
  TouchProbe probe(ProbeSource::kIndex);
  EXPECT_FALSE(probe.see(3)) << "latched before we armed it";
  EXPECT_FALSE(probe.see(0));
  EXPECT_FALSE(probe.see(1));
  EXPECT_TRUE(probe.see(3));
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(probe.see(3));
  EXPECT_EQ(probe.function(), 0) << "disarmed until the drive says so";
  EXPECT_FALSE(probe.see(0));
  EXPECT_EQ(probe.function(), 0x0015);
  EXPECT_TRUE(probe.see(3));
}

TEST(TouchProbe, ForgetsWhatARestartedDriveLatched) {
  TouchProbe probe(ProbeSource::kIndex);
  (void)probe.see(0);
  probe.restart();
  EXPECT_EQ(probe.function(), 0);
  EXPECT_FALSE(probe.see(3));
}

BenchDrive drive_with_index() {
  BenchDrive drive = bench_drive(3);
  drive.config.inputs.index = ProbeSource::kIndex;
  return drive;
}

// One turn of the motor, at the joint. The drive gives one index pulse per turn.
constexpr double kPulseEvery_rad = 2.0 * std::numbers::pi / 50.0;

TEST(Cia402Index, IsLatchedByTheDriveWhereItIsWhateverTheJointDoesMeanwhile) {
  DriveBench bench({drive_with_index()});
  bench.start();
  ASSERT_TRUE(bench.enable());
  std::int64_t pulses = bench.reading().inputs.index_count;
  int seen = 0;
  // The joint moves back and forth over the same pulses.
  for (int period = 0; period < 3000; ++period) {
    bench.step({period / 500 % 2 == 0 ? 3.0 : -3.0, true});
    const JointInputs& inputs = bench.reading().inputs;
    if (inputs.index_count == pulses) continue;
    ASSERT_EQ(inputs.index_count, pulses + 1) << "one at a time";
    pulses = inputs.index_count;
    ++seen;
    const double turns = inputs.index_position_rad / kPulseEvery_rad;
    EXPECT_NEAR(turns, std::round(turns), 1e-3) << "at the pulse, not where the joint is by now";
  }
  EXPECT_GE(seen, 4);
  EXPECT_EQ(bench.reading().fault, ActuatorFault::kNone);
}

TEST(Cia402Index, AJointThatStandsStillHasNone) {
  DriveBench bench({drive_with_index()});
  bench.start();
  bench.run(200, {0.0, false});
  EXPECT_EQ(bench.reading().inputs.index_count, 0);
}

TEST(Cia402Index, NeedsADriveWithATouchProbe) {
  BenchDrive drive = drive_with_index();
  drive.node.lacks = {0x60B8};
  DriveBench bench({drive});
  EXPECT_NE(bench.start_refusal().find("60B8h"), std::string::npos);
}

}  // namespace
}  // namespace strainwave::testing
