// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/commission/interruption.h"

#include <poll.h>
#include <unistd.h>

#include <array>

namespace strainwave {

namespace {

constexpr char kControlC = '\x03';

}  // namespace

Interruption::Interruption() : parent_(::getppid()) {
  termios terminal{};
  if (::isatty(STDIN_FILENO) == 0 || ::tcgetattr(STDIN_FILENO, &terminal) != 0) return;
  before_ = terminal;
  // Every key must end the motion, also Ctrl-C, Ctrl-S and Ctrl-Z.
  terminal.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO | ISIG | IEXTEN);
  terminal.c_iflag &= ~static_cast<tcflag_t>(IXON);
  ::tcsetattr(STDIN_FILENO, TCSANOW, &terminal);
}

Interruption::~Interruption() {
  if (before_) ::tcsetattr(STDIN_FILENO, TCSANOW, &*before_);
}

const char* Interruption::wait(int timeout_ms) noexcept {
  std::array<pollfd, 2> descriptors{{{signals_.descriptor(), POLLIN, 0}, {STDIN_FILENO, POLLIN, 0}}};
  if (::getppid() != parent_) return "interrupted: the program that started it has ended";
  if (::poll(descriptors.data(), before_ ? 2 : 1, timeout_ms) <= 0) return nullptr;
  if (signals_.take()) return "interrupted by a signal";
  char key = 0;
  // A lost terminal interrupts like a key.
  if ((descriptors[1].revents & (POLLHUP | POLLERR)) != 0) return "interrupted: the terminal was closed";
  if ((descriptors[1].revents & POLLIN) != 0 && ::read(STDIN_FILENO, &key, 1) >= 0)
    return key == kControlC ? "interrupted by Ctrl-C" : "interrupted by a key";
  return nullptr;
}

}  // namespace strainwave
