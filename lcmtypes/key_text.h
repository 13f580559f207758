// SPDX-License-Identifier: BSD-3-Clause
// Keys as text: one line each, "ed25519 <base64> <role> <comment>" for a public key (the lines of
// authorized_keys) and "ed25519-secret <base64> <role> <comment>" for a secret one. Not real-time.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "lcmtypes/signing.h"

namespace strainwave {

/// Rights of a key. An engineer has all rights of an operator.
enum class Role {
  kOperator,  ///< setpoints and commands
  kEngineer,  ///< also gain tables
};
std::string_view to_text(Role role) noexcept;
std::optional<Role> parse_role(std::string_view text) noexcept;

struct AuthorizedKey {
  PublicKey key;
  Role role = Role::kOperator;
  std::string comment;  ///< the key's owner; printable, may be empty
};

struct SecretKeyText {
  SecretKey key;
  Role role = Role::kOperator;  ///< role in the .pub line; the role in the daemon's file decides
  std::string comment;
};

/// Both return the line without a line end.
std::string to_line(const AuthorizedKey& key);
std::string to_line(const SecretKeyText& key);

/// Both throw InputError with the defect of the line and the remedy. The error never quotes the line, because it may
/// be secret.
AuthorizedKey parse_public_line(std::string_view line);
SecretKeyText parse_secret_line(std::string_view line);

/// Whether `comment` may stand in a line: at most 100 bytes, no control characters, no space at either end.
bool is_valid_comment(std::string_view comment) noexcept;

}  // namespace strainwave
