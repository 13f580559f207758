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

// Every signal that somebody or something may send and that would kill the core, in motion: they all end it in order. SIGKILL and
// SIGSTOP nobody can refuse.
constexpr std::array kEndSignals{SIGTERM, SIGINT,    SIGHUP,  SIGQUIT, SIGUSR1, SIGUSR2,   SIGALRM,
                                 SIGPROF, SIGVTALRM, SIGPOLL, SIGPWR,  SIGXCPU, SIGSTKFLT, SIGTRAP};

// Those that say that the program is broken come here only when somebody sent them: what the kernel raises for an instruction, and
// abort(), which lets its own through, kill though they are blocked. A sanitizer reports by them.
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
  // A terminal must not be able to make the loop stand still.
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
