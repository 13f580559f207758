// Who can change a file that decides what a machine does. Not real-time.
#pragma once

#include <sys/stat.h>

#include <filesystem>
#include <optional>
#include <string>

namespace strainwave {

/// Who besides root and our own user may write.
enum class Writers { kNobody, kGroup };

/// Whoever can write the file, or put another in its place, decides. What is wrong with `path` and the folder it is in, and the
/// remedy: owned by a third user (neither root nor ours), or writable by more than `allowed` (a folder with the sticky bit
/// excepted); or nothing. What does not exist is left to whoever opens it.
std::optional<std::string> find_exposure(const std::filesystem::path& path, Writers allowed);

/// The same as an InputError.
void require_protected(const std::filesystem::path& path, Writers allowed);

/// Of one file or folder whose status is known.
void require_protected(const std::filesystem::path& path, const struct stat& status, Writers allowed);

}  // namespace strainwave
