// SPDX-License-Identifier: BSD-3-Clause
// The operator's secret key on disk: a file of mode 0600 with one line. Not real-time.
#pragma once

#include <filesystem>
#include <string>

#include "lcmtypes/key_text.h"

namespace strainwave {

/// Reads the key in `path`. Throws InputError if the file is unreadable, accessible to other users, or not a secret key.
SecretKeyText read_secret_key(const std::filesystem::path& path);

/// Makes `path` (mode 0600) and `path`.pub with a new key. Throws InputError when either file exists: a key
/// in use is never overwritten.
AuthorizedKey write_new_key(const std::filesystem::path& path, Role role, const std::string& comment);

}  // namespace strainwave
