// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/allocation_trap.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <memory>
#include <thread>
#include <vector>

namespace strainwave {

namespace {

class AllocationTrapTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!AllocationTrap::available()) GTEST_SKIP() << "the sanitizer has its own malloc";
  }
};

// The volatile pointer hides allocations from the optimiser, which may remove unused ones.
void* volatile sink = nullptr;

void allocate_and_free_once() {
  sink = std::malloc(32);
  std::free(sink);
}

TEST_F(AllocationTrapTest, CountsNewAndMalloc) {
  const AllocationTrap trap;
  allocate_and_free_once();
  auto number = std::make_unique<std::vector<int>>(1000);
  sink = number->data();
  EXPECT_EQ(trap.allocations(), 3);
  EXPECT_EQ(trap.frees(), 1);
  number.reset();
  EXPECT_EQ(trap.frees(), 3);
}

TEST_F(AllocationTrapTest, CountsAlignedAllocationsAndReallocations) {
  struct alignas(128) Wide {
    char bytes[128];
  };
  const AllocationTrap trap;
  const auto wide = std::make_unique<Wide>();
  sink = wide.get();
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(wide.get()) % 128, 0U);
  sink = std::realloc(nullptr, 10);
  sink = std::realloc(sink, 10000);
  std::free(sink);
  EXPECT_EQ(trap.allocations(), 3);
}

TEST_F(AllocationTrapTest, CountsNothingWhereNothingIsAllocated) {
  std::vector<double> numbers(100, 1.0);
  const AllocationTrap trap;
  double sum = 0.0;
  for (const double number : numbers) sum += number;
  EXPECT_EQ(trap.touches(), 0);
  EXPECT_EQ(sum, 100.0);
}

TEST_F(AllocationTrapTest, CountsOnlyTheTrappedThread) {
  std::atomic<pid_t> id{0};
  std::atomic<bool> go{false};
  std::atomic<bool> done{false};
  std::atomic<bool> may_end{false};
  std::thread other([&] {
    id = ::gettid();
    while (!go) std::this_thread::yield();
    allocate_and_free_once();
    done = true;
    while (!may_end) std::this_thread::yield();  // the end of a thread frees the library's memory
  });
  while (id == 0) std::this_thread::yield();
  const AllocationTrap trap(id);
  allocate_and_free_once();
  EXPECT_EQ(trap.touches(), 0);
  go = true;
  while (!done) std::this_thread::yield();
  EXPECT_EQ(trap.allocations(), 1);
  EXPECT_EQ(trap.frees(), 1);
  may_end = true;
  other.join();
}

TEST_F(AllocationTrapTest, EndsWithItsScope) {
  { const AllocationTrap trap; }
  allocate_and_free_once();
  const AllocationTrap trap;
  EXPECT_EQ(trap.touches(), 0);
}

}  // namespace

}  // namespace strainwave
