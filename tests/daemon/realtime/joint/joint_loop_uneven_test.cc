// SPDX-License-Identifier: BSD-3-Clause
// A rigid joint that matches table and configuration, on a drive that shares no code with ours (tests/support/strict_drive.h). Its SYNCs
// are uneven, its torques and positions late, and some positions are lost. There must be no fault, and the joint must arrive. Virtual time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <ostream>
#include <random>

#include "tests/support/joint_bench.h"
#include "tests/support/strict_drive.h"

namespace strainwave::testing {
namespace {

struct Uneven {
  int torque_lag = 0;
  int position_lag = 0;  ///< whole periods
  double sync_jitter_s = 0.0;
  double lost_share = 0.0;
};

std::ostream& operator<<(std::ostream& out, const Uneven& uneven) {
  return out << "torque " << uneven.torque_lag << " and position " << uneven.position_lag
             << " periods late, SYNC uneven by " << uneven.sync_jitter_s << " s, " << uneven.lost_share
             << " of the positions lost";
}

struct Moves {
  int faults = 0;
  double overshoot_rad = 0.0;  ///< the largest one
  double off_rad = 0.0;        ///< largest distance from the target at rest
};

class UnevenJoint {
 public:
  UnevenJoint(const Uneven& uneven, std::uint64_t seed) : random_(seed) {
    StrictDriveData data;
    data.torque_lag = uneven.torque_lag;
    data.position_delay_s += uneven.position_lag * 1e-3;
    data.sync_jitter_s = uneven.sync_jitter_s;
    data.lost_share = uneven.lost_share;
    data.seed = seed;
    auto drive = std::make_unique<StrictDrive>(data);
    drive_ = drive.get();
    JointLoopConfig config = demo_joint().loop;
    config.controller.delay_periods = 1 + uneven.torque_lag + uneven.position_lag;
    config.controller.encoder_resolution_rad = 2.0 * std::numbers::pi / data.counts_per_revolution;
    config.controller.motor = {1e9, 150.0, 19.1};
    config.missed_readings_limit = 1000;
    bench_.emplace(config, std::move(drive));
    bench_->run(0.05);
    bench_->bring_to_hold(0);
    bench_->run(0.3);
  }

  Moves move(int count) {
    Moves moves;
    for (int i = 0; i < count; ++i) {
      const double far_rad = i % 3 == 0 ? 0.02 : 0.4;
      move_to(std::uniform_real_distribution<double>(-far_rad, far_rad)(random_), moves);
    }
    return moves;
  }

  /// Moves there and back.
  Moves swing(int count) {
    Moves moves;
    for (int i = 0; i < 2 * count; ++i) move_to(i % 2 == 0 ? 0.3 : 0.0, moves);
    return moves;
  }

  /// The same, but the loop stalls for `periods` periods somewhere on each way.
  Moves swing_with_stalls(int count, int periods) {
    stall_periods_ = periods;
    return swing(count);
  }

 private:
  void move_to(double target_rad, Moves& moves) {
    const int stall_at = std::uniform_int_distribution<int>(1, 150)(random_);
    const double side = target_rad > position_rad() ? 1.0 : -1.0;
    EXPECT_EQ(bench_->move(0, target_rad), Reason::kAccepted);
    for (int k = 0; k < 1000; ++k) {
      if (k == stall_at) bench_->stall(stall_periods_);
      bench_->step();
      moves.overshoot_rad = std::max(moves.overshoot_rad, side * (position_rad() - target_rad));
    }
    moves.faults += bench_->mode(0) == Mode::kFaulted ? 1 : 0;
    moves.off_rad = std::max(moves.off_rad, std::abs(position_rad() - target_rad));
  }
  double position_rad() const { return drive_->joint().position_rad(); }

  std::mt19937_64 random_;
  StrictDrive* drive_ = nullptr;
  std::optional<JointBench> bench_;
  int stall_periods_ = 0;
};

void expect_sound(const Uneven& uneven, std::uint64_t seed) {
  const Moves moves = UnevenJoint(uneven, seed).move(100);
  EXPECT_EQ(moves.faults, 0) << uneven;
  EXPECT_LT(moves.off_rad, 1e-4) << uneven;
  EXPECT_LT(moves.overshoot_rad, 4e-3) << uneven;
}

TEST(UnevenDrive, IsNoFaultWhoseSyncIsATenthOfAPeriodLateAndWhosePositionsAreLostNowAndThen) {
  for (const int lag : {0, 1, 2}) {
    for (const double jitter_s : {0.0, 3e-5, 1e-4}) {
      expect_sound({lag, 0, jitter_s, 0.0}, 11);
      expect_sound({0, lag, jitter_s, 0.0}, 12);
    }
    for (const double share : {1e-3, 5e-2}) expect_sound({lag, 0, 3e-5, share}, 13);
  }
}

TEST(UnevenDrive, SwingsALongWayWithinAFifthOfAMilliradianWithTorquesOrPositionsUpToTwoPeriodsLate) {
  for (const Uneven& uneven :
       {Uneven{0, 0, 3e-5, 0.0}, {1, 0, 3e-5, 0.0}, {2, 0, 3e-5, 0.0}, {0, 2, 3e-5, 0.0}}) {
    const Moves moves = UnevenJoint(uneven, 14).swing(50);
    EXPECT_EQ(moves.faults, 0) << uneven;
    EXPECT_LT(moves.off_rad, 1e-4) << uneven;
    EXPECT_LT(moves.overshoot_rad, 2e-4) << uneven;
  }
}

// During a stall no SYNC is sent, so that the next reading is the position before it.
TEST(UnevenDrive, WhosePositionAfterAStallIsOfTheTimeBeforeMakesNoFault) {
  for (const int lag : {0, 1})
    for (const int periods : {1, 3}) {
      const Moves moves = UnevenJoint({lag, 0, 3e-5, 0.0}, 15).swing_with_stalls(60, periods);
      EXPECT_EQ(moves.faults, 0) << lag << ", " << periods;
      EXPECT_LT(moves.off_rad, 1e-4) << lag << ", " << periods;
    }
}

}  // namespace
}  // namespace strainwave::testing
