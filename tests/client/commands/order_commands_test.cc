// SPDX-License-Identifier: BSD-3-Clause
// Orders, their answers and the printed output.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <strainwave/command_v1.hpp>
#include <strainwave/inject_v1.hpp>
#include <vector>

#include "base/input_error.h"
#include "client/commands/sibling_program.h"
#include "client/protocol/interrupt.h"
#include "tests/client/commands/commands_fixture.h"
#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

using testing::CommandsTest;

TEST_F(CommandsTest, EachOrderSendsItsOwnAction) {
  daemon.publish_state();
  daemon.modes_after_answer = {Mode::kHolding};
  enable(client, output, "elbow");
  hold(client, output, "elbow");
  daemon.publish_state(Mode::kFaulted);
  while (connection.handle(0)) {
  }
  clear_fault(client, output, "elbow");
  revert_table(client, output, "elbow");
  daemon.modes_after_answer = {Mode::kHoming, Mode::kHolding};
  home(client, output, "elbow");
  daemon.modes_after_answer = {Mode::kOff};
  disable(client, output, {"elbow"});
  std::vector<std::int32_t> actions;
  for (const auto& heard : daemon.heard()) actions.push_back(decode_exactly<command_v1>(heard.bytes)->action);
  EXPECT_EQ(actions, (std::vector<std::int32_t>{1, 3, 4, 5, 6, 2}));
}

TEST_F(CommandsTest, OrdersAboutLearningSendTheirOwnActions) {
  daemon.publish_state();
  for (const Action action : {Action::kResetLearning, Action::kFreezeLearning, Action::kResumeLearning})
    order_learning(client, output, "elbow", action);
  std::vector<std::int32_t> actions;
  for (const auto& heard : daemon.heard()) actions.push_back(decode_exactly<command_v1>(heard.bytes)->action);
  EXPECT_EQ(actions, (std::vector<std::int32_t>{11, 12, 13}));
}

TEST_F(CommandsTest, FrictionShowsAFactorForEachRule) {
  daemon.state.rule_count = 2;
  daemon.state.friction_factor = 1.6;
  daemon.state.friction_age_s = 12.0;
  daemon.state.friction_learned_C = 18.0;
  daemon.state.friction_rule_C[1] = 45.0;
  daemon.state.friction_scales[1] = 0.6;
  daemon.publish_state();
  show_friction(client, output, "elbow");
  const std::string text = stream.str();
  for (const char* part : {"1.60 times", "+18.0 degC, 12 s ago", "0.0   1.00", "45.0   1.60"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in: " << text;
}

TEST_F(CommandsTest, AnInjectionCarriesKindAmountAndDuration) {
  daemon.publish_state();
  inject(client, output, parse_injection("elbow", "sensor_jump", 0.25, 1.5));
  ASSERT_EQ(daemon.heard().size(), 1U);
  EXPECT_TRUE(daemon.heard().front().channel.ends_with(".INJECT"));
  const auto injection = decode_exactly<inject_v1>(daemon.heard().front().bytes);
  ASSERT_TRUE(injection);
  EXPECT_EQ(injection->kind, static_cast<std::int32_t>(InjectedFault::kSensorJump));
  EXPECT_EQ(injection->amount, 0.25);
  EXPECT_EQ(injection->for_s, 1.5);
}

TEST_F(CommandsTest, AnUnknownInjectionNamesThoseThatThereAre) {
  EXPECT_EQ(status_of([&] { parse_injection("elbow", "gremlins", 0.0, 0.0); }), ExitStatus::kUsage);
  EXPECT_TRUE(message_has("gremlins") && message_has("sensor_nan") && message_has("power_lost")) << message;
}

TEST_F(CommandsTest, AnAmountOutOfRangeIsRefusedWithRangeAndUnit) {
  EXPECT_EQ(status_of([&] { parse_injection("elbow", "slow_read", 1.5, 0.0); }), ExitStatus::kUsage);
  EXPECT_TRUE(message_has("1.5") && message_has("0 to 1 s")) << message;
}

TEST_F(CommandsTest, EnableReturnsOnceTheJointHolds) {
  daemon.publish_state();
  daemon.modes_after_answer = {Mode::kOff, Mode::kStarting, Mode::kHolding};
  EXPECT_EQ(status_of([&] { enable(client, output, "elbow"); }), ExitStatus::kDone);
  EXPECT_EQ(client.find("elbow")->state.mode, static_cast<std::int32_t>(Mode::kHolding));
  EXPECT_TRUE(output_has("elbow: enabled"));
}

TEST_F(CommandsTest, GpioCheckSaysWhereItsHelperMustBe) {
  // The folder of this test program has no strainwaved.
  EXPECT_EQ(status_of([&] { gpio_check(output, "gpio.toml"); }), ExitStatus::kUsage);
  EXPECT_TRUE(message_has("strainwaved")) << message;
  EXPECT_TRUE(message_has("install it beside strainwavectl")) << message;
}

TEST(SiblingProgram, TellsItsStatusAndWhatItPrintedWhenAsked) {
  std::string printed;
  EXPECT_EQ(run_sibling("/bin/sh", {"-c", "echo one; echo two; echo aside >&2; exit 3"}, &printed), 3);
  EXPECT_EQ(printed, "one\ntwo\naside\n");
  // The output is larger than a pipe's buffer.
  EXPECT_EQ(run_sibling("/bin/sh", {"-c", "head -c 300000 /dev/zero"}, &printed), 0);
  EXPECT_EQ(printed.size(), 300014U);
  EXPECT_EQ(run_sibling("/bin/sh", {"-c", "kill -9 $$"}), 128 + 9);
}

// The signal comes between two programs of a sequence, or as one begins.
TEST(SiblingProgram, IsEndedByASignalWheneverItCame) {
  const std::filesystem::path made = ::testing::TempDir() + "sibling_program_ran";
  std::filesystem::remove(made);
  std::string printed;
  for (std::string* const captured : {static_cast<std::string*>(nullptr), &printed}) {
    catch_interrupts();
    std::raise(SIGTERM);
    EXPECT_EQ(run_sibling("/usr/bin/touch", {made}, captured), 128 + SIGTERM);
    EXPECT_FALSE(std::filesystem::exists(made));
    resume_after_interrupt();
    catch_interrupts();
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_EQ(run_sibling("/bin/sh", {"-c", "kill $PPID; exec sleep 100"}, captured), 128 + SIGTERM);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(60));
    resume_after_interrupt();
  }
}

TEST_F(CommandsTest, EnablePrintsTheReasonOfARefusal) {
  daemon.publish_state();
  daemon.reason = Reason::kNoTable;
  daemon.text = "load one first";
  EXPECT_EQ(status_of([&] { enable(client, output, "elbow"); }), ExitStatus::kRefused);
  EXPECT_EQ(message, "elbow: enable refused (5, no gain table loaded): load one first");
  EXPECT_EQ(stream.str(), "");
}

TEST_F(CommandsTest, EnableReportsAFaultDuringTheStart) {
  daemon.publish_state();
  daemon.state.fault = static_cast<std::int32_t>(Fault::kStartTimeout);
  daemon.modes_after_answer = {Mode::kStarting, Mode::kFaulted};
  EXPECT_EQ(status_of([&] { enable(client, output, "elbow"); }), ExitStatus::kRefused);
  EXPECT_TRUE(message_has("drive did not enable in time")) << message;
  EXPECT_TRUE(message_has("; once the cause is gone: strainwavectl clear-fault elbow")) << message;
}

TEST_F(CommandsTest, EnableThatNeverEndsIsNoSuccess) {
  daemon.publish_state();
  daemon.modes_after_answer = {Mode::kStarting};
  EXPECT_EQ(status_of([&] { enable(client, output, "elbow"); }), ExitStatus::kNoAnswer);
  EXPECT_EQ(message, "elbow: the order was accepted, then no state for 0.3 s; the last mode was starting");
  StateAfterState states(connection, daemon);
  daemon.publish_state();
  EXPECT_EQ(status_of([&] { enable(client, output, "elbow"); }), ExitStatus::kNoAnswer);
  EXPECT_TRUE(message_has("the order was accepted, but the joint is still starting after 0.3 s")) << message;
}

TEST_F(CommandsTest, DisableReachesAJointThatIsNotHeard) {
  daemon.modes_after_answer = {Mode::kStopping, Mode::kOff};
  EXPECT_EQ(status_of([&] { disable(client, output, {"elbow"}); }), ExitStatus::kDone);
  EXPECT_TRUE(output_has("elbow: disabled"));
}

TEST_F(CommandsTest, EnableAndClearFaultAreDoneAlreadyWhenThereIsNothingToDo) {
  daemon.publish_state(Mode::kHolding);
  enable(client, output, "elbow");
  EXPECT_TRUE(output_has("elbow: enabled already, holding at")) << stream.str();
  clear_fault(client, output, "elbow");
  EXPECT_TRUE(output_has("elbow: has no fault")) << stream.str();
  EXPECT_TRUE(daemon.heard().empty()) << "nothing was sent";
}

TEST_F(CommandsTest, DisableAllThatHearsNoJointSaysThatItStoppedNone) {
  EXPECT_EQ(status_of([&] { disable(client, output, {}); }), ExitStatus::kNoAnswer);
  EXPECT_TRUE(message_has("NO STOP WAS SENT")) << message;
  EXPECT_TRUE(message_has("strainwavectl disable JOINT")) << message;
}

TEST_F(CommandsTest, DisableAllGoesOnAfterAFailure) {
  FakeDaemon wrist(connection, "SW", "wrist");
  daemon.publish_state(Mode::kHolding);
  wrist.publish_state(Mode::kHolding);
  daemon.drop = 100;
  wrist.modes_after_answer = {Mode::kOff};
  EXPECT_EQ(status_of([&] { disable(client, output, {}); }), ExitStatus::kNoAnswer);
  EXPECT_TRUE(message_has("elbow: the stop was sent 8 times, and no answer came")) << message;
  EXPECT_TRUE(output_has("wrist: disabled"));
}

TEST_F(CommandsTest, EnableOfSeveralTellsEachOutcomeAndEndsAsTheWorst) {
  FakeDaemon wrist(connection, "SW", "wrist");
  daemon.publish_state(Mode::kFaulted);
  wrist.publish_state();
  daemon.reason = Reason::kFaulted;
  wrist.modes_after_answer = {Mode::kHolding};
  EXPECT_EQ(status_of([&] { order_each(client, output, {"elbow", "wrist"}, enable); }), ExitStatus::kRefused);
  EXPECT_TRUE(message_has("elbow: enable refused (16")) << message;
  EXPECT_TRUE(output_has("wrist: enabled, holding")) << "the failure before did not keep the order from it";
  // "ghost" does not exist. Its exit status outranks that of a refusal, in either order.
  EXPECT_EQ(status_of([&] {
              order_each(client, output, {"ghost", "elbow"}, enable);
            }),
            ExitStatus::kNoAnswer);
  EXPECT_TRUE(message_has("no joint 'ghost'") && message_has("\nelbow: enable refused")) << message;
  EXPECT_EQ(status_of([&] {
              order_each(client, output, {"elbow", "ghost"}, enable);
            }),
            ExitStatus::kNoAnswer);
}

TEST_F(CommandsTest, AnOrderToAllReachesEveryJointThatIsHeard) {
  FakeDaemon wrist(connection, "SW", "wrist");
  FakeDaemon other(connection, "OTHER", "elbow");
  daemon.publish_state(Mode::kHolding);
  wrist.publish_state(Mode::kHolding);
  other.publish_state(Mode::kHolding);
  order_each(client, output, {}, hold);
  EXPECT_EQ(daemon.heard().size(), 1U);
  EXPECT_EQ(wrist.heard().size(), 1U);
  EXPECT_TRUE(other.heard().empty()) << "another prefix's";
}

TEST_F(CommandsTest, ResultsAreOneJsonObjectALineWhenAskedFor) {
  output.json = true;
  daemon.publish_state(Mode::kHolding);
  hold(client, output, "elbow");
  enable(client, output, "elbow");
  EXPECT_TRUE(output_has("{\"joint\":\"elbow\",\"accepted\":true}\n")) << stream.str();
  EXPECT_TRUE(output_has("\"already\":true}\n")) << stream.str();
}

TEST_F(CommandsTest, LoadTableRefusesAFileThatIsNoTableBeforeAnythingIsSent) {
  daemon.publish_state();
  const TemporaryFolder folder;
  const auto file = folder.path() / "no_table.json";
  std::ofstream(file) << "{}";
  EXPECT_THROW(load_table(client, output, {"elbow", file}), InputError);
  EXPECT_THROW(load_table(client, output, {std::nullopt, "/nonexistent/table.json"}), InputError);
  EXPECT_TRUE(daemon.heard().empty());
}

}  // namespace
}  // namespace strainwave
