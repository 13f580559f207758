// SPDX-License-Identifier: BSD-3-Clause
// Checks which users can change a file that controls a machine. Not real-time.
#pragma once

#include <sys/stat.h>

#include <filesystem>
#include <optional>
#include <string>

namespace strainwave {

/// Additional writers that are allowed. Root and the user of the process always are.
enum class Writers { kNobody, kGroup };

/// Any user who can write or replace the file controls the machine. Returns the problem with its remedy, or nothing. Checks `path`, each
/// folder from / to it, and links there with their own folders. A problem is an owner other than root and the user of the process, or
/// write access for more than `allowed`, except in a folder with the sticky bit. A missing file is no problem.
/// In a user namespace without root, the overflow user's folders and links count as root's if / is one of them.
std::optional<std::string> find_exposure(const std::filesystem::path& path, Writers allowed);

/// Throws the problem as an InputError.
void require_protected(const std::filesystem::path& path, Writers allowed);

/// The same for one file with a known status, without its folders.
void require_protected(const std::filesystem::path& path, const struct stat& status, Writers allowed);

}  // namespace strainwave
