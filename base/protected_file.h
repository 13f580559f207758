// Who can change a file that decides what a machine does. Not real-time.
#pragma once

#include <sys/stat.h>

#include <filesystem>
#include <optional>
#include <string>

namespace strainwave {

/// Who besides root and our own user may write.
enum class Writers { kNobody, kGroup };

/// Whoever can write the file, or put another in its place, decides. What is wrong with `path`, with a folder on the way to it from /
/// or with a link there, whose own way counts as well; and the remedy: owned by a third user (neither root nor ours), or writable
/// by more than `allowed` (a folder with the sticky bit excepted); or nothing. What does not exist is left to whoever opens it.
/// In a user namespace that does not know root, folders and links of nobody's are taken for root's if / is one of them.
std::optional<std::string> find_exposure(const std::filesystem::path& path, Writers allowed);

/// The same as an InputError.
void require_protected(const std::filesystem::path& path, Writers allowed);

/// Of one file whose status is known, wherever it is.
void require_protected(const std::filesystem::path& path, const struct stat& status, Writers allowed);

}  // namespace strainwave
