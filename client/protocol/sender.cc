// SPDX-License-Identifier: BSD-3-Clause
#include "client/protocol/sender.h"

#include <limits.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <string>

#include "client/protocol/key_file.h"

namespace strainwave {

namespace {

// FNV-1a: the Python package (client/python) computes the same number.
std::uint64_t hash_of(const std::string& text) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char character : text) hash = (hash ^ static_cast<std::uint8_t>(character)) * 0x100000001b3;
  return hash;
}

// 62 bits from the names of this machine and user, and of the program if it owns joints for itself. Never 0.
std::int64_t own_identity(const std::string& program) {
  std::array<char, HOST_NAME_MAX + 1> host{};
  (void)::gethostname(host.data(), host.size() - 1);
  std::string machine;
  std::ifstream("/etc/machine-id") >> machine;
  const std::string name =
      machine + "/" + host.data() + "/" + std::to_string(::getuid()) + (program.empty() ? "" : "/" + program);
  return static_cast<std::int64_t>(hash_of(name) >> 2) + 1;
}

}  // namespace

Sender::Sender(std::filesystem::path key_file, const std::string& program)
    : sender_id_(own_identity(program)), key_file_(std::move(key_file)) {}

std::int64_t Sender::next_sequence(std::int64_t utime) noexcept {
  sequence_ = std::max(sequence_ + 1, utime);
  return sequence_;
}

void Sender::sign_if_keyed(const std::string& channel, std::span<std::uint8_t> bytes) {
  if (!key_ && !key_file_.empty()) key_ = read_secret_key(key_file_).key;
  if (key_) sign(channel, *key_, bytes);
}

}  // namespace strainwave
