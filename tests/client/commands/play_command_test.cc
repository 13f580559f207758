// SPDX-License-Identifier: BSD-3-Clause
// The play command sends the setpoints of a log again.
#include <gtest/gtest.h>

#include <fstream>
#include <strainwave/setpoint_v1.hpp>

#include "base/input_error.h"
#include "client/protocol/key_file.h"
#include "tests/client/commands/commands_fixture.h"
#include "tests/support/event_log_file.h"
#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

class PlayTest : public testing::CommandsTest {
 protected:
  PlayTest() {
    write_new_key(folder_.path() / "key", Role::kOperator, "");
    testing::EventLogFile log(folder_.path() / "a.lcm");
    setpoint_v1 sample{};
    sample.stream_id = 5;
    sample.valid_for_s = 2.0;
    for (int i = 0; i < 20; ++i) log.add(100 + 10'000 * i, "SW.elbow.SETPOINT", sample);
  }
  ExitStatus status_of_play() {
    Client signing(connection, {"SW", 0.3, folder_.path() / "key"});
    daemon.publish_state(Mode::kHolding);
    return status_of([&] { play(signing, output, {folder_.path() / "a.lcm", "elbow"}); });
  }

  TemporaryFolder folder_;
};

TEST_F(PlayTest, ThatALoadEndsSaysSoAsAMoveDoes) {
  daemon.modes_after_answer = {Mode::kTracking, Mode::kTracking};
  daemon.after_answer = [&] {
    if (daemon.heard().size() == 1) daemon.reason = Reason::kStreamEnded;
    if (daemon.heard().size() == 2) daemon.show_yield();
  };
  EXPECT_EQ(status_of_play(), ExitStatus::kRefused);
  EXPECT_TRUE(message.starts_with(
      "elbow: did not follow the recording to its end: it yielded to a load of 13.1 N.m (load_Nm "
      "allows 12) at 0.3011 rad; it is tracking; the daemon refused to hold elbow "))
      << message;
  ASSERT_TRUE(details.yielded_to);
  EXPECT_EQ(details.yielded_to->load_Nm, -13.1042);
}

TEST_F(PlayTest, IsNotEndedByALoadOfBefore) {
  daemon.show_yield();
  daemon.modes_after_answer = {Mode::kTracking};
  daemon.after_answer = [&] {
    if (daemon.heard().size() > 3) daemon.state.notices = 0;
  };
  EXPECT_EQ(status_of_play(), ExitStatus::kDone) << message;
  EXPECT_TRUE(output_has("elbow: 20 setpoints over 0.2 s")) << stream.str();
  EXPECT_TRUE(output_has("elbow: all setpoints sent")) << stream.str();
}

TEST_F(PlayTest, SendsNothingOfADamagedLog) {
  std::fstream log(folder_.path() / "a.lcm", std::ios::binary | std::ios::in | std::ios::out);
  log.seekp(0, std::ios::end);
  const auto size = static_cast<long>(log.tellp());
  log.seekp(size / 2);
  log << std::string(30, 'x');
  log.close();
  EXPECT_THROW(status_of_play(), InputError);
  EXPECT_TRUE(daemon.heard().empty());
}

}  // namespace
}  // namespace strainwave
