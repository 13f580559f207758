// SPDX-License-Identifier: BSD-3-Clause
// A file descriptor that closes itself. Not real-time: closing may block.
#pragma once

#include <unistd.h>

#include <utility>

namespace strainwave {

class UniqueFd {
 public:
  UniqueFd() = default;
  /// Takes what open(2), socket(2) and their like return; < 0: none, and errno stays as it is.
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
  /// Closes what it holds; false where the system says that something of it was lost.
  bool close() noexcept { return ::close(std::exchange(fd_, kNone)) == 0; }
  /// Closes what it holds and takes `fd`.
  void reset(int fd = kNone) noexcept {
    if (fd_ >= 0) ::close(fd_);
    fd_ = fd;
  }

 private:
  static constexpr int kNone = -1;
  int fd_ = kNone;
};

}  // namespace strainwave
