// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/can_nodes/node_program.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/signalfd.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <system_error>

namespace strainwave::can_nodes {

namespace {

std::int64_t clock_us(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return std::int64_t{now.tv_sec} * 1000000 + now.tv_nsec / 1000;
}

int open_control(const std::string& path) {
  if (path.empty()) return -1;
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof address.sun_path)
    throw std::system_error(ENAMETOOLONG, std::generic_category(), "control socket '" + path + "'");
  std::copy(path.begin(), path.end(), address.sun_path);
  ::unlink(path.c_str());
  const int descriptor = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (descriptor < 0 || ::bind(descriptor, std::bit_cast<const sockaddr*>(&address), sizeof address) != 0)
    throw std::system_error(errno, std::generic_category(), "control socket '" + path + "'");
  return descriptor;
}

int open_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  sigprocmask(SIG_BLOCK, &signals, nullptr);
  return ::signalfd(-1, &signals, SFD_CLOEXEC | SFD_NONBLOCK);
}

// Splits input into lines. Returns false at the end of the input.
class CommandReader {
 public:
  CommandReader(Node& node, BusAndRecord& record) : node_(node), record_(record) {}

  bool read_from(int descriptor) {
    std::array<char, 512> bytes{};
    const ssize_t size = ::read(descriptor, bytes.data(), bytes.size());
    if (size <= 0) return size < 0 && (errno == EAGAIN || errno == EINTR);
    text_.append(bytes.data(), static_cast<std::size_t>(size));
    for (auto end = text_.find('\n'); end != std::string::npos; end = text_.find('\n')) {
      obey(text_.substr(0, end));
      text_.erase(0, end + 1);
    }
    return true;
  }
  bool quits() const { return quits_; }

 private:
  void obey(const std::string& line) {
    if (line == "quit") {
      quits_ = true;
      return;
    }
    const std::string wrong = node_.command(line, clock_us(CLOCK_MONOTONIC));
    record_.note(wrong.empty() ? "told " + line : "error " + wrong);
  }

  Node& node_;
  BusAndRecord& record_;
  std::string text_;
  bool quits_ = false;
};

}  // namespace

void BusAndRecord::send(const Frame& frame) {
  const bool lost = !port_.send(frame);
  if (lost && !told_of_loss_) note(std::string("frame-lost ") + std::strerror(errno));
  told_of_loss_ = lost;
}

void BusAndRecord::note(const std::string& line) {
  std::printf("%lld %s\n", static_cast<long long>(clock_us(CLOCK_REALTIME)), line.c_str());
  std::fflush(stdout);
}

int run_node(Node& node, CanPort& port, BusAndRecord& record, const std::string& control_path) {
  const int control = open_control(control_path);
  CommandReader commands(node, record);
  std::array<pollfd, 4> watched{{{port.descriptor(), POLLIN, 0},
                                 {control, POLLIN, 0},
                                 {open_signals(), POLLIN, 0},
                                 {STDIN_FILENO, POLLIN, 0}}};
  node.power_on(clock_us(CLOCK_MONOTONIC));
  while (!commands.quits()) {
    const std::int64_t wait_us =
        std::max<std::int64_t>(0, node.next_deadline_us() - clock_us(CLOCK_MONOTONIC));
    const timespec wait{wait_us / 1000000, (wait_us % 1000000) * 1000};
    if (::ppoll(watched.data(), watched.size(), &wait, nullptr) < 0 && errno != EINTR)
      throw std::system_error(errno, std::generic_category(), "poll");
    while (const std::optional<Frame> frame = port.receive()) node.receive(*frame, clock_us(CLOCK_MONOTONIC));
    node.advance(clock_us(CLOCK_MONOTONIC));
    if (watched[1].revents != 0) commands.read_from(control);
    if (watched[2].revents != 0) break;
    // A closed standard input ends the commands, not the node.
    if (watched[3].revents != 0 && !commands.read_from(STDIN_FILENO)) watched[3].fd = -1;
  }
  if (control >= 0) ::unlink(control_path.c_str());
  return 0;
}

}  // namespace strainwave::can_nodes
