// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/end_signals.h"

#include <signal.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

#include "daemon/gateway/sanitized.h"

namespace strainwave {

namespace {

// By default, each of these signals would kill the daemon while joints move. Here each ends it in order. SIGKILL and SIGSTOP cannot be
// blocked.
constexpr std::array kEndSignals{SIGTERM, SIGINT,    SIGHUP,  SIGQUIT, SIGUSR1, SIGUSR2,   SIGALRM,
                                 SIGPROF, SIGVTALRM, SIGPOLL, SIGPWR,  SIGXCPU, SIGSTKFLT, SIGTRAP};

// Signals of a program's defect arrive here only if a process sends them. Those that the kernel raises for an instruction still kill,
// although blocked, and so does abort(). A build with a sanitizer leaves them out, because the sanitizer reports by them.
constexpr std::array kSignalsOfDefects{SIGABRT, SIGSYS, SIGSEGV, SIGBUS, SIGFPE, SIGILL};

}  // namespace

EndSignals::EndSignals() {
  sigset_t signals;
  ::sigemptyset(&signals);
  ::sigaddset(&signals, SIGCHLD);
  for (const int signal : kEndSignals) ::sigaddset(&signals, signal);
  for (const int signal : kSignalsOfDefects)
    if (!kSanitized) ::sigaddset(&signals, signal);
  for (int signal = SIGRTMIN; signal <= SIGRTMAX; ++signal) ::sigaddset(&signals, signal);
  // A terminal must not be able to suspend the loop.
  for (const int signal : {SIGTSTP, SIGTTIN, SIGTTOU}) ::signal(signal, SIG_IGN);
  ::pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  descriptor_ = UniqueFd(::signalfd(-1, &signals, SFD_CLOEXEC | SFD_NONBLOCK));
  if (!descriptor_) throw std::system_error(errno, std::generic_category(), "signalfd");
}

std::optional<int> EndSignals::take() noexcept {
  std::optional<int> first;
  signalfd_siginfo signal{};
  while (::read(descriptor_.get(), &signal, sizeof signal) == sizeof signal)
    if (signal.ssi_signo != SIGCHLD && !first) first = static_cast<int>(signal.ssi_signo);
  return first;
}

}  // namespace strainwave
