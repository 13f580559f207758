// SPDX-License-Identifier: BSD-3-Clause
// Reads and replaces whole files, and makes the folders for them. Not real-time.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace strainwave {

/// The file's bytes. Throws InputError when it cannot be read, is no regular file, or is larger than 128 MiB (no
/// file of the project is).
std::string read_text_file(const std::filesystem::path& path);

/// Replaces `path` by `text` in one step: a reader sees the old file or the new one, never a part, even
/// across a power failure. A symbolic link stays, and its target is replaced. Throws InputError with the system's reason; the old file then stays.
void write_text_file(const std::filesystem::path& path, std::string_view text);

/// Makes the folder and its missing parents. Throws InputError with the system's reason.
void make_folder(const std::filesystem::path& path);

}  // namespace strainwave
