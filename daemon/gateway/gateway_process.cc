#include "daemon/gateway/gateway_process.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <system_error>

extern char** environ;

namespace strainwave {

namespace {

constexpr std::int64_t kFirstBackoff_ns = 100'000'000;
/// Together with its start, which takes some 10 ms, it is back within a second however often it was killed.
constexpr std::int64_t kLongestBackoff_ns = 800'000'000;
/// One that lived this long is not a crash loop.
constexpr std::int64_t kStable_ns = 5'000'000'000;

}  // namespace

GatewayProcess::GatewayProcess(std::string program, Descriptors descriptors)
    : program_(std::move(program)), descriptors_(descriptors), backoff_ns_(kFirstBackoff_ns) {
  open_program();
}

GatewayProcess::~GatewayProcess() {
  if (program_fd_ >= 0) ::close(program_fd_);
  if (pid_ <= 0) return;
  ::kill(pid_, SIGKILL);
  ::waitpid(pid_, nullptr, 0);
}

void GatewayProcess::open_program() {
  if (program_fd_ < 0) program_fd_ = ::open(program_.c_str(), O_PATH | O_CLOEXEC);
}

void GatewayProcess::start(std::int64_t now_ns) {
  open_program();
  if (program_fd_ < 0) {
    const int error = errno;
    back_off(now_ns);
    throw std::system_error(error, std::generic_category(), "starting " + program_);
  }
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawnattr_init(&attributes);
  // Two rounds: the fixed numbers may be in use by the very descriptors that are to be moved there.
  constexpr int kAway = 64;
  constexpr int kProgram = kAway + 3;
  const std::array<int, 4> from{descriptors_.outbound, descriptors_.inbound, descriptors_.wake, program_fd_};
  for (int i = 0; i < 4; ++i)
    ::posix_spawn_file_actions_adddup2(&actions, from[static_cast<std::size_t>(i)], kAway + i);
  for (int i = 0; i < 3; ++i) ::posix_spawn_file_actions_adddup2(&actions, kAway + i, kGatewayOutboundFd + i);
  for (int i = 0; i < 3; ++i) ::posix_spawn_file_actions_addclose(&actions, kAway + i);
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
  if (error != 0) {
    back_off(now_ns);
    throw std::system_error(error, std::generic_category(), "starting " + program_);
  }
  pid_ = pid;
  started_ns_ = now_ns;
}

std::optional<std::string> GatewayProcess::take_end(std::int64_t now_ns) {
  int status = 0;
  if (pid_ <= 0 || ::waitpid(pid_, &status, WNOHANG) != pid_) return std::nullopt;
  pid_ = -1;
  if (now_ns - started_ns_ > kStable_ns) backoff_ns_ = kFirstBackoff_ns;
  back_off(now_ns);
  last_exit_status_ = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return WIFEXITED(status) ? "exit status " + std::to_string(WEXITSTATUS(status))
                           : "signal " + std::to_string(WTERMSIG(status));
}

void GatewayProcess::kill() noexcept {
  if (pid_ > 0) ::kill(pid_, SIGKILL);
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
