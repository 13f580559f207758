// SPDX-License-Identifier: BSD-3-Clause
// A file descriptor that closes itself. Not real-time: closing may block.
#pragma once

#include <unistd.h>

#include <utility>

namespace strainwave {

class UniqueFd {
 public:
  UniqueFd() = default;
  /// Takes the result of open(2), socket(2) and similar calls. A negative one means no descriptor, and errno stays unchanged.
  explicit UniqueFd(int fd) noexcept : fd_(fd) {}
  UniqueFd(UniqueFd&& other) noexcept : fd_(std::exchange(other.fd_, kNone)) {}
  UniqueFd& operator=(UniqueFd&& other) noexcept {
    if (this != &other) reset(std::exchange(other.fd_, kNone));
    return *this;
  }
  UniqueFd(const UniqueFd&) = delete;
  UniqueFd& operator=(const UniqueFd&) = delete;
  ~UniqueFd() { reset(); }

  int get() const noexcept { return fd_; }
  explicit operator bool() const noexcept { return fd_ >= 0; }
  /// Closes the descriptor. False if the system reports an error, such as lost data.
  bool close() noexcept { return ::close(std::exchange(fd_, kNone)) == 0; }
  /// Closes the descriptor and takes `fd`.
  void reset(int fd = kNone) noexcept {
    if (fd_ >= 0) ::close(fd_);
    fd_ = fd;
  }

 private:
  static constexpr int kNone = -1;
  int fd_ = kNone;
};

}  // namespace strainwave
