// Who can change a file that decides what a machine does. Not real-time.
#pragma once

#include <sys/stat.h>

#include <filesystem>

namespace strainwave {

/// Who besides root and our own user may write.
enum class Writers { kNobody, kGroup };

/// Whoever can write the file or folder, or put another in its place, decides. Throws InputError that names `path` and the remedy:
/// owned by a third user (neither root nor ours), or writable by more than `allowed` (a folder with the sticky bit excepted).
void require_protected(const std::filesystem::path& path, const struct stat& status, Writers allowed);

/// The same for `path` and the folder it is in. What does not exist is left to whoever opens it.
void require_protected(const std::filesystem::path& path, Writers allowed);

}  // namespace strainwave
