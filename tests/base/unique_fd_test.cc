// SPDX-License-Identifier: BSD-3-Clause
#include "base/unique_fd.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace strainwave {
namespace {

int some_fd() {
  return ::open("/dev/null", O_RDONLY | O_CLOEXEC);
}
bool is_open(int fd) {
  return ::fcntl(fd, F_GETFD) >= 0;
}

TEST(UniqueFd, ClosesWhatItHoldsAtItsEnd) {
  int raw = -1;
  {
    const UniqueFd fd(some_fd());
    raw = fd.get();
    ASSERT_TRUE(fd);
    EXPECT_TRUE(is_open(raw));
  }
  EXPECT_FALSE(is_open(raw));
}

TEST(UniqueFd, ThatWasMovedFromHoldsNothingAndTheOtherOneHoldsIt) {
  UniqueFd first(some_fd());
  const int raw = first.get();
  UniqueFd second(std::move(first));
  EXPECT_FALSE(first);  // NOLINT(bugprone-use-after-move)
  EXPECT_EQ(second.get(), raw);
  UniqueFd third(some_fd());
  const int replaced = third.get();
  third = std::move(second);
  EXPECT_EQ(third.get(), raw);
  EXPECT_TRUE(is_open(raw));
  EXPECT_FALSE(is_open(replaced));
}

TEST(UniqueFd, OfAFailedCallIsFalseAndClosesNothing) {
  const UniqueFd fd(-1);
  EXPECT_FALSE(fd);
}

}  // namespace
}  // namespace strainwave
