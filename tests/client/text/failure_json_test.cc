// SPDX-License-Identifier: BSD-3-Clause
#include "client/text/failure_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/input_error.h"
#include "strainwave/client_error.h"

namespace strainwave {
namespace {

nlohmann::json json_of(ExitStatus status, const std::exception& error, const FailedCommand& command = {}) {
  return nlohmann::json::parse(to_json({status, error.what(), error}, command));
}
nlohmann::json json_of(const ProgramError& error, const FailedCommand& command = {}) {
  return json_of(error.status(), error, command);
}

TEST(FailureJson, HasTheReasonOfARefusalAndWhatIsAllowed) {
  const auto json = json_of(
      Refused("wrist: move to 100 rad refused (3, out of range): position_rad = 100: from -3.2 to 3.2 "
              "is allowed (joint.limits.position_min_rad and position_max_rad of wrist); positions are "
              "in rad: 100 degrees would be 1.74533",
              "wrist", Reason::kOutOfRange),
      {"move", {"elbow"}});
  EXPECT_EQ(json.at("error"), "refused");
  EXPECT_EQ(json.at("exit_status"), 1);
  EXPECT_EQ(json.at("command"), "move");
  EXPECT_EQ(json.at("joint"), "wrist") << "whose refusal it is, not whom the command line names first";
  EXPECT_EQ(json.at("reason"), 3);
  EXPECT_EQ(json.at("reason_text"), to_text(Reason::kOutOfRange));
  EXPECT_EQ(json.at("key"), "position_rad");
  EXPECT_EQ(json.at("given"), "100");
  EXPECT_EQ(json.at("allowed"), "from -3.2 to 3.2");
  EXPECT_FALSE(json.contains("fault"));
}

TEST(FailureJson, OfAPathHasTheKnotAndTheLimit) {
  const auto json = json_of(Refused(
      "elbow: its part of the path refused (3, out of range): elbow, knot 3 (at 1.25 s): acceleration in "
      "rad/s^2 = 120: at most 30 is allowed (joint.limits.acceleration_rad_s2)",
      "elbow", Reason::kOutOfRange));
  EXPECT_EQ(json.at("knot"), 3);
  EXPECT_EQ(json.at("key"), "joint.limits.acceleration_rad_s2");
  EXPECT_EQ(json.at("given"), "120");
  EXPECT_EQ(json.at("allowed"), "at most 30");
}

TEST(FailureJson, HasTheFault) {
  const auto json = json_of(Faulted("elbow: faulted", "elbow", Fault::kFollowingError));
  EXPECT_EQ(json.at("error"), "faulted");
  EXPECT_EQ(json.at("fault"), static_cast<int>(Fault::kFollowingError));
  EXPECT_EQ(json.at("fault_text"), to_text(Fault::kFollowingError));
  EXPECT_FALSE(json.contains("reason") || json.contains("allowed"));
}

TEST(FailureJson, HasTheLoadThatAJointYieldedToWhatWasAllowedAndWhere) {
  const auto json = json_of(Yielded("elbow: did not arrive at 0.5 rad: it yielded to a load of 13.1 N.m "
                                    "(load_Nm allows 12) at 0.3011 rad; it holds at 0.2871 rad",
                                    "elbow", {-13.1042, 12.0, 0.3011}),
                            {"move", {"wrist", "elbow"}});
  EXPECT_EQ(json.at("error"), "yielded");
  EXPECT_EQ(json.at("exit_status"), 1);
  EXPECT_EQ(json.at("joint"), "elbow");
  EXPECT_EQ(json.at("yield_load_Nm"), -13.1042);
  EXPECT_EQ(json.at("yield_limit_Nm"), 12.0);
  EXPECT_EQ(json.at("yield_position_rad"), 0.3011);
  EXPECT_FALSE(json.contains("reason") || json.contains("fault") || json.contains("allowed"));
}

TEST(FailureJson, OfSeveralJointsThatWereStoppedHasEach) {
  const std::vector<ClientError> each{Faulted("elbow: faulted", "elbow", Fault::kOverload),
                                      Yielded("wrist: yielded", "wrist", {-13.1042, 12.0, 0.3011})};
  const auto json = json_of(Faulted("elbow: faulted\nwrist: yielded", "elbow", Fault::kOverload, each),
                            {"move", {"elbow", "wrist", "hand"}});
  EXPECT_EQ(json.at("error"), "faulted");
  EXPECT_EQ(json.at("joints"), nlohmann::json({"elbow", "wrist", "hand"}));
  EXPECT_FALSE(json.contains("joint") || json.contains("fault"));
  ASSERT_EQ(json.at("failures").size(), 2U);
  EXPECT_EQ(json.at("failures")[0].at("joint"), "elbow");
  EXPECT_EQ(json.at("failures")[0].at("fault"), 24);
  EXPECT_EQ(json.at("failures")[1].at("joint"), "wrist");
  EXPECT_EQ(json.at("failures")[1].at("yield_load_Nm"), -13.1042);
}

TEST(FailureJson, NamesWhatWentWrongByTheExitStatus) {
  EXPECT_EQ(json_of(InvalidInput("x")).at("error"), "wrong input");
  EXPECT_EQ(json_of(NoAnswer("x")).at("error"), "no answer");
  EXPECT_EQ(json_of(NotDone("x")).at("error"), "not done");
  EXPECT_EQ(json_of(ClientError(ExitStatus::kInterrupted, "x")).at("error"), "interrupted");
  EXPECT_EQ(json_of(ExitStatus::kUsage, InputError("x")).at("error"), "wrong input");
  EXPECT_EQ(json_of(ExitStatus::kNoAnswer, std::runtime_error("x")).at("error"), "no answer");
}

TEST(FailureJson, FindsWhatIsAllowedInTheWordsOfFilesAndOptions) {
  const auto file =
      json_of(ExitStatus::kUsage, InputError("a.csv, line 2", "time_s", "abc", "a finite number is allowed"));
  EXPECT_EQ(file.at("key"), "time_s");
  EXPECT_EQ(file.at("given"), "abc");
  EXPECT_EQ(file.at("allowed"), "a finite number");
  const auto option =
      json_of(InvalidInput("--timeout_s: '0.01' is not a time-out: 0.1 to 3600 seconds are allowed"));
  EXPECT_EQ(option.at("allowed"), "0.1 to 3600 seconds");
  EXPECT_FALSE(option.contains("key"));
}

TEST(FailureJson, KeepsItsFormWhateverWasGiven) {
  const auto json = json_of(InvalidInput("'\x1b[2J\xff\"}' is no joint\nsecond line"));
  EXPECT_NE(json.at("text").get<std::string>().find("is no joint\nsecond line"), std::string::npos);
  EXPECT_EQ(json.at("text").get<std::string>().find('\x1b'), std::string::npos);
}

}  // namespace
}  // namespace strainwave
