// The numbers of the vocabulary are on wires and in logs for ever: this list is written by hand, and only grows.
#include "lcmtypes/vocabulary.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <string>

#include "lcmtypes/oscillation_evidence.h"
#include "lcmtypes/reading_doubt.h"

namespace strainwave {
namespace {

template <typename Enum>
struct Word {
  int number;
  Enum value;
  const char* text;
};

constexpr Word<Mode> kModes[] = {{0, Mode::kOff, "off"},           {1, Mode::kStarting, "starting"},
                                 {2, Mode::kHolding, "holding"},   {3, Mode::kTracking, "tracking"},
                                 {4, Mode::kStopping, "stopping"}, {5, Mode::kFaulted, "faulted"},
                                 {6, Mode::kHoming, "homing"},     {7, Mode::kReleasing, "releasing"}};

constexpr Word<Fault> kFaults[] = {{0, Fault::kNone, "none"},
                                   {1, Fault::kReadFailed, "position reading failed"},
                                   {2, Fault::kWriteRefused, "torque command refused by the drive"},
                                   {3, Fault::kDriveFault, "drive fault"},
                                   {4, Fault::kPowerLost, "supply lost"},
                                   {5, Fault::kImplausibleReading, "implausible reading"},
                                   {6, Fault::kLinkLost, "link to the drive lost"},
                                   {7, Fault::kEmergencyStop, "emergency stop"},
                                   {8, Fault::kDriveRestarted, "drive restarted by itself"},
                                   {9, Fault::kBusError, "bus error"},
                                   {10, Fault::kStartTimeout, "drive did not enable in time"},
                                   {11, Fault::kStopTimeout, "joint did not stop in time"},
                                   {12, Fault::kPositionLimit, "position limit"},
                                   {13, Fault::kSpeedLimit, "speed limit"},
                                   {14, Fault::kFollowingError, "following error"},
                                   {15, Fault::kNotFinite, "not-a-number in the loop"},
                                   {16, Fault::kOverruns, "too many overruns in a row"},
                                   {17, Fault::kTemperatureLimit, "temperature limit"},
                                   {18, Fault::kGroup, "another joint of the group faulted"},
                                   {19, Fault::kHomingFailed, "homing failed"},
                                   {20, Fault::kLimitSwitch, "limit switch"},
                                   {21, Fault::kLoopStalled, "loop stalled"},
                                   {22, Fault::kPeriodsMissed, "too many periods missed"},
                                   {23, Fault::kBlocked, "joint is blocked"},
                                   {24, Fault::kOverload, "load too large"},
                                   {25, Fault::kTemperatureLost, "temperature lost"},
                                   {26, Fault::kChatter, "joint chatters"}};

constexpr Word<Notice> kNotices[] = {
    {1, Notice::kTorqueLimited, "torque limited"},
    {2, Notice::kTemperatureClamped, "temperature outside the table"},
    {4, Notice::kFallbackGains, "temperature-free gains in use"},
    {8, Notice::kSetpointExpired, "setpoint stream expired"},
    {16, Notice::kReadingMissed, "reading missed"},
    {32, Notice::kSpeedLimited, "speed limited"},
    {64, Notice::kNotHomed, "not homed"},
    {128, Notice::kAtLimitSwitch, "at a limit switch"},
    {512, Notice::kOffStream, "off the stream"},
    {1024, Notice::kPositionLate, "position late"},
    {2048, Notice::kOffTarget, "off target"},
    {4096, Notice::kLoadHigh, "load high"},
    {8192, Notice::kOtherInertia, "inertia not as told"},
    {16384, Notice::kPathPaused, "path paused"},
    {32768, Notice::kPathEnds, "path ends early"},
    {65536, Notice::kYielded, "yielded to a load"},
    {131072, Notice::kSamplesMissing, "samples missing"},
    {262144, Notice::kFrictionDiffers, "friction differs from the table"},
    {524288, Notice::kVelocitiesContradict, "velocities contradict positions"}};

constexpr Word<Reason> kReasons[] = {
    {0, Reason::kAccepted, "accepted"},
    {1, Reason::kMalformed, "malformed message"},
    {2, Reason::kNotFinite, "not a finite number"},
    {3, Reason::kOutOfRange, "out of range"},
    {4, Reason::kWrongMode, "not possible in this mode"},
    {5, Reason::kNoTable, "no gain table loaded"},
    {6, Reason::kUnknownJoint, "unknown joint"},
    {7, Reason::kWrongSession, "another session of the daemon"},
    {8, Reason::kOldSequence, "sequence not rising"},
    {9, Reason::kUnsigned, "not signed"},
    {10, Reason::kBadSignature, "wrong signature"},
    {11, Reason::kRoleNotAllowed, "role not allowed to do this"},
    {12, Reason::kTableDefect, "table has a defect"},
    {13, Reason::kTableIdentity, "table is for another joint"},
    {14, Reason::kTablePeriod, "table is for another period"},
    {15, Reason::kTableNotCertified, "table not certified for this joint"},
    {16, Reason::kFaulted, "joint is faulted"},
    {17, Reason::kBusy, "busy, try again"},
    {18, Reason::kMoving, "joint is moving"},
    {19, Reason::kNoPreviousTable, "no previous table"},
    {20, Reason::kUnknownAction, "unknown action"},
    {21, Reason::kTimedOut, "timed out"},
    {22, Reason::kDriveNotReady, "drive not ready"},
    {23, Reason::kSuperseded, "superseded by a newer command"},
    {24, Reason::kNotSimulated, "only a simulated drive takes injected faults"},
    {25, Reason::kStreamEnded, "setpoint stream has ended"},
    {26, Reason::kNotHomed, "joint is not homed"},
    {27, Reason::kAtLimitSwitch, "limit switch in that direction"},
    {28, Reason::kNoHoming, "no homing configured"},
    {29, Reason::kEnding, "daemon is ending"},
    {30, Reason::kTooOld, "order is too old"},
    {31, Reason::kNotOwner, "another client has the joint"},
    {32, Reason::kFarFromJoint, "stream begins far from the joint"},
    {33, Reason::kVelocitiesContradict, "velocities contradict positions"}};

constexpr Word<Action> kActions[] = {{1, Action::kEnable, "enable"},
                                     {2, Action::kDisable, "disable"},
                                     {3, Action::kHold, "hold"},
                                     {4, Action::kClearFault, "clear-fault"},
                                     {5, Action::kRevertTable, "revert-table"},
                                     {6, Action::kHome, "home"},
                                     {7, Action::kTakeOver, "take-over"},
                                     {8, Action::kRelease, "release"},
                                     {9, Action::kPause, "pause"},
                                     {10, Action::kResume, "resume"},
                                     {11, Action::kResetLearning, "reset-learning"},
                                     {12, Action::kFreezeLearning, "freeze-learning"},
                                     {13, Action::kResumeLearning, "resume-learning"}};

constexpr Word<TemperatureStatus> kTemperatureStatuses[] = {
    {0, TemperatureStatus::kValid, "valid"},
    {1, TemperatureStatus::kNeverSeen, "never seen"},
    {2, TemperatureStatus::kTooOld, "too old"},
    {3, TemperatureStatus::kOutOfRange, "out of range"},
    {4, TemperatureStatus::kTooFast, "changing too fast"},
    {5, TemperatureStatus::kNotChanging, "not changing"}};

constexpr Word<GainsInUse> kGains[] = {{0, GainsInUse::kNone, "none"},
                                       {1, GainsInUse::kPrimary, "scheduled"},
                                       {2, GainsInUse::kFallback, "temperature-free"}};

/// Each word has its number and text, and no other small number has a text.
template <typename Enum, std::size_t N>
void check(const Word<Enum> (&words)[N]) {
  std::set<int> known;
  std::set<std::string_view> texts;
  for (const Word<Enum>& word : words) {
    EXPECT_EQ(static_cast<int>(word.value), word.number) << word.text;
    EXPECT_EQ(to_text(static_cast<Enum>(word.number)), word.text) << word.number;
    known.insert(word.number);
    texts.insert(word.text);
  }
  EXPECT_EQ(texts.size(), N) << "two numbers share a text";
  for (int number = -3; number < 300; ++number) {
    if (known.contains(number)) continue;
    EXPECT_EQ(to_text(static_cast<Enum>(number)), "unknown")
        << number << " is new: add it to this list and to docs/";
  }
}

TEST(Vocabulary, OfModesIsFixed) {
  check(kModes);
}
TEST(Vocabulary, OfFaultsIsFixed) {
  check(kFaults);
}
TEST(Vocabulary, OfNoticesIsFixed) {
  check(kNotices);
}
TEST(Vocabulary, OfReasonsIsFixed) {
  check(kReasons);
}
TEST(Vocabulary, OfActionsIsFixed) {
  check(kActions);
}
TEST(Vocabulary, OfTemperatureStatusesIsFixed) {
  check(kTemperatureStatuses);
}
TEST(Vocabulary, OfGainsInUseIsFixed) {
  check(kGains);
}

TEST(Vocabulary, HasEveryReasonInTheCountsOfTheTimingMessage) {
  for (const auto& word : kReasons) EXPECT_LT(word.number, kReasonCount);
}

TEST(Vocabulary, HasOneBitPerNotice) {
  int all = 0;
  for (const auto& word : kNotices) {
    EXPECT_EQ(all & word.number, 0) << word.text;
    all |= word.number;
  }
}

TEST(FaultWords, SayWhatWasSeenOfAnOscillation) {
  const auto words = [](const OscillationEvidence& evidence) {
    return fault_words(Fault::kChatter, evidence_number(evidence));
  };
  EXPECT_EQ(words({86.2, 20.0, 1.5}),
            "joint chatters: the torque reversed 86 times within a second, by up to 20 N.m; motions show 1.5 "
            "times the "
            "configured inertia: check load_inertia_kgm2 and motor_inertia_kgm2 (inertia_kgm2)");
  EXPECT_EQ(words({160.0, 34.0, 0.0}),
            "joint chatters: the torque reversed 160 times within a second, by up to 34 N.m: check "
            "delay_periods, the "
            "encoder's side, the gear and the load");
  EXPECT_EQ(words({1e9, 1e9, 1e9}).find("4095 times"),
            std::string("joint chatters: the torque reversed ").size());
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
