// SPDX-License-Identifier: BSD-3-Clause
// The public keys that may sign orders, with their roles: the file security.authorized_keys. Not real-time.
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
  /// The key ids must differ.
  explicit AuthorizedKeys(std::vector<AuthorizedKey> keys) : keys_(std::move(keys)) {}

  std::size_t size() const noexcept { return keys_.size(); }
  const AuthorizedKey& operator[](std::size_t index) const noexcept { return keys_[index]; }
  /// The index of the key with this id, or nothing.
  std::optional<std::size_t> find(const KeyId& id) const noexcept;

 private:
  std::vector<AuthorizedKey> keys_;
};

/// Which orders are trusted, and for how long.
struct SecurityPolicy {
  AuthorizedKeys keys;
  bool unsigned_allowed = false;              ///< obeys orders without a signature: for simulated joints only
  double lease_s = 2.0;                       ///< the owner of a joint loses it after this silence
  std::int64_t order_lifetime_cycles = 1000;  ///< from the draw of the quoted challenge
};

/// The credential with the same file name, if the service manager provides one ($CREDENTIALS_DIRECTORY; LoadCredential= in
/// the unit). The file itself may then be readable only by root. Without a credential: `path`.
std::filesystem::path credential_or_file(const std::filesystem::path& path);

/// Reads `path`: a key per line, see lcmtypes/key_text.h; empty lines and lines that begin with # are
/// skipped. Throws InputError with file and line if the file is unreadable, too large or writable for others. Also throws
/// if it has no key, too many keys, a defective line, or a key twice.
AuthorizedKeys read_authorized_keys(const std::filesystem::path& path);

}  // namespace strainwave
