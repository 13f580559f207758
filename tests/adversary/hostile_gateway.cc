// SPDX-License-Identifier: BSD-3-Clause
// A compromised gateway. The core starts it in place of the real one. It applies the real confinement and then makes the attempt that
// $STRAINWAVE_ATTEMPT names. It reports through its shared memory: turns = 1 before the attempt, 2 after a success. A refused attempt ends with
// status 3. With $STRAINWAVE_UNCONFINED it omits the last step of the confinement, so that a test can show that the attempt is real.
#include <fcntl.h>
#include <linux/can.h>
#include <netinet/in.h>
#include <sched.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <functional>
#include <map>
#include <string>

#include "daemon/gateway/confinement.h"
#include "daemon/gateway/gateway_process.h"
#include "daemon/gateway/shared_memory.h"

namespace {

using namespace strainwave;

struct Prey {
  pid_t core;
  int socket;      ///< a socket opened before the confinement
  void* outbound;  ///< the memory that the core writes
};

bool has(int descriptor) {
  return descriptor >= 0;
}

bool done(long result) {
  return result == 0;
}

bool make_core_get(const Prey& prey, int signal) {
  return done(::fcntl(prey.socket, F_SETOWN, prey.core)) && done(::fcntl(prey.socket, F_SETSIG, signal)) &&
         done(::fcntl(prey.socket, F_SETFL, O_ASYNC | O_NONBLOCK));
}

bool write_memory_of_core(const Prey& prey) {
  std::uint64_t value = 0;
  iovec here{&value, sizeof value};
  iovec there{prey.outbound, sizeof value};
  return ::process_vm_writev(prey.core, &here, 1, &there, 1, 0) > 0;
}

bool leave_a_child() {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(0);
  return child > 0;
}

bool set_limit_of_core(const Prey& prey) {
  const rlimit none{0, 0};
  return done(::prlimit(prey.core, RLIMIT_CORE, &none, nullptr));
}

bool schedule_core(const Prey& prey) {
  const sched_param lowest{};
  return done(::sched_setscheduler(prey.core, SCHED_IDLE, &lowest));
}

bool map_again(int descriptor, int protection) {
  return ::mmap(nullptr, 4096, protection, MAP_SHARED, descriptor, 0) != MAP_FAILED;
}

using Attempt = std::function<bool(const Prey&)>;

const std::map<std::string, Attempt> kAttempts{
    {"stop the core by an asynchronous socket", [](const Prey& p) { return make_core_get(p, SIGSTOP); }},
    {"kill the core by an asynchronous socket", [](const Prey& p) { return make_core_get(p, SIGKILL); }},
    {"signal the core", [](const Prey& p) { return done(::kill(p.core, SIGCONT)); }},
    {"signal the core by its descriptor",
     [](const Prey& p) { return has(static_cast<int>(::syscall(SYS_pidfd_open, p.core, 0))); }},
    {"schedule the core", schedule_core},
    {"put the core behind everybody",
     [](const Prey& p) { return done(::setpriority(PRIO_PROCESS, static_cast<id_t>(p.core), 19)); }},
    {"go before everybody", [](const Prey&) { return done(::setpriority(PRIO_PROCESS, 0, -20)); }},
    {"move the core to another processor",
     [](const Prey& p) {
       cpu_set_t set;
       CPU_ZERO(&set);
       CPU_SET(0, &set);
       return done(::sched_setaffinity(p.core, sizeof set, &set));
     }},
    {"limit the core", set_limit_of_core},
    {"leave a child behind", [](const Prey&) { return leave_a_child(); }},
    {"start a program", [](const Prey&) { return done(::execl("/bin/true", "true", nullptr)); }},
    {"make the wake block", [](const Prey&) { return done(::fcntl(kGatewayWakeFd, F_SETFL, 0)); }},
    {"make the wake block by ioctl",
     [](const Prey&) {
       int off = 0;
       return done(::ioctl(kGatewayWakeFd, FIONBIO, &off));
     }},
    {"open a CAN socket", [](const Prey&) { return has(::socket(AF_CAN, SOCK_RAW, CAN_RAW)); }},
    {"open a local socket", [](const Prey&) { return has(::socket(AF_UNIX, SOCK_STREAM, 0)); }},
    {"open a TCP socket", [](const Prey&) { return has(::socket(AF_INET, SOCK_STREAM, 0)); }},
    {"open a UDP socket", [](const Prey&) { return has(::socket(AF_INET, SOCK_DGRAM, 0)); }},
    {"open a netlink socket", [](const Prey&) { return has(::socket(AF_NETLINK, SOCK_RAW, 0)); }},
    {"open a file", [](const Prey&) { return has(::open("/etc/passwd", O_RDONLY)); }},
    {"trace the core", [](const Prey& p) { return done(::ptrace(PTRACE_ATTACH, p.core, nullptr, nullptr)); }},
    {"write the core's memory", write_memory_of_core},
    {"make the core's shared memory writable",
     [](const Prey& p) { return done(::mprotect(p.outbound, 4096, PROT_READ | PROT_WRITE)); }},
    {"map the core's shared memory writable",
     [](const Prey&) { return map_again(kGatewayOutboundFd, PROT_READ | PROT_WRITE); }},
    {"shrink the shared memory", [](const Prey&) { return done(::ftruncate(kGatewayInboundFd, 0)); }},
    {"write the shared file", [](const Prey& p) { return ::write(kGatewayOutboundFd, p.outbound, 1) == 1; }},
    {"make memory that runs",
     [](const Prey&) { return map_again(kGatewayInboundFd, PROT_READ | PROT_EXEC); }},
    {"take privileges", [](const Prey&) { return done(::prctl(PR_SET_DUMPABLE, 1, 0, 0, 0)); }},
};

}  // namespace

int main() {
  // NOLINTBEGIN(concurrency-mt-unsafe): one thread
  const char* attempt = std::getenv("STRAINWAVE_ATTEMPT");
  const bool confined = std::getenv("STRAINWAVE_UNCONFINED") == nullptr;
  // NOLINTEND(concurrency-mt-unsafe)
  if (attempt == nullptr || !kAttempts.contains(attempt)) return 4;
  const MemoryFile outbound = MemoryFile::open(kGatewayOutboundFd, sizeof(OutboundMemory), false);
  const MemoryFile inbound = MemoryFile::open(kGatewayInboundFd, sizeof(InboundMemory), true);
  auto& report = *static_cast<InboundMemory*>(inbound.address());
  give_up_privileges(-1, -1, kGatewayFirstFreeFd);
  const Prey prey{::getppid(), ::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK, 0), outbound.address()};
  if (confined) confine();
  report.turns.store(1);
  const bool succeeded = kAttempts.at(attempt)(prey);
  if (succeeded) report.turns.store(2);
  ::_exit(succeeded ? 0 : 3);
}
