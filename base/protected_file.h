// SPDX-License-Identifier: BSD-3-Clause
// Who can change a file that decides what a machine does. Not real-time.
#pragma once

#include <sys/stat.h>

#include <filesystem>
#include <optional>
#include <string>

namespace strainwave {

/// Who besides root and our own user may write.
enum class Writers { kNobody, kGroup };

/// A user who can write the file, or put another in its place, decides what the machine does. Returns what is wrong, with the remedy, or
/// nothing. Checked are `path`, each folder from / to it, and links there with their own folders. Wrong are: an owner other than root and
/// our user, and write access for more than `allowed` (except a folder with the sticky bit). A missing file is no finding.
/// In a user namespace without root, the overflow user's folders and links count as root's if / is one of them.
std::optional<std::string> find_exposure(const std::filesystem::path& path, Writers allowed);

/// The same as an InputError.
void require_protected(const std::filesystem::path& path, Writers allowed);

/// Of one file whose status is known, wherever it is.
void require_protected(const std::filesystem::path& path, const struct stat& status, Writers allowed);

}  // namespace strainwave
