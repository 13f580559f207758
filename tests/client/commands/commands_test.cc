#include "client/commands/commands.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <strainwave/command_v1.hpp>
#include <strainwave/inject_v1.hpp>
#include <strainwave/setpoint_v2.hpp>
#include <strainwave/timing_v1.hpp>

#include "base/input_error.h"
#include "client/link/exit_status.h"
#include "lcmtypes/event_log.h"
#include "tests/client/link/fake_daemon.h"
#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

class CommandsTest : public testing::Test {
 protected:
  /// How `command` ended, with its message in `message`.
  template <typename Command>
  ExitStatus status_of(const Command& command) {
    try {
      command();
      return ExitStatus::kDone;
    } catch (const ClientError& error) {
      message = error.what();
      return error.status();
    }
  }
  bool message_has(const std::string& part) const { return message.find(part) != std::string::npos; }
  bool output_has(const std::string& part) const { return stream.str().find(part) != std::string::npos; }
  ExitStatus move_and_wait(double position_rad) {
    return status_of([&] { move(client, output, {"elbow", position_rad, true, 0.0}); });
  }

  Connection connection{"memq://"};
  FakeDaemon daemon{connection, "SW", "elbow"};
  Client client{connection, {"SW", 0.3}};
  std::ostringstream stream;
  Output output{stream, false};
  std::string message;
};

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
  disable(client, output, "elbow");
  std::vector<std::int32_t> actions;
  for (const auto& heard : daemon.heard()) actions.push_back(decode_exactly<command_v1>(heard.bytes)->action);
  EXPECT_EQ(actions, (std::vector<std::int32_t>{1, 3, 4, 5, 6, 2}));
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

TEST_F(CommandsTest, HomeReturnsOnceTheJointHoldsAndOnlyCallsAHomedJointHomed) {
  daemon.publish_state(Mode::kHolding);
  daemon.modes_after_answer = {Mode::kHolding, Mode::kHoming, Mode::kHoming, Mode::kHolding};
  EXPECT_EQ(status_of([&] { home(client, output, "elbow"); }), ExitStatus::kDone);
  EXPECT_TRUE(output_has("elbow: homed"));
  daemon.state.notices = static_cast<std::int32_t>(Notice::kNotHomed);
  EXPECT_EQ(status_of([&] { home(client, output, "elbow"); }), ExitStatus::kRefused);
  EXPECT_TRUE(message_has("before it found home")) << message;
  daemon.modes_after_answer = {Mode::kHoming, Mode::kStopping};
  EXPECT_EQ(status_of([&] { home(client, output, "elbow"); }), ExitStatus::kRefused);
  EXPECT_TRUE(message_has("did not find home: the joint was disabled")) << message;
}

TEST_F(CommandsTest, GpioCheckSaysWhereItsHelperMustBe) {
  // Beside this test's program there is no strainwaved.
  EXPECT_EQ(status_of([&] { gpio_check(output, "gpio.toml"); }), ExitStatus::kUsage);
  EXPECT_TRUE(message_has("strainwaved")) << message;
  EXPECT_TRUE(message_has("install it beside strainwavectl")) << message;
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
  EXPECT_TRUE(message_has("clear-fault elbow")) << message;
}

TEST_F(CommandsTest, EnableThatNeverEndsIsNoSuccess) {
  daemon.publish_state();
  daemon.modes_after_answer = {Mode::kStarting};
  EXPECT_EQ(status_of([&] { enable(client, output, "elbow"); }), ExitStatus::kNoAnswer);
  EXPECT_TRUE(message_has("still starting")) << message;
}

TEST_F(CommandsTest, DisableReachesAJointThatIsNotHeard) {
  daemon.modes_after_answer = {Mode::kStopping, Mode::kOff};
  EXPECT_EQ(status_of([&] { disable(client, output, "elbow"); }), ExitStatus::kDone);
  EXPECT_TRUE(output_has("elbow: disabled"));
}

TEST_F(CommandsTest, MoveAsksForAnAcknowledgementOfAMoveNotAStream) {
  daemon.publish_state(Mode::kHolding);
  move(client, output, {"elbow", -0.25, false});
  const auto setpoint = decode_exactly<setpoint_v2>(daemon.heard().at(0).bytes);
  ASSERT_TRUE(setpoint);
  EXPECT_EQ(setpoint->position_rad, -0.25);
  EXPECT_EQ(setpoint->valid_for_s, 0.0);
  EXPECT_EQ(setpoint->acknowledge, 1);
}

TEST_F(CommandsTest, MoveWaitsUntilTheJointHoldsAtTheTarget) {
  daemon.publish_state(Mode::kHolding);
  // The first state left the daemon before it took the order.
  daemon.modes_after_answer = {Mode::kHolding, Mode::kTracking, Mode::kTracking, Mode::kHolding};
  daemon.after_answer = [&] { daemon.state.joint_position_rad = 0.4995; };
  EXPECT_EQ(move_and_wait(0.5), ExitStatus::kDone) << message;
  EXPECT_TRUE(output_has("arrived at 0.5 rad in ")) << stream.str();
  EXPECT_TRUE(output_has("error 5.00e-04 rad")) << stream.str();
  EXPECT_EQ(client.find("elbow")->messages, 5);
}

TEST_F(CommandsTest, MoveDoesNotCallItArrivedOutsideOfTheTolerance) {
  daemon.publish_state(Mode::kHolding);
  daemon.modes_after_answer = {Mode::kTracking, Mode::kHolding};
  daemon.after_answer = [&] { daemon.state.joint_position_rad = 0.49; };
  EXPECT_NE(move_and_wait(0.5), ExitStatus::kDone);
  EXPECT_FALSE(output_has("arrived"));
}

TEST_F(CommandsTest, EnableAndClearFaultAreDoneAlreadyWhenThereIsNothingToDo) {
  daemon.publish_state(Mode::kHolding);
  enable(client, output, "elbow");
  EXPECT_TRUE(output_has("elbow: enabled already, holding at")) << stream.str();
  clear_fault(client, output, "elbow");
  EXPECT_TRUE(output_has("elbow: has no fault")) << stream.str();
  EXPECT_TRUE(daemon.heard().empty()) << "nothing was sent";
}

TEST_F(CommandsTest, AStopThatNobodyAnswersWasSentAllTheSame) {
  EXPECT_EQ(status_of([&] { disable(client, output, "ghost"); }), ExitStatus::kNoAnswer);
  EXPECT_TRUE(message_has("ghost: the stop was sent 4 times, and nothing answered")) << message;
}

TEST_F(CommandsTest, DisableAllGoesOnAfterAFailure) {
  FakeDaemon wrist(connection, "SW", "wrist");
  daemon.publish_state(Mode::kHolding);
  wrist.publish_state(Mode::kHolding);
  daemon.drop = 100;
  wrist.modes_after_answer = {Mode::kOff};
  EXPECT_EQ(status_of([&] { disable_all(client, output); }), ExitStatus::kNoAnswer);
  EXPECT_TRUE(message_has("elbow: the stop was sent")) << message;
  EXPECT_TRUE(output_has("wrist: disabled"));
}

TEST_F(CommandsTest, ResultsAreOneJsonObjectALineWhenAskedFor) {
  output.json = true;
  daemon.publish_state(Mode::kHolding);
  hold(client, output, "elbow");
  enable(client, output, "elbow");
  EXPECT_TRUE(output_has("{\"joint\":\"elbow\",\"accepted\":true}\n")) << stream.str();
  EXPECT_TRUE(output_has("\"already\":true}\n")) << stream.str();
}

TEST_F(CommandsTest, MoveEndsWithTheFaultThatEndedIt) {
  daemon.publish_state(Mode::kHolding);
  daemon.state.fault = static_cast<std::int32_t>(Fault::kFollowingError);
  daemon.modes_after_answer = {Mode::kTracking, Mode::kFaulted};
  EXPECT_EQ(move_and_wait(0.5), ExitStatus::kRefused);
  EXPECT_TRUE(message_has("following error")) << message;
}

TEST_F(CommandsTest, MoveEndsWhenAnotherOrderReplacesIt) {
  daemon.publish_state(Mode::kHolding);
  daemon.modes_after_answer = {Mode::kTracking};
  daemon.after_answer = [&] {
    daemon.publish_state(Mode::kTracking);
    daemon.state.target_position_rad = 0.1;  // a hold
  };
  EXPECT_EQ(move_and_wait(0.5), ExitStatus::kRefused);
  EXPECT_TRUE(message_has("another order")) << message;
}

TEST_F(CommandsTest, MoveEndsWhenTheJointIsDisabledOrTheDaemonRestarted) {
  daemon.publish_state(Mode::kHolding);
  daemon.modes_after_answer = {Mode::kTracking, Mode::kStopping};
  EXPECT_EQ(move_and_wait(0.5), ExitStatus::kRefused);
  EXPECT_TRUE(message_has("disabled")) << message;
  daemon.modes_after_answer = {Mode::kTracking};
  daemon.after_answer = [&] {
    daemon.publish_state(Mode::kTracking);
    ++daemon.state.session_id;
  };
  EXPECT_EQ(move_and_wait(0.6), ExitStatus::kRefused);
  EXPECT_TRUE(message_has("restarted")) << message;
}

TEST_F(CommandsTest, MoveSaysSoWhenTheDaemonFallsSilent) {
  daemon.publish_state(Mode::kHolding);
  daemon.modes_after_answer = {Mode::kTracking};
  EXPECT_EQ(move_and_wait(0.5), ExitStatus::kNoAnswer);
  EXPECT_TRUE(message_has("fell silent")) << message;
}

TEST_F(CommandsTest, RefusedMoveThatLooksLikeDegreesGetsAHint) {
  daemon.publish_state(Mode::kHolding);
  daemon.reason = Reason::kOutOfRange;
  EXPECT_EQ(status_of([&] { move(client, output, {"elbow", 90.0, false}); }), ExitStatus::kRefused);
  EXPECT_TRUE(message_has("90 degrees would be 1.5708")) << message;
  EXPECT_EQ(status_of([&] { move(client, output, {"elbow", 3.0, false}); }), ExitStatus::kRefused);
  EXPECT_FALSE(message_has("degrees")) << message;
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

TEST_F(CommandsTest, StatusShowsEveryJointOrEveryFieldOfOne) {
  daemon.publish_state(Mode::kHolding);
  FakeDaemon(connection, "SW", "wrist").publish_state(Mode::kTracking);
  show_status(client, output, {});
  EXPECT_TRUE(output_has("elbow"));
  EXPECT_TRUE(output_has("wrist"));
  stream.str("");
  show_status(client, output, {"elbow"});
  EXPECT_TRUE(output_has("torque_feedforward_Nm"));
  EXPECT_FALSE(output_has("wrist"));
}

TEST_F(CommandsTest, StatusAsJsonWritesNullForWhatIsNotFinite) {
  daemon.state.temperature_used_C = std::numeric_limits<double>::quiet_NaN();
  daemon.state.session_id = 0x7fff'ffff'ffff'fff1;
  daemon.publish_state(Mode::kHolding);
  output.json = true;
  show_status(client, output, {"elbow"});
  EXPECT_TRUE(output_has("\"temperature_used_C\": null")) << stream.str();
  EXPECT_TRUE(output_has("\"session_id\": 9223372036854775793")) << stream.str();
  EXPECT_TRUE(output_has("\"mode_text\": \"holding\"")) << stream.str();
}

TEST_F(CommandsTest, WatchWithoutATerminalWritesLinesWithoutControlCharacters) {
  daemon.publish_state(Mode::kHolding);
  watch(client, output, {{"elbow"}, 0.02, 0.1, false});
  EXPECT_EQ(stream.str().find('\x1b'), std::string::npos);
  EXPECT_TRUE(output_has("elbow"));
}

TEST_F(CommandsTest, StatusNamesTheDaemonOnlyWhenSeveralAreHeard) {
  Client all{connection, {"SW", 0.3, "", true}};
  FakeDaemon other(connection, "ARM2", "elbow");
  daemon.publish_state(Mode::kHolding);
  show_status(all, output, {});
  EXPECT_FALSE(output_has("SW.elbow"));
  stream.str("");
  other.publish_state(Mode::kOff);
  show_status(all, output, {});
  EXPECT_TRUE(output_has("SW.elbow")) << stream.str();
  EXPECT_TRUE(output_has("ARM2.elbow")) << stream.str();
  stream.str("");
  show_status(client, output, {});
  EXPECT_FALSE(output_has("ARM2")) << "the prefix was chosen";
}

TEST_F(CommandsTest, RecordWritesEveryMessageOfTheChosenJoints) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "record.lcm";
  FakeDaemon wrist(connection, "SW", "wrist");
  daemon.publish_state(Mode::kHolding);
  client.wait_for_joint("elbow");
  for (int i = 0; i < 20; ++i) {
    daemon.publish_state();
    wrist.publish_state();
  }
  connection.publish("OTHER.elbow.STATE", encode(state_v1{}));
  record(client, output, {{"elbow"}, file, 0.2, false});
  std::map<std::string, int> counts;
  EventLogReader reader(file);
  for (LogEvent event; reader.next(event);) ++counts[event.channel];
  EXPECT_EQ(counts, (std::map<std::string, int>{{"SW.elbow.STATE", 20}}));
}

TEST_F(CommandsTest, RecordNeverReplacesAFileUnasked) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "record_kept.lcm";
  std::ofstream(file) << "precious\n";
  daemon.publish_state();
  const auto attempt = [&](bool overwrite) {
    return status_of([&] { record(client, output, {{"elbow"}, file, 0.01, overwrite}); });
  };
  EXPECT_EQ(attempt(false), ExitStatus::kUsage);
  std::string first;
  std::getline(std::ifstream(file), first);
  EXPECT_EQ(first, "precious");
  EXPECT_EQ(attempt(true), ExitStatus::kDone);
}

TEST_F(CommandsTest, RecordSaysSoWhenTheFileCannotBeWritten) {
  daemon.publish_state();
  EXPECT_EQ(status_of([&] {
              record(client, output, {{"elbow"}, "/nonexistent/a.lcm", 0.01, false});
            }),
            ExitStatus::kUsage);
}

/// memq:// drops what nobody has subscribed to yet: sends the message once a first one, the trigger, is
/// dispatched.
class LaterTiming {
 public:
  LaterTiming(Connection& connection, const timing_v1& timing)
      : connection_(connection),
        timing_(timing),
        subscription_(connection.subscribe("TRIGGER", &LaterTiming::on_trigger, this)) {
    connection_.publish("TRIGGER", encode(timing));
  }

 private:
  void on_trigger(const ReceivedMessage&) { connection_.publish("SW.TIMING", encode(timing_)); }

  Connection& connection_;
  timing_v1 timing_;
  Subscription subscription_;
};

TEST_F(CommandsTest, TimingSaysWhetherRealTimeIsUsedAndWhatWasRefused) {
  timing_v1 timing{};
  timing.real_time = 0;
  timing.rejects[static_cast<int>(Reason::kWrongSession)] = 3;
  const LaterTiming later(connection, timing);
  show_timing(client, output);
  EXPECT_TRUE(output_has("no (refused by the system)"));
  EXPECT_TRUE(output_has("3 (another session of the daemon)")) << stream.str();
}

TEST_F(CommandsTest, TimingSaysSoWhenNoneComes) {
  EXPECT_EQ(status_of([&] { show_timing(client, output); }), ExitStatus::kNoAnswer);
}

}  // namespace
}  // namespace strainwave
