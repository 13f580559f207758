// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/can/node_watch.h"

#include <gtest/gtest.h>

#include "drivers/can/set_up_state.h"

namespace strainwave {
namespace {

constexpr std::int64_t kTimeout_ns = 150'000'000;
constexpr std::uint32_t kMark = 1U << 31U;

struct Ready : SetUpState {
  Ready() {
    end(true);
    while (!look()) continue;
  }
};

TEST(NodeWatch, KeepsTheFirstFaultUntilItIsCleared) {
  NodeWatch watch(kTimeout_ns);
  watch.latch({});
  EXPECT_FALSE(watch.latched());
  watch.latch(watch.trouble(ActuatorFault::kReadFailed, CanDetail::kPositionMissing));
  watch.latch(watch.trouble(ActuatorFault::kConnectionLost, CanDetail::kHeartbeatMissing));
  EXPECT_EQ(watch.shown({}).fault, ActuatorFault::kReadFailed);
  watch.clear();
  EXPECT_EQ(watch.shown({}).fault, ActuatorFault::kNone);
}

TEST(NodeWatch, ShowsThePresentTroubleOnlyWhileNothingIsLatched) {
  NodeWatch watch(kTimeout_ns);
  const NodeFault present = watch.trouble(ActuatorFault::kConnectionLost, CanDetail::kHeartbeatMissing);
  EXPECT_EQ(watch.shown(present).fault, ActuatorFault::kConnectionLost);
  watch.latch(watch.trouble(ActuatorFault::kDriveFault, CanDetail::kFaultState));
  EXPECT_EQ(watch.shown(present).fault, ActuatorFault::kDriveFault);
}

TEST(NodeWatch, MissesAHeartbeatAfterItsTimeAndNotBefore) {
  NodeWatch watch(kTimeout_ns);
  const Ready setup;
  watch.hear(1000);
  EXPECT_EQ(watch.connection_trouble(setup, 1000 + kTimeout_ns).fault, ActuatorFault::kNone);
  EXPECT_EQ(watch.connection_trouble(setup, 1001 + kTimeout_ns).fault, ActuatorFault::kConnectionLost);
  watch.hear(1001 + kTimeout_ns);
  EXPECT_EQ(watch.connection_trouble(setup, 1001 + kTimeout_ns).fault, ActuatorFault::kNone);
}

TEST(NodeWatch, ExpectsNoHeartbeatOfADriveThatIsBeingSetUp) {
  const NodeWatch watch(kTimeout_ns);
  const SetUpState setup;
  EXPECT_EQ(watch.connection_trouble(setup, 100 * kTimeout_ns).fault, ActuatorFault::kNone);
}

TEST(NodeWatch, NamesTheBusBeforeTheSetUpAndTheSetUpBeforeTheHeartbeat) {
  NodeWatch watch(kTimeout_ns);
  SetUpState setup;
  setup.end(false);
  setup.look();
  EXPECT_EQ(detail_of(watch.connection_trouble(setup, 100 * kTimeout_ns).drive_error),
            CanDetail::kSetupFailed);
  watch.note_bus({ActuatorFault::kBusError, drive_error_of(CanDetail::kBusOff)});
  EXPECT_EQ(detail_of(watch.connection_trouble(setup, 0).drive_error), CanDetail::kBusOff);
  watch.note_bus({});
  EXPECT_EQ(detail_of(watch.connection_trouble(setup, 0).drive_error), CanDetail::kSetupFailed);
}

TEST(NodeWatch, MarksItsOwnDetailsAndNoTroubleStaysUnmarked) {
  NodeWatch watch(kTimeout_ns, kMark);
  watch.note_bus({ActuatorFault::kBusError, drive_error_of(CanDetail::kBusOff)});
  EXPECT_EQ(watch.connection_trouble(Ready(), 0).drive_error, kMark | drive_error_of(CanDetail::kBusOff));
  watch.note_bus({});
  EXPECT_EQ(watch.connection_trouble(Ready(), 0).drive_error, 0U);
  EXPECT_EQ(watch.trouble(ActuatorFault::kDriveFault, CanDetail::kEnableStep, 7).drive_error,
            kMark | drive_error_of(CanDetail::kEnableStep, 7));
}

}  // namespace
}  // namespace strainwave
