// SPDX-License-Identifier: BSD-3-Clause
// A file of authorized keys for an example configuration whose joints are real.
#pragma once

#include <filesystem>
#include <fstream>

#include "lcmtypes/key_text.h"

namespace strainwave::testing {

/// Generates one operator's key and writes it to `folder`/authorized_keys.
inline void write_authorized_keys(const std::filesystem::path& folder) {
  const AuthorizedKey key{SecretKey::generate().public_key(), Role::kOperator, "test"};
  std::ofstream(folder / "authorized_keys") << to_line(key) << '\n';
  std::filesystem::permissions(folder / "authorized_keys",
                               std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
}

}  // namespace strainwave::testing
