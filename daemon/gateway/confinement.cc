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
#include <memory>
#include <system_error>

#include "daemon/gateway/sanitized.h"

namespace strainwave {

namespace {

/// LCM keeps up to 16 MiB of fragments and its buffers; the rest is programs and stacks.
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

void add_rule(const Filter& filter, std::uint32_t action, int system_call) {
  if (const int result = ::seccomp_rule_add(filter.get(), action, system_call, 0))
    fail("filtering system calls", -result);
}

void add_rule(const Filter& filter, std::uint32_t action, int system_call, const scmp_arg_cmp& condition) {
  if (const int result = ::seccomp_rule_add(filter.get(), action, system_call, 1, condition))
    fail("filtering system calls", -result);
}

// Before LCM opens its socket nothing hostile has been read; from then on it could be. Setting LCM up needs files and a
// thread, but no other process: as the daemon's own user the gateway could otherwise signal it or write its memory.
void keep_from_other_processes() {
  const Filter filter(::seccomp_init(SCMP_ACT_ALLOW), &::seccomp_release);
  if (filter == nullptr) fail("keeping from other processes", ENOMEM);
  for (const int call :
       {SCMP_SYS(kill), SCMP_SYS(tkill), SCMP_SYS(rt_sigqueueinfo), SCMP_SYS(rt_tgsigqueueinfo),
        SCMP_SYS(pidfd_open), SCMP_SYS(pidfd_getfd), SCMP_SYS(pidfd_send_signal), SCMP_SYS(ptrace),
        SCMP_SYS(process_vm_readv), SCMP_SYS(process_vm_writev), SCMP_SYS(process_madvise), SCMP_SYS(execve),
        SCMP_SYS(execveat), SCMP_SYS(fork), SCMP_SYS(vfork), SCMP_SYS(io_uring_setup), SCMP_SYS(bpf),
        SCMP_SYS(userfaultfd)})
    add_rule(filter, SCMP_ACT_KILL_PROCESS, call);
  const auto own_pid = static_cast<scmp_datum_t>(::getpid());
  const scmp_arg_cmp another = SCMP_A0(SCMP_CMP_NE, own_pid);
  add_rule(filter, SCMP_ACT_KILL_PROCESS, SCMP_SYS(tgkill), another);
  if (const int result = ::seccomp_load(filter.get())) fail("keeping from other processes", -result);
}

void allow_what_receiving_and_sending_needs(const Filter& filter) {
  for (const int call : {SCMP_SYS(read), SCMP_SYS(write), SCMP_SYS(recvmsg), SCMP_SYS(recvfrom),
                         SCMP_SYS(sendmsg), SCMP_SYS(sendto), SCMP_SYS(poll), SCMP_SYS(ppoll),
                         SCMP_SYS(select), SCMP_SYS(pselect6), SCMP_SYS(_newselect), SCMP_SYS(close)})
    add_rule(filter, SCMP_ACT_ALLOW, call);
  for (const int call :
       {SCMP_SYS(futex), SCMP_SYS(clock_gettime), SCMP_SYS(clock_nanosleep), SCMP_SYS(nanosleep),
        SCMP_SYS(gettimeofday), SCMP_SYS(time), SCMP_SYS(sched_yield), SCMP_SYS(restart_syscall),
        SCMP_SYS(rt_sigreturn), SCMP_SYS(rt_sigprocmask), SCMP_SYS(getpid), SCMP_SYS(getppid),
        SCMP_SYS(gettid), SCMP_SYS(exit), SCMP_SYS(exit_group)})
    add_rule(filter, SCMP_ACT_ALLOW, call);
  for (const int call : {SCMP_SYS(brk), SCMP_SYS(munmap), SCMP_SYS(mremap), SCMP_SYS(madvise)})
    add_rule(filter, SCMP_ACT_ALLOW, call);
  // Memory, but none that can be run.
  const scmp_arg_cmp not_executable = SCMP_A2(SCMP_CMP_MASKED_EQ, PROT_EXEC, 0);
  add_rule(filter, SCMP_ACT_ALLOW, SCMP_SYS(mmap), not_executable);
  add_rule(filter, SCMP_ACT_ALLOW, SCMP_SYS(mmap2), not_executable);
  add_rule(filter, SCMP_ACT_ALLOW, SCMP_SYS(mprotect), not_executable);
  // abort() signals itself, nobody else.
  const scmp_arg_cmp itself = SCMP_A0(SCMP_CMP_EQ, static_cast<scmp_datum_t>(::getpid()));
  add_rule(filter, SCMP_ACT_ALLOW, SCMP_SYS(tgkill), itself);
}

// What libraries may try and can do without: the C library's perror(), malloc's names for memory, GLib's
// curiosity.
void refuse_what_libraries_try(const Filter& filter) {
  for (const int call :
       {SCMP_SYS(dup), SCMP_SYS(fcntl), SCMP_SYS(fstat), SCMP_SYS(newfstatat), SCMP_SYS(prctl),
        SCMP_SYS(open), SCMP_SYS(openat), SCMP_SYS(sched_getaffinity), SCMP_SYS(getrandom)})
    add_rule(filter, SCMP_ACT_ERRNO(EPERM), call);
}

void filter_system_calls() {
  const Filter filter(::seccomp_init(SCMP_ACT_KILL_PROCESS), &::seccomp_release);
  if (filter == nullptr) fail("filtering system calls", ENOMEM);
  // LCM's reader is a thread of its own, and already there.
  if (const int result = ::seccomp_attr_set(filter.get(), SCMP_FLTATR_CTL_TSYNC, 1))
    fail("filtering system calls", -result);
  allow_what_receiving_and_sending_needs(filter);
  refuse_what_libraries_try(filter);
  if (const int result = ::seccomp_load(filter.get())) fail("loading the filter of system calls", -result);
}

}  // namespace

bool has_system_call_filter() noexcept {
  return !kSanitized;
}

void confine_before_setup(std::int64_t uid, std::int64_t gid, unsigned int first_descriptor) {
  if (::close_range(first_descriptor, ~0U, 0) != 0) fail("closing descriptors");
  empty_bounding_set();
  become_user(uid, gid);
  give_up_capabilities();
  if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) fail("giving up new privileges");
  if (!kSanitized && ::prctl(PR_SET_DUMPABLE, 0, 0, 0, 0) != 0) fail("forbidding inspection");
  for (const auto resource : {RLIMIT_CORE, RLIMIT_RTPRIO, RLIMIT_MEMLOCK, RLIMIT_MSGQUEUE})
    limit(resource, 0);
  if (!kSanitized) keep_from_other_processes();
}

void confine_after_setup() {
  silence_standard_streams();
  ::signal(SIGXFSZ, SIG_IGN);  // a write beyond the limit fails, no more
  limit(RLIMIT_FSIZE, 0);
  limit(RLIMIT_NPROC, 0);
  if (kSanitized) return;
  limit(RLIMIT_AS, kAddressSpaceBytes);
  filter_system_calls();
}

}  // namespace strainwave
