// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/gateway/confinement.h"

#include <fcntl.h>
#include <grp.h>
#include <linux/capability.h>
#include <seccomp.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <memory>
#include <system_error>

#include "daemon/gateway/gateway_process.h"
#include "daemon/gateway/sanitized.h"

namespace strainwave {

namespace {

/// Shared memory and buffers take some 20 MiB; the rest is for programs and stacks.
constexpr rlim_t kAddressSpaceBytes = 512UL << 20;

[[noreturn]] void fail(const char* what, int error = errno) {
  throw std::system_error(error, std::generic_category(), what);
}

void become_user(std::int64_t uid, std::int64_t gid) {
  if (uid < 0) return;
  const auto user = static_cast<uid_t>(uid);
  const auto group = static_cast<gid_t>(gid);
  if (::setgroups(0, nullptr) != 0) fail("giving up groups");
  if (::setresgid(group, group, group) != 0) fail("changing the group");
  if (::setresuid(user, user, user) != 0) fail("changing the user");
}

// Without CAP_SETPCAP the bounding set stays; no_new_privs makes it meaningless then.
void empty_bounding_set() {
  for (unsigned long capability = 0; ::prctl(PR_CAPBSET_READ, capability, 0, 0, 0) >= 0; ++capability)
    if (::prctl(PR_CAPBSET_DROP, capability, 0, 0, 0) != 0 && errno != EPERM)
      fail("emptying the bounding set");
}

void give_up_capabilities() {
  if (::prctl(PR_CAP_AMBIENT, PR_CAP_AMBIENT_CLEAR_ALL, 0, 0, 0) != 0) fail("giving up ambient capabilities");
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  std::array<__user_cap_data_struct, _LINUX_CAPABILITY_U32S_3> none{};
  if (::syscall(SYS_capset, &header, none.data()) != 0) fail("giving up capabilities");
}

void limit(__rlimit_resource resource, rlim_t value) {
  const rlimit both{value, value};
  if (::setrlimit(resource, &both) != 0) fail("setting a resource limit");
}

void silence_standard_streams() {
  const int nowhere = ::open("/dev/null", O_RDWR | O_CLOEXEC);
  if (nowhere < 0) fail("opening /dev/null");
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::dup2(nowhere, stream) < 0) fail("silencing the standard streams");
  if (nowhere > STDERR_FILENO) ::close(nowhere);
}

using Filter = std::unique_ptr<void, decltype(&::seccomp_release)>;

void must(int result, const char* what) {
  if (result != 0) fail(what, -result);
}

void allow(const Filter& filter, int system_call) {
  must(::seccomp_rule_add(filter.get(), SCMP_ACT_ALLOW, system_call, 0), "allowing a system call");
}

void allow_if(const Filter& filter, int system_call, const scmp_arg_cmp& condition) {
  must(::seccomp_rule_add(filter.get(), SCMP_ACT_ALLOW, system_call, 1, condition), "allowing a system call");
}

// Allows receiving, sending and waiting on the open sockets. libseccomp leaves out calls that an architecture does not have. On
// 32-bit architectures the C library first tries the calls with 64-bit time.
void allow_receiving_and_sending(const Filter& filter) {
  for (const int call :
       {SCMP_SYS(recvmmsg), SCMP_SYS(recvmmsg_time64), SCMP_SYS(sendmsg), SCMP_SYS(poll), SCMP_SYS(ppoll),
        SCMP_SYS(ppoll_time64), SCMP_SYS(clock_gettime), SCMP_SYS(clock_gettime64), SCMP_SYS(gettimeofday),
        SCMP_SYS(restart_syscall), SCMP_SYS(rt_sigreturn), SCMP_SYS(sigreturn), SCMP_SYS(exit_group)})
    allow(filter, call);
  // LCM's library uses locks, although a single thread never waits for one.
  allow(filter, SCMP_SYS(futex));
  allow(filter, SCMP_SYS(futex_time64));
  // For waking the core, and for messages of libraries, which go to /dev/null.
  for (const int descriptor : {kGatewayWakeFd, STDERR_FILENO})
    allow_if(filter, SCMP_SYS(write), SCMP_A0(SCMP_CMP_EQ, static_cast<scmp_datum_t>(descriptor)));
}

// Allows memory, except executable memory.
void allow_memory(const Filter& filter) {
  for (const int call : {SCMP_SYS(brk), SCMP_SYS(munmap), SCMP_SYS(mremap)}) allow(filter, call);
  const scmp_arg_cmp not_executable = SCMP_A2(SCMP_CMP_MASKED_EQ, PROT_EXEC, 0);
  for (const int call : {SCMP_SYS(mmap), SCMP_SYS(mmap2), SCMP_SYS(mprotect)})
    allow_if(filter, call, not_executable);
}

Filter make_filter() {
  Filter filter(::seccomp_init(SCMP_ACT_KILL_PROCESS), &::seccomp_release);
  if (filter == nullptr) fail("filtering system calls", ENOMEM);
  return filter;
}

void fill(const Filter& filter) {
  allow_receiving_and_sending(filter);
  allow_memory(filter);
}

void filter_system_calls() {
  const Filter filter = make_filter();
  // The filter applies to all threads, should there ever be another one.
  must(::seccomp_attr_set(filter.get(), SCMP_FLTATR_CTL_TSYNC, 1), "filtering system calls");
  fill(filter);
  must(::seccomp_load(filter.get()), "loading the filter of system calls");
}

}  // namespace

bool has_system_call_filter() noexcept {
  return !kSanitized;
}

void export_system_call_filter(std::uint32_t architecture, int descriptor) {
  const Filter filter = make_filter();
  if (architecture != ::seccomp_arch_native()) {
    must(::seccomp_arch_add(filter.get(), architecture), "filtering for another architecture");
    must(::seccomp_arch_remove(filter.get(), SCMP_ARCH_NATIVE), "filtering for another architecture");
  }
  fill(filter);
  must(::seccomp_export_bpf(filter.get(), descriptor), "exporting the filter of system calls");
}

void give_up_privileges(std::int64_t uid, std::int64_t gid, unsigned int first_descriptor) {
  if (::close_range(first_descriptor, ~0U, 0) != 0) fail("closing descriptors");
  empty_bounding_set();
  become_user(uid, gid);
  give_up_capabilities();
  if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) fail("giving up new privileges");
  if (!kSanitized && ::prctl(PR_SET_DUMPABLE, 0, 0, 0, 0) != 0) fail("forbidding inspection");
  for (const auto resource : {RLIMIT_CORE, RLIMIT_RTPRIO, RLIMIT_NICE, RLIMIT_MEMLOCK, RLIMIT_MSGQUEUE})
    limit(resource, 0);
}

void confine() {
  silence_standard_streams();
  ::signal(SIGXFSZ, SIG_IGN);  // a write beyond the limit only fails
  limit(RLIMIT_FSIZE, 0);
  limit(RLIMIT_NPROC, 0);
  if (kSanitized) return;
  limit(RLIMIT_AS, kAddressSpaceBytes);
  filter_system_calls();
}

}  // namespace strainwave
