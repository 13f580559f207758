// SPDX-License-Identifier: BSD-3-Clause
// Shared by tests of drives that close their own loop: one enabled drive on a bus in virtual time.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/drivers/can/drive_bench.h"

namespace strainwave::testing {

inline constexpr double kOwnLoopInitial_rad = 0.4;
inline constexpr double kOwnLoopCount_rad = 2.0 * M_PI / 320000;

inline BenchDrive own_loop(DriveMode mode) {
  BenchDrive drive = bench_drive(3);
  drive.config.drive_mode = mode;
  drive.config.following_error_rad = 0.1;
  drive.config.units.velocity_rad_s_per_unit = kOwnLoopCount_rad;
  drive.node.drive.has_cst = drive.node.drive.has_tq = false;
  drive.node.drive.has_csp = drive.node.drive.has_csv = true;
  drive.node.drive.plant.initial_position_rad = kOwnLoopInitial_rad;
  return drive;
}

class OwnLoop {
 public:
  explicit OwnLoop(const BenchDrive& drive) : bench({drive}) {
    bench.start();
    enable();
  }
  void enable() {
    // The joint loop gives this order while a joint is not controlled.
    for (int i = 0; i < 200 && bench.reading().drive_state != DriveState::kEnabled; ++i) hold();
    EXPECT_EQ(bench.reading().drive_state, DriveState::kEnabled);
  }
  void hold() { bench.step({0.0, true, bench.reading().joint_position_rad, 0.0}); }
  /// Turns the joint at `velocity_rad_s`. Returns the largest distance to the position ordered for that instant, in the second half.
  double largest_error_rad(double velocity_rad_s, int periods) {
    double ordered_rad = bench.reading().joint_position_rad;
    double due_rad = ordered_rad;
    double largest_rad = 0.0;
    for (int i = 0; i < periods; ++i) {
      // The drive reaches an ordered position at the end of its period, and the next period reads it.
      const double due_next_rad = ordered_rad;
      ordered_rad += velocity_rad_s * 1e-3;
      bench.step({0.0, true, ordered_rad, velocity_rad_s});
      if (i > periods / 2)
        largest_rad = std::max(largest_rad, std::abs(bench.reading().joint_position_rad - due_rad));
      due_rad = due_next_rad;
    }
    return largest_rad;
  }
  std::uint64_t controlword() { return little_endian(bench.frames(0x203, 0).back().bytes.data(), 2); }
  double position_rad() { return bench.node().drive().plant().state().position_rad; }

  DriveBench bench;
};

}  // namespace strainwave::testing
