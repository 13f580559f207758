// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/gateway/preference.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <string>
#include <thread>

namespace strainwave {
namespace {

int own_nice() {
  return ::getpriority(PRIO_PROCESS, 0);
}

TEST(Preference, IsOfTheThreadThatAsksAndOfNoOther) {
  if (::geteuid() != 0) GTEST_SKIP() << "needs the right to go before others";
  const int before = own_nice();
  int of_thread = 0;
  std::thread([&] {
    EXPECT_EQ(prefer_this_thread(), "");
    of_thread = own_nice();
  }).join();
  EXPECT_EQ(of_thread, kPreferredNice);
  EXPECT_EQ(own_nice(), before);
}

[[noreturn]] void ask_without_the_right() {
  const rlimit none{0, 0};
  (void)::setrlimit(RLIMIT_NICE, &none);
  // If the test runs with a higher priority, it may ask for less than it has.
  (void)::setpriority(PRIO_PROCESS, 0, 0);
  if (::geteuid() == 0 && ::setuid(65534) != 0) ::_exit(2);
  const std::string refusal = prefer_this_thread();
  ::_exit(refusal.find("ulimit -e 30") != std::string::npos && own_nice() > kPreferredNice ? 0 : 1);
}

TEST(Preference, ThatIsRefusedSaysWhatToDo) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(ask_without_the_right(), ::testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace strainwave
