// SPDX-License-Identifier: BSD-3-Clause
// Who may give orders: the public keys of [security] authorized_keys with their roles. Not real-time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "lcmtypes/key_text.h"

namespace strainwave {

class AuthorizedKeys {
 public:
  static constexpr std::size_t kMaxKeys = 256;

  AuthorizedKeys() = default;
  /// Each with a key_id of its own.
  explicit AuthorizedKeys(std::vector<AuthorizedKey> keys) : keys_(std::move(keys)) {}

  std::size_t size() const noexcept { return keys_.size(); }
  const AuthorizedKey& operator[](std::size_t index) const noexcept { return keys_[index]; }
  /// The index of the key with this id, or nothing.
  std::optional<std::size_t> find(const KeyId& id) const noexcept;

 private:
  std::vector<AuthorizedKey> keys_;
};

/// What is believed of an order's origin.
struct SecurityPolicy {
  AuthorizedKeys keys;
  bool unsigned_allowed = false;  ///< orders without a signature are obeyed: for simulated joints only
  double lease_s = 2.0;           ///< the owner of a joint loses it after this silence
  std::int64_t order_lifetime_cycles = 1000;  ///< from the drawing of the challenge that an order quotes
};

/// The credential of the same file name, if the service manager hands one over ($CREDENTIALS_DIRECTORY; LoadCredential= in
/// the unit): the file itself may then be readable by root alone. Otherwise `path`.
std::filesystem::path credential_or_file(const std::filesystem::path& path);

/// Reads `path`: a key per line, see lcmtypes/key_text.h; empty lines and lines that begin with # are
/// skipped. Throws InputError with file and line: unreadable, writable by everyone, owned by a third user, no
/// key, a defective line, a key twice.
AuthorizedKeys read_authorized_keys(const std::filesystem::path& path);

}  // namespace strainwave
