// SPDX-License-Identifier: BSD-3-Clause
// The remaining abilities of a gateway that an attacker controls. Each case is a process that confines itself.
#include "daemon/gateway/confinement.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstring>
#include <thread>
#include <vector>

#include "daemon/gateway/gateway_process.h"

namespace strainwave {
namespace {

constexpr unsigned int kKeptDescriptors = 3;

/// Exits with 0 if `attempt` returned false (refused), else with 1.
template <typename Attempt>
[[noreturn]] void try_confined(const Attempt& attempt) {
  give_up_privileges(-1, -1, kKeptDescriptors);
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

TEST_F(Confinement, EndsTheProcessThatMakesMemoryRunnable) {
  EXPECT_EXIT(try_confined([] {
                return ::mmap(nullptr, 4096, PROT_READ | PROT_WRITE | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS,
                              -1, 0) != MAP_FAILED;
              }),
              ::testing::KilledBySignal(SIGSYS), "");
}

TEST_F(Confinement, EndsTheProcessThatOpensAFile) {
  EXPECT_EXIT(try_confined([] { return ::open("/etc/passwd", O_RDONLY) >= 0; }),
              ::testing::KilledBySignal(SIGSYS), "");
}

TEST_F(Confinement, LetsMemoryBeUsedAndTheStreamsBeWrittenWithoutEffect) {
  EXPECT_EXIT(try_confined([] {
                for (int i = 0; i < 100; ++i) {
                  auto* block = new char[1 << 20];
                  for (int at = 0; at < (1 << 20); at += 4096) static_cast<volatile char*>(block)[at] = 1;
                  delete[] block;
                }
                std::fputs("as a library complains\n", stderr);
                return false;
              }),
              ::testing::ExitedWithCode(0), "^$");
}

TEST_F(Confinement, HoldsForThreadsThatWereThereBefore) {
  EXPECT_EXIT(
      {
        give_up_privileges(-1, -1, kKeptDescriptors);
        std::atomic<bool> confined{false};
        std::thread thread([&confined] {
          while (!confined) std::this_thread::yield();
          ::socket(AF_INET, SOCK_DGRAM, 0);
        });
        confine();
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
        give_up_privileges(-1, -1, kKeptDescriptors);
        ::_exit(::fcntl(descriptor, F_GETFD) >= 0 ? 1 : 0);
      },
      ::testing::ExitedWithCode(0), "");
}

TEST_F(Confinement, LeavesNoCapabilityAndNoWayBackToRoot) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root has something to give up";
  EXPECT_EXIT(
      {
        give_up_privileges(65534, 65534, kKeptDescriptors);
        const bool root_again = ::setuid(0) == 0 || ::setgid(0) == 0;
        ::_exit(root_again || ::getgroups(0, nullptr) != 0 || can_raise_a_limit() ? 1 : 0);
      },
      ::testing::ExitedWithCode(0), "");
}

/// The filter for `architecture`, as the kernel would run it.
class ExportedFilter {
 public:
  explicit ExportedFilter(std::uint32_t architecture) : architecture_(architecture) {
    const int file = ::memfd_create("filter", MFD_CLOEXEC);
    export_system_call_filter(architecture, file);
    program_.resize(static_cast<std::size_t>(::lseek(file, 0, SEEK_END)) / sizeof(sock_filter));
    EXPECT_GT(::pread(file, program_.data(), program_.size() * sizeof(sock_filter), 0), 0);
    ::close(file);
  }
  /// The filter's verdict on a call with these arguments: SECCOMP_RET_...
  std::uint32_t judge(int number, std::uint64_t first = 0, std::uint64_t third = 0) const {
    seccomp_data data{};
    data.nr = number;
    data.arch = architecture_;
    data.args[0] = first;
    data.args[2] = third;
    std::uint32_t value = 0;
    for (std::size_t at = 0; at < program_.size(); ++at) {
      const sock_filter& step = program_[at];
      const auto jump = [&](bool taken) { at += taken ? step.jt : step.jf; };
      switch (step.code) {
        case BPF_LD | BPF_W | BPF_ABS:
          std::memcpy(&value, static_cast<const char*>(static_cast<const void*>(&data)) + step.k,
                      sizeof value);
          break;
        case BPF_ALU | BPF_AND | BPF_K:
          value &= step.k;
          break;
        case BPF_JMP | BPF_JEQ | BPF_K:
          jump(value == step.k);
          break;
        case BPF_JMP | BPF_JGE | BPF_K:
          jump(value >= step.k);
          break;
        case BPF_JMP | BPF_JGT | BPF_K:
          jump(value > step.k);
          break;
        case BPF_JMP | BPF_JA:
          at += step.k;
          break;
        case BPF_RET | BPF_K:
          return step.k;
        default:
          ADD_FAILURE() << "a filter with the unknown step " << step.code;
          return 0;
      }
    }
    ADD_FAILURE() << "a filter without an end";
    return 0;
  }

 private:
  std::uint32_t architecture_;
  std::vector<sock_filter> program_;
};

// Numbers from Linux's arch/arm/tools/syscall.tbl. A 32-bit C library first tries the calls with 64-bit times.
TEST_F(Confinement, AllowsOn32BitArmWhatItsCLibraryCalls) {
  const ExportedFilter filter(AUDIT_ARCH_ARM);
  for (const int number :
       {403 /* clock_gettime64 */, 263 /* clock_gettime */, 417 /* recvmmsg_time64 */, 365 /* recvmmsg */,
        414 /* ppoll_time64 */, 168 /* poll */, 422 /* futex_time64 */, 240 /* futex */, 296 /* sendmsg */,
        248 /* exit_group */, 45 /* brk */, 192 /* mmap2, nothing that can be run */})
    EXPECT_EQ(filter.judge(number), static_cast<std::uint32_t>(SECCOMP_RET_ALLOW)) << number;
  EXPECT_EQ(filter.judge(4 /* write */, kGatewayWakeFd), static_cast<std::uint32_t>(SECCOMP_RET_ALLOW));
}

TEST_F(Confinement, EndsOn32BitArmWhoeverCallsAnythingElse) {
  const ExportedFilter filter(AUDIT_ARCH_ARM);
  for (const int number :
       {281 /* socket */, 322 /* openat */, 55 /* fcntl */, 221 /* fcntl64 */, 120 /* clone */,
        435 /* clone3 */, 37 /* kill */, 26 /* ptrace */, 377 /* process_vm_writev */,
        156 /* sched_setscheduler */, 11 /* execve */, 54 /* ioctl */})
    EXPECT_EQ(filter.judge(number), static_cast<std::uint32_t>(SECCOMP_RET_KILL_PROCESS)) << number;
  EXPECT_EQ(filter.judge(4 /* write */, kGatewayInboundFd),
            static_cast<std::uint32_t>(SECCOMP_RET_KILL_PROCESS));
  EXPECT_EQ(filter.judge(192 /* mmap2 */, 0, PROT_EXEC),
            static_cast<std::uint32_t>(SECCOMP_RET_KILL_PROCESS));
}

}  // namespace
}  // namespace strainwave
