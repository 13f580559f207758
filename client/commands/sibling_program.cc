// SPDX-License-Identifier: BSD-3-Clause
#include "client/commands/sibling_program.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <system_error>

#include "base/unique_fd.h"
#include "client/protocol/client.h"
#include "client/protocol/interrupt.h"
#include "strainwave/client_error.h"

namespace strainwave {

namespace {

// A signal just before a wait does not end that wait. So each wait lasts at most this long.
constexpr int kLook_ms = 50;

/// Captures the standard output and standard error of a child, if requested.
class Capture {
 public:
  explicit Capture(std::string* into) : into_(into) {
    ::posix_spawn_file_actions_init(&actions_);
    if (into_ == nullptr) return;
    std::array<int, 2> ends{-1, -1};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0)
      throw std::system_error(errno, std::generic_category(), "making a pipe");
    read_end_.reset(ends[0]);
    write_end_.reset(ends[1]);
    ::posix_spawn_file_actions_adddup2(&actions_, ends[1], STDOUT_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions_, ends[1], STDERR_FILENO);
  }
  ~Capture() { ::posix_spawn_file_actions_destroy(&actions_); }
  Capture(const Capture&) = delete;
  Capture& operator=(const Capture&) = delete;

  const posix_spawn_file_actions_t* actions() const noexcept { return &actions_; }
  /// Closes the write end after the child has its copy. Otherwise the pipe would never reach its end.
  void close_write_end() { write_end_.reset(); }
  /// Waits for a while and appends the new output. Call it also after the child's end, until the pipe closes.
  void read_some() {
    pollfd readable{read_end_.get(), POLLIN, 0};
    if (::poll(&readable, 1, kLook_ms) <= 0 || !read_end_) return;
    std::array<char, 4096> part{};
    const ssize_t size = ::read(read_end_.get(), part.data(), part.size());
    if (size > 0) into_->append(part.data(), static_cast<std::size_t>(size));
    if (size == 0) read_end_.reset();
  }
  bool open() const { return static_cast<bool>(read_end_); }

 private:
  std::string* into_;
  UniqueFd read_end_;
  UniqueFd write_end_;
  posix_spawn_file_actions_t actions_{};
};

}  // namespace

int run_sibling(const std::string& name, const std::vector<std::string>& arguments, std::string* printed) {
  if (interrupted()) return 128 + SIGTERM;
  std::error_code error;
  const std::string program = std::filesystem::read_symlink("/proc/self/exe", error).parent_path() / name;
  std::vector<std::string> words{program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  pid_t child = -1;
  Capture capture(printed);
  if (const int failure =
          ::posix_spawn(&child, program.c_str(), capture.actions(), nullptr, argv.data(), environ);
      failure != 0)
    throw ClientError(ExitStatus::kUsage, program +
                                              " cannot be run: " + std::generic_category().message(failure) +
                                              ": install it beside strainwavectl");
  capture.close_write_end();
  int status = 0;
  bool passed_on = false;
  for (bool ended = false; !ended || capture.open();) {
    capture.read_some();
    // Ctrl-C reaches both programs. A signal to this program alone must be passed on.
    if (interrupted() && !ended && !passed_on) passed_on = ::kill(child, SIGTERM) == 0;
    if (ended) continue;
    const pid_t waited = ::waitpid(child, &status, WNOHANG);
    if (waited < 0 && errno != EINTR)
      throw std::system_error(errno, std::generic_category(), "waiting for " + name);
    ended = waited == child;
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace strainwave
