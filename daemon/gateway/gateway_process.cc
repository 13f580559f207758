// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/gateway/gateway_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

#include "daemon/gateway/descriptor_message.h"

extern char** environ;

namespace strainwave {

namespace {

constexpr std::int64_t kFirstBackoff_ns = 100'000'000;
/// With its start of some 10 ms, the gateway is back within a second however often it was killed.
constexpr std::int64_t kLongestBackoff_ns = 800'000'000;
/// A gateway that lived this long is not in a crash loop.
constexpr std::int64_t kStable_ns = 5'000'000'000;

[[noreturn]] void fail(int error, const std::string& what) {
  throw std::system_error(error, std::generic_category(), what);
}

}  // namespace

GatewayProcess::GatewayProcess(std::string program, Descriptors descriptors, std::string service_socket)
    : program_(std::move(program)),
      service_socket_(std::move(service_socket)),
      descriptors_(descriptors),
      backoff_ns_(kFirstBackoff_ns) {
  open_program();
}

GatewayProcess::~GatewayProcess() {
  connection_.reset();
  if (pid_ <= 0) return;
  ::kill(pid_, SIGKILL);
  ::waitpid(pid_, nullptr, 0);
}

void GatewayProcess::open_program() {
  if (!program_fd_) program_fd_.reset(::open(program_.c_str(), O_PATH | O_CLOEXEC));
}

void GatewayProcess::start(std::int64_t now_ns) {
  try {
    open_program();
    if (!program_fd_) fail(errno, "starting " + program_);
    if (service_socket_.empty())
      connection_ = spawn();
    else
      connect_service();
  } catch (const std::system_error&) {
    connection_.reset();
    back_off(now_ns);
    throw;
  }
  started_ns_ = now_ns;
}

/// Returns the core's end of the connection.
UniqueFd GatewayProcess::spawn() {
  std::array<int, 2> connection{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, connection.data()) != 0)
    fail(errno, "starting " + program_);
  UniqueFd core_end(connection[0]);
  const UniqueFd gateway_end(connection[1]);
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawnattr_init(&attributes);
  // Two rounds: the fixed numbers may be in use by the very descriptors that are to be moved there.
  constexpr int kAway = 64;
  constexpr int kProgram = kAway + 4;
  const std::array<int, 5> from{descriptors_.outbound, descriptors_.inbound, descriptors_.wake,
                                gateway_end.get(), program_fd_.get()};
  for (int i = 0; i < 5; ++i)
    ::posix_spawn_file_actions_adddup2(&actions, from[static_cast<std::size_t>(i)], kAway + i);
  for (int i = 0; i < 4; ++i) ::posix_spawn_file_actions_adddup2(&actions, kAway + i, kGatewayOutboundFd + i);
  for (int i = 0; i < 4; ++i) ::posix_spawn_file_actions_addclose(&actions, kAway + i);
  sigset_t none;
  ::sigemptyset(&none);
  ::posix_spawnattr_setsigmask(&attributes, &none);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
  std::string name = "strainwave-gateway";
  std::array<char*, 2> arguments{name.data(), nullptr};
  pid_t pid = -1;
  const std::string held = "/proc/self/fd/" + std::to_string(kProgram);
  const int error = ::posix_spawn(&pid, held.c_str(), &actions, &attributes, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  ::posix_spawnattr_destroy(&attributes);
  if (error != 0) fail(error, "starting " + program_);
  pid_ = pid;
  return core_end;
}

void GatewayProcess::connect_service() {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (service_socket_.size() >= sizeof address.sun_path) fail(ENAMETOOLONG, service_socket_);
  std::copy(service_socket_.begin(), service_socket_.end(), &address.sun_path[0]);
  connection_.reset(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!connection_ ||
      ::connect(connection_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
    fail(errno, "starting the gateway through " + service_socket_);
  send_descriptors(connection_.get(),
                   {descriptors_.outbound, descriptors_.inbound, descriptors_.wake, program_fd_.get()});
}

std::optional<std::string> GatewayProcess::take_end(std::int64_t now_ns) {
  if (!running()) return std::nullopt;
  auto end = pid_ > 0 ? end_of_child() : end_of_service();
  if (!end) return std::nullopt;
  connection_.reset();
  if (now_ns - started_ns_ > kStable_ns) backoff_ns_ = kFirstBackoff_ns;
  back_off(now_ns);
  return end;
}

std::optional<std::string> GatewayProcess::end_of_child() {
  int status = 0;
  if (::waitpid(pid_, &status, WNOHANG) != pid_) return std::nullopt;
  pid_ = -1;
  last_exit_status_ = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return WIFEXITED(status) ? "exit status " + std::to_string(WEXITSTATUS(status))
                           : "signal " + std::to_string(WTERMSIG(status));
}

// Checks only for a hang-up: the core reads no data from a process of another user.
std::optional<std::string> GatewayProcess::end_of_service() {
  pollfd peer{connection_.get(), POLLRDHUP, 0};
  if (::poll(&peer, 1, 0) != 1 || (peer.revents & (POLLHUP | POLLERR | POLLRDHUP)) == 0) return std::nullopt;
  return "its service, see journalctl -u 'strainwave-gateway@*'";
}

void GatewayProcess::kill() noexcept {
  if (pid_ > 0) ::kill(pid_, SIGKILL);
  // The connection stays open in the other direction, to show when the gateway has gone.
  else if (running())
    ::shutdown(connection_.get(), SHUT_WR);
}

void GatewayProcess::back_off(std::int64_t now_ns) noexcept {
  not_before_ns_ = now_ns + backoff_ns_;
  backoff_ns_ = std::min(2 * backoff_ns_, kLongestBackoff_ns);
}

std::string find_gateway_program() {
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe");
  const std::filesystem::path beside = self.parent_path() / "strainwave-gateway";
  if (std::filesystem::exists(beside)) return beside;
  return self.parent_path().parent_path() / "libexec" / "strainwave" / "strainwave-gateway";
}

}  // namespace strainwave
