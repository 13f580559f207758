// SPDX-License-Identifier: BSD-3-Clause
// Words of the vocabulary for numbers. tests/docs/vocabulary_test checks its data.
#include "strainwave/vocabulary.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "lcmtypes/oscillation_evidence.h"
#include "lcmtypes/reading_doubt.h"

namespace strainwave {
namespace {

TEST(Vocabulary, HasATextForEveryNumberUpToTheLast) {
  for (int number = 0; number < kReasonCount; ++number)
    EXPECT_NE(to_text(static_cast<Reason>(number)), "unknown") << number;
}

TEST(Vocabulary, NamesANumberOfANewerVersionUnknown) {
  EXPECT_EQ(to_text(static_cast<Reason>(kReasonCount)), "unknown");
  EXPECT_EQ(to_text(static_cast<Mode>(-1)), "unknown");
  EXPECT_EQ(to_text(static_cast<Notice>(1 << 8)), "unknown");
  EXPECT_EQ(configuration_key(static_cast<Fault>(1000)), "");
}

TEST(FaultWords, SayWhatWasSeenOfAnOscillation) {
  const auto words = [](const OscillationEvidence& evidence) {
    return fault_words(Fault::kChatter, evidence_number(evidence));
  };
  EXPECT_EQ(
      words({86.2, 20.0, 1.5}),
      "torque oscillation: the torque reversed 86 times within a second, by up to 20 N.m; motions show 1.5 "
      "times the "
      "configured inertia: check load_inertia_kgm2 and motor_inertia_kgm2 (inertia_kgm2)");
  EXPECT_EQ(words({160.0, 34.0, 0.0}),
            "torque oscillation: the torque reversed 160 times within a second, by up to 34 N.m: check "
            "delay_periods, the "
            "encoder's side, the gear and the load");
  EXPECT_EQ(words({1e9, 1e9, 1e9}).find("4095 times"),
            std::string("torque oscillation: the torque reversed ").size());
}

TEST(FaultWords, SayWhichOfTheCausesOfFaultFiveItWas) {
  const Fault fault = Fault::kImplausibleReading;
  EXPECT_EQ(fault_words(fault, doubt_number(ReadingDoubt::kJump, 0.05)),
            "implausible reading: the position jumped by 0.05 rad from one reading to the next");
  EXPECT_EQ(fault_words(fault, doubt_number(ReadingDoubt::kStuck, 0.0002)),
            "implausible reading: the position stands still though the torque must have moved the joint by "
            "0.0002 rad");
  EXPECT_EQ(fault_words(fault, doubt_number(ReadingDoubt::kPositionNotFinite)),
            "implausible reading: the position is not a number");
  EXPECT_EQ(fault_words(fault, doubt_number(ReadingDoubt::kVelocityNotFinite)),
            "implausible reading: the velocity is not a number");
  EXPECT_EQ(fault_words(fault, doubt_number(ReadingDoubt::kTorqueNotFinite)),
            "implausible reading: the torque is not a number");
  EXPECT_EQ(fault_words(fault, doubt_number(ReadingDoubt::kCountsMissing)),
            "implausible reading: counts of the encoder are missing or wrong");
  EXPECT_EQ(fault_words(fault, doubt_number(ReadingDoubt::kJump, std::numeric_limits<double>::infinity())),
            "implausible reading: the position jumped by 16.7772 rad or more from one reading to the next");
  EXPECT_EQ(fault_words(fault, 0), "implausible reading");
  EXPECT_EQ(fault_words(fault, -1), "implausible reading") << "what a network sends";
  EXPECT_EQ(fault_words(Fault::kDriveFault, doubt_number(ReadingDoubt::kJump, 0.05)), "drive fault");
}

}  // namespace
}  // namespace strainwave
