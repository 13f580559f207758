// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/log.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>

#include "base/text_file.h"
#include "daemon/loop_log.h"
#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

/// The output of `write` on stderr, logged as under systemd.
template <typename Write>
std::string logged(const Write& write) {
  const TemporaryFolder temporary;
  const std::filesystem::path path = temporary.path() / "log";
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  const int before = ::dup(STDERR_FILENO);
  ::setenv("JOURNAL_STREAM", "8:1", 1);
  ::dup2(file, STDERR_FILENO);
  start_logging();
  write();
  spdlog::default_logger()->flush();
  ::dup2(before, STDERR_FILENO);
  ::unsetenv("JOURNAL_STREAM");
  start_logging();
  ::close(before);
  ::close(file);
  return read_text_file(path);
}

TEST(Log, TakesOneLineFromWhateverSomebodySends) {
  const std::string hostile =
      "SW.x\n<0>the machine is safe\r\x1b[2J\x1b]0;title\x07\xc2\x9b"
      "31m.COMMAND";
  const std::string text = logged([&] { spdlog::warn("message on {} discarded", hostile); });
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
  EXPECT_EQ(text.rfind("<4>message on SW.x?<0>the machine is safe?", 0), 0U) << text;
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
  EXPECT_EQ(text.find("\x9b"), std::string::npos);
}

TEST(Log, KeepsWhatPeopleWriteAsItIs) {
  const std::string text = logged([] { spdlog::info("elbow: 5 \u00b0C, \u00fcber [0, 1]: {}", 0.5); });
  EXPECT_EQ(text, "<6>elbow: 5 \u00b0C, \u00fcber [0, 1]: 0.5\n");
}

TEST(Log, TellsHowManyLinesNobodyTook) {
  std::array<int, 2> pipe{};
  ASSERT_EQ(::pipe2(pipe.data(), O_CLOEXEC), 0);
  const int before = ::dup(STDERR_FILENO);
  ::dup2(pipe[1], STDERR_FILENO);
  start_logging();
  std::string text(std::size_t{1} << 20U, '\0');
  const auto told_after_losing = [&](int lines) {
    ::fcntl(pipe[1], F_SETFL, O_NONBLOCK);
    while (::write(pipe[1], text.data(), 4096) > 0) {
    }
    ::fcntl(pipe[1], F_SETFL, 0);
    for (int i = 0; i < lines; ++i) spdlog::info("lost");
    (void)!::read(pipe[0], text.data(), text.size());
    spdlog::info("read");
    spdlog::default_logger()->flush();
    return text.substr(
        0, static_cast<std::size_t>(std::max<ssize_t>(0, ::read(pipe[0], text.data(), text.size()))));
  };
  const std::string one = told_after_losing(1);
  const std::string two = told_after_losing(2);
  ::dup2(before, STDERR_FILENO);
  start_logging();
  for (const int file : {before, pipe[0], pipe[1]}) ::close(file);
  EXPECT_NE(one.find(": 1 line of this log lost"), std::string::npos) << one;
  EXPECT_NE(two.find(": 2 lines of this log lost"), std::string::npos) << two;
}

TEST(LoopLog, NamesTheLoadThatAJointYieldedToWhatIsAllowedAndWhere) {
  JointConfig joint;
  joint.name = "elbow";
  LoopEvent event{
      0, 81234, Mode::kTracking, Mode::kTracking, Fault::kNone, 0, Yield{-13.1042, 12.0, 0.30104}};
  EXPECT_FALSE(tells_of_fault(event));
  EXPECT_EQ(
      logged([&] { log_loop_event(joint, event); }),
      "<4>elbow: yielded to a load of 13.1 N.m at 0.301 rad: joint.limits.load_Nm allows 12 (was tracking, "
      "cycle 81234)\n");
  event.yield.reset();
  event.to = Mode::kHolding;
  EXPECT_EQ(logged([&] { log_loop_event(joint, event); }), "<6>elbow: tracking -> holding\n");
  event.to = Mode::kFaulted;
  event.fault = Fault::kOverload;
  EXPECT_TRUE(tells_of_fault(event));
  EXPECT_EQ(logged([&] { log_loop_event(joint, event); }),
            "<3>elbow: fault 24: load too large, see joint.limits.load_Nm (was tracking, cycle 81234)\n");
}

TEST(LoopLog, TakesTheDaemonsOwnFindingForNoNumberOfTheDrive) {
  JointConfig joint;
  joint.name = "elbow";
  joint.drive_error_text = [](Fault, std::uint32_t) { return std::string("the drive's words"); };
  for (const Fault fault : {Fault::kImplausibleReading, Fault::kChatter}) {
    LoopEvent event;
    event.to = Mode::kFaulted;
    event.fault = fault;
    event.drive_error = 0x01002003;
    EXPECT_EQ(logged([&] { log_loop_event(joint, event); }).find("the drive's words"), std::string::npos);
  }
  LoopEvent event;
  event.to = Mode::kFaulted;
  event.fault = Fault::kDriveFault;
  event.drive_error = 1;
  EXPECT_NE(logged([&] { log_loop_event(joint, event); }).find("the drive's words"), std::string::npos);
}

}  // namespace
}  // namespace strainwave
