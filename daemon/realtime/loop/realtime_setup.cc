// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/loop/realtime_setup.h"

#include <fcntl.h>
#include <malloc.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <fstream>
#include <system_error>
#include <thread>

namespace strainwave {

namespace {

constexpr std::size_t kStackToTouch = std::size_t{256} * 1024;

std::string error_text(int error) {
  return std::generic_category().message(error);
}

/// The value of `name` in /proc/self/status; empty if there is none.
std::string own_status(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(name + ":\t")) return line.substr(name.size() + 2);
  return "";
}

/// Empty when granted, or when `cpu` is negative.
std::string pin_this_thread(int cpu) {
  if (cpu < 0) return "";
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(static_cast<std::size_t>(cpu), &set);
  if (::sched_setaffinity(0, sizeof set, &set) == 0) return "";
  const std::string error = error_text(errno);
  return "daemon.cpu = " + std::to_string(cpu) + ": processor " + std::to_string(cpu) + " cannot be used (" +
         error + "): this process may use " + own_status("Cpus_allowed_list") +
         "; name one of these, or allow this one (container: --cpuset-cpus, service: AllowedCPUs)";
}

// Maps the stack's pages that the loop may reach, before it starts.
__attribute__((noinline)) void touch_stack() {
  std::array<char, kStackToTouch> stack;
  volatile char* page = stack.data();
  for (std::size_t i = 0; i < kStackToTouch; i += 1024) page[i] = 0;
}

}  // namespace

std::string processor_problem(int cpu) {
  std::string problem;
  std::thread([&] { problem = pin_this_thread(cpu); }).join();
  return problem;
}

std::string lock_memory() {
  // The kernel merges and splits huge pages at any time, and a thread that touches one meanwhile waits.
  if (::prctl(PR_SET_THP_DISABLE, 1, 0, 0, 0) != 0)
    return "transparent huge pages cannot be switched off (" + error_text(errno) + ")";
  // Freed memory stays mapped and large blocks come from the heap: no page appears or disappears later.
  ::mallopt(M_TRIM_THRESHOLD, -1);  // NOLINT(concurrency-mt-unsafe): before the loop's thread
  ::mallopt(M_MMAP_MAX, 0);         // NOLINT(concurrency-mt-unsafe): before the loop's thread
  if (::mlockall(MCL_CURRENT | MCL_FUTURE) == 0) return "";
  return "memory cannot be locked (" + error_text(errno) +
         "): the process needs CAP_IPC_LOCK or RLIMIT_MEMLOCK without a limit: run it as the service, or "
         "after "
         "`ulimit -l unlimited`; a container needs --ulimit memlock=-1";
}

std::string compaction_warning(const std::string& setting_path) {
  std::ifstream setting(setting_path);
  int allowed = 0;
  if (!(setting >> allowed) || allowed == 0) return "";
  return "the kernel may move locked memory and delay the loop: set sysctl "
         "vm.compact_unevictable_allowed=0";
}

std::string make_thread_real_time(int priority, int cpu) {
  touch_stack();
  if (std::string problem = pin_this_thread(cpu); !problem.empty()) return problem;
  sched_param parameter{};
  parameter.sched_priority = priority;
  if (const int error = ::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &parameter)) {
    const std::string wanted = std::to_string(priority);
    return "SCHED_FIFO priority " + wanted + " is refused (" + error_text(error) +
           "): the process needs CAP_SYS_NICE or RLIMIT_RTPRIO of " + wanted +
           ": run it as the service, or after `ulimit -r " + wanted +
           "`; a container needs --cap-add SYS_NICE or --ulimit rtprio=" + wanted +
           ". If it has these, a seccomp filter or a cgroup without real-time budget refuses it "
           "(container: --cpu-rt-runtime=950000)";
  }
  return "";
}

UniqueFd avoid_sleep_states(std::string& refusal, const std::string& file) {
  UniqueFd descriptor(::open(file.c_str(), O_WRONLY | O_CLOEXEC));
  const bool absent = !descriptor && errno == ENOENT;
  const std::int32_t latency_us = 0;
  const bool granted =
      descriptor && ::write(descriptor.get(), &latency_us, sizeof latency_us) == sizeof latency_us;
  refusal =
      absent || granted
          ? ""
          : file + " cannot be written (" + error_text(errno) +
                "): wake-ups may be late by the sleep states' exit times; allow the service to write it";
  return descriptor;
}

long thread_page_faults() noexcept {
  rusage usage{};
  ::getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_minflt + usage.ru_majflt;
}

}  // namespace strainwave
