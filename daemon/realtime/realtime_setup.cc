#include "daemon/realtime/realtime_setup.h"

#include <malloc.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>

#include <array>
#include <cerrno>
#include <fstream>
#include <system_error>

namespace strainwave {

namespace {

constexpr std::size_t kStackToTouch = std::size_t{256} * 1024;

std::string error_text(int error) {
  return std::generic_category().message(error);
}

// Pages of the stack that the loop may reach exist before it starts.
__attribute__((noinline)) void touch_stack() {
  std::array<char, kStackToTouch> stack;
  volatile char* page = stack.data();
  for (std::size_t i = 0; i < kStackToTouch; i += 1024) page[i] = 0;
}

}  // namespace

std::string lock_memory() {
  // The kernel makes and splits huge pages behind the loop's back, and whoever touches one meanwhile waits.
  if (::prctl(PR_SET_THP_DISABLE, 1, 0, 0, 0) != 0)
    return "transparent huge pages cannot be switched off (" + error_text(errno) + ")";
  // Freed memory stays mapped and large blocks come from the heap: no page appears or disappears later.
  ::mallopt(M_TRIM_THRESHOLD, -1);  // NOLINT(concurrency-mt-unsafe): before the loop's thread
  ::mallopt(M_MMAP_MAX, 0);         // NOLINT(concurrency-mt-unsafe): before the loop's thread
  if (::mlockall(MCL_CURRENT | MCL_FUTURE) == 0) return "";
  return "memory cannot be locked (" + error_text(errno) +
         "): run under the service, as root, or raise the limit with `ulimit -l unlimited`";
}

std::string compaction_warning(const std::string& setting_path) {
  std::ifstream setting(setting_path);
  int allowed = 0;
  if (!(setting >> allowed) || allowed == 0) return "";
  return "the kernel may move locked memory, and the loop would wait for it: sysctl "
         "vm.compact_unevictable_allowed=0";
}

std::string make_thread_real_time(int priority, int cpu) {
  touch_stack();
  if (cpu >= 0) {
    cpu_set_t set;
    CPU_ZERO(&set);
    CPU_SET(static_cast<std::size_t>(cpu), &set);
    if (const int error = ::pthread_setaffinity_np(::pthread_self(), sizeof set, &set))
      return "processor " + std::to_string(cpu) + " cannot be used (" + error_text(error) +
             "): change daemon.cpu";
  }
  sched_param parameter{};
  parameter.sched_priority = priority;
  if (const int error = ::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &parameter))
    return "SCHED_FIFO priority " + std::to_string(priority) + " is refused (" + error_text(error) +
           "): run under the service, as root, or raise the limit with `ulimit -r " +
           std::to_string(priority) + "`";
  return "";
}

long thread_page_faults() noexcept {
  rusage usage{};
  ::getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_minflt + usage.ru_majflt;
}

}  // namespace strainwave
