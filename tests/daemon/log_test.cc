#include "daemon/log.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

/// What `write` leaves on stderr, logged as under systemd.
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
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
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

}  // namespace
}  // namespace strainwave
