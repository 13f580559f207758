// What a gateway that was taken over can still do. Each case is a process of its own that confines itself.
#include "daemon/gateway/confinement.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/eventfd.h>
#include <sys/mman.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <thread>

namespace strainwave {
namespace {

constexpr unsigned int kKeptDescriptors = 3;

void confine() {
  confine_before_setup(-1, -1, kKeptDescriptors);
  confine_after_setup();
}

/// Ends with 0 when `attempt` returned false (refused), else with 1.
template <typename Attempt>
[[noreturn]] void try_confined(const Attempt& attempt) {
  confine();
  ::_exit(attempt() ? 1 : 0);
}

bool can_raise_a_limit() {
  const rlimit more{1000, 1000};
  return ::setrlimit(RLIMIT_CORE, &more) == 0;
}

class Confinement : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!has_system_call_filter()) GTEST_SKIP() << "no filter of system calls in a sanitized build";
    GTEST_FLAG_SET(death_test_style, "threadsafe");
  }
};

TEST_F(Confinement, EndsTheProcessThatOpensASocket) {
  EXPECT_EXIT(try_confined([] { return ::socket(AF_INET, SOCK_DGRAM, 0) >= 0; }),
              ::testing::KilledBySignal(SIGSYS), "");
}

TEST_F(Confinement, EndsTheProcessThatStartsAProgram) {
  EXPECT_EXIT(try_confined([] { return ::execl("/bin/true", "true", nullptr) == 0; }),
              ::testing::KilledBySignal(SIGSYS), "");
  EXPECT_EXIT(try_confined([] { return ::fork() >= 0; }), ::testing::KilledBySignal(SIGSYS), "");
}

TEST_F(Confinement, EndsTheProcessThatTouchesAnother) {
  EXPECT_EXIT(try_confined([] { return ::kill(::getppid(), 0) == 0; }), ::testing::KilledBySignal(SIGSYS),
              "");
  EXPECT_EXIT(try_confined([] { return ::ptrace(PTRACE_ATTACH, ::getppid(), nullptr, nullptr) == 0; }),
              ::testing::KilledBySignal(SIGSYS), "");
}

// LCM is set up between the two steps, and may already be fed.
TEST_F(Confinement, KeepsFromOtherProcessesEvenBeforeLcmIsSetUp) {
  const auto try_between = [](auto attempt) {
    confine_before_setup(-1, -1, kKeptDescriptors);
    ::_exit(attempt() ? 1 : 0);
  };
  EXPECT_EXIT(try_between([] { return ::kill(::getppid(), 0) == 0; }), ::testing::KilledBySignal(SIGSYS), "");
  EXPECT_EXIT(try_between([] { return ::ptrace(PTRACE_ATTACH, ::getppid(), nullptr, nullptr) == 0; }),
              ::testing::KilledBySignal(SIGSYS), "");
  EXPECT_EXIT(try_between([] { return ::execl("/bin/true", "true", nullptr) == 0; }),
              ::testing::KilledBySignal(SIGSYS), "");
  // What LCM does need.
  EXPECT_EXIT(try_between([] {
                std::thread([] {}).join();
                return ::socket(AF_INET, SOCK_DGRAM, 0) < 0;
              }),
              ::testing::ExitedWithCode(0), "");
}

TEST_F(Confinement, EndsTheProcessThatMakesMemoryRunnable) {
  EXPECT_EXIT(try_confined([] {
                return ::mmap(nullptr, 4096, PROT_READ | PROT_WRITE | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS,
                              -1, 0) != MAP_FAILED;
              }),
              ::testing::KilledBySignal(SIGSYS), "");
}

TEST_F(Confinement, OpensNoFile) {
  EXPECT_EXIT(try_confined([] { return ::open("/etc/passwd", O_RDONLY) >= 0; }), ::testing::ExitedWithCode(0),
              "");
}

// The core reads this eventfd and must never be made to wait for it.
TEST_F(Confinement, CannotMakeASharedDescriptorBlock) {
  EXPECT_EXIT(
      {
        const int descriptor = ::dup2(::eventfd(0, EFD_NONBLOCK), STDIN_FILENO);
        confine_before_setup(-1, -1, kKeptDescriptors);
        // The filter alone: the second step would also replace the standard streams.
        const int kept = ::dup(descriptor);
        confine_after_setup();
        ::_exit(::fcntl(kept, F_SETFL, 0) == 0 ? 1 : 0);
      },
      ::testing::ExitedWithCode(0), "");
}

TEST_F(Confinement, LetsMemoryBeUsedAndTheStreamsBeWrittenWithoutEffect) {
  EXPECT_EXIT(try_confined([] {
                for (int i = 0; i < 100; ++i) {
                  auto* block = new char[1 << 20];
                  for (int at = 0; at < (1 << 20); at += 4096) static_cast<volatile char*>(block)[at] = 1;
                  delete[] block;
                }
                std::perror("as LCM writes");
                return false;
              }),
              ::testing::ExitedWithCode(0), "^$");
}

TEST_F(Confinement, HoldsForThreadsThatWereThereBefore) {
  EXPECT_EXIT(
      {
        confine_before_setup(-1, -1, kKeptDescriptors);
        std::atomic<bool> confined{false};
        std::thread thread([&confined] {
          while (!confined) std::this_thread::yield();
          ::socket(AF_INET, SOCK_DGRAM, 0);
        });
        confine_after_setup();
        confined = true;
        thread.join();
        ::_exit(0);
      },
      ::testing::KilledBySignal(SIGSYS), "");
}

TEST_F(Confinement, ClosesEveryDescriptorItIsNotToldToKeep) {
  EXPECT_EXIT(
      {
        const int descriptor = ::dup2(STDERR_FILENO, 200);
        confine_before_setup(-1, -1, kKeptDescriptors);
        ::_exit(::fcntl(descriptor, F_GETFD) >= 0 ? 1 : 0);
      },
      ::testing::ExitedWithCode(0), "");
}

TEST_F(Confinement, LeavesNoCapabilityAndNoWayBackToRoot) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root has something to give up";
  EXPECT_EXIT(
      {
        confine_before_setup(65534, 65534, kKeptDescriptors);
        const bool root_again = ::setuid(0) == 0 || ::setgid(0) == 0;
        ::_exit(root_again || ::getgroups(0, nullptr) != 0 || can_raise_a_limit() ? 1 : 0);
      },
      ::testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace strainwave
