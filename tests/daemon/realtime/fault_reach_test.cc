// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/fault_reach.h"

#include <gtest/gtest.h>

#include "lcmtypes/reading_doubt.h"

namespace strainwave {
namespace {

constexpr std::int32_t kFaults = 27;

TEST(FaultReach, IsAtOnceForWhateverTheLoopItselfFaultsWith) {
  for (const Fault fault : {Fault::kOverruns, Fault::kLoopStalled, Fault::kPeriodsMissed})
    EXPECT_EQ(others_stop(fault, 0), OthersStop::kAtOnce) << to_text(fault);
}

TEST(FaultReach, IsAtOnceForWhateverRunsIntoSomething) {
  for (const Fault fault : {Fault::kFollowingError, Fault::kBlocked, Fault::kOverload})
    EXPECT_EQ(others_stop(fault, 0), OthersStop::kAtOnce) << to_text(fault);
}

TEST(FaultReach, IsAtOnceForASensorThatStandsStillSinceABlockedJointLooksLikeIt) {
  for (const ReadingDoubt doubt :
       {ReadingDoubt::kPositionNotFinite, ReadingDoubt::kVelocityNotFinite, ReadingDoubt::kTorqueNotFinite,
        ReadingDoubt::kJump, ReadingDoubt::kStuck, ReadingDoubt::kCountsMissing})
    EXPECT_EQ(others_stop(Fault::kImplausibleReading, doubt_number(doubt, 0.01)),
              doubt == ReadingDoubt::kStuck ? OthersStop::kAtOnce : OthersStop::kAlongPath)
        << static_cast<int>(doubt);
}

TEST(FaultReach, IsAtOnceForANumberThatNobodyKnows) {
  EXPECT_EQ(to_text(static_cast<Fault>(kFaults)), "unknown") << "a new one is to be thought about";
  EXPECT_EQ(others_stop(static_cast<Fault>(kFaults), 0), OthersStop::kAtOnce);
}

TEST(FaultReach, IsAlongThePathForAJointThatIsNotFaulted) {
  EXPECT_EQ(others_stop(Fault::kNone, 0), OthersStop::kAlongPath);
}

}  // namespace
}  // namespace strainwave
