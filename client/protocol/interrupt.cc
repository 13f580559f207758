// SPDX-License-Identifier: BSD-3-Clause
#include "client/protocol/interrupt.h"

#include <csignal>

namespace strainwave {

namespace {

volatile std::sig_atomic_t signal_seen = 0;

void note_signal(int) {
  signal_seen = 1;
}

}  // namespace

void catch_interrupts() {
  struct sigaction action = {};
  action.sa_handler = note_signal;
  action.sa_flags = static_cast<int>(SA_RESETHAND);  // a second signal ends the program
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  struct sigaction before = {};
  sigaction(SIGHUP, nullptr, &before);
  if (before.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
}

bool interrupted() noexcept {
  return signal_seen != 0;
}

void resume_after_interrupt() noexcept {
  signal_seen = 0;
}

}  // namespace strainwave
