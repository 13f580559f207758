// SPDX-License-Identifier: BSD-3-Clause
// Whole files, read at once and replaced at once, and the folders that they are written to. Not real-time.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace strainwave {

/// The file's bytes. Throws InputError when it cannot be read, is no regular file, or is larger than 128 MiB (no
/// file of ours is).
std::string read_text_file(const std::filesystem::path& path);

/// Replaces `path` by `text` in one step: a reader sees the old file or the new one, never a part, even
/// across a power failure. A symbolic link stays, and what it leads to is replaced. Throws InputError with the system's reason; then the old file is untouched.
void write_text_file(const std::filesystem::path& path, std::string_view text);

/// Makes the folder and those above it where they are not there. Throws InputError with the system's reason.
void make_folder(const std::filesystem::path& path);

}  // namespace strainwave
