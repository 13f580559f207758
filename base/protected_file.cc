#include "base/protected_file.h"

#include <unistd.h>

#include <string>

#include "base/input_error.h"

namespace strainwave {

namespace {

std::optional<std::string> find_exposure(const std::filesystem::path& path, const struct stat& status,
                                         Writers allowed) {
  if (status.st_uid != 0 && status.st_uid != ::geteuid())
    return path.string() + ": is owned by user " + std::to_string(status.st_uid) +
           ": root or the user that runs strainwaved must own it";
  if (S_ISDIR(status.st_mode) && (status.st_mode & S_ISVTX) != 0) return std::nullopt;
  if ((status.st_mode & S_IWOTH) != 0)
    return path.string() + ": everyone may write it: chmod o-w " + path.string();
  if (allowed == Writers::kNobody && (status.st_mode & S_IWGRP) != 0)
    return path.string() + ": its group may write it: chmod g-w " + path.string();
  return std::nullopt;
}

}  // namespace

std::optional<std::string> find_exposure(const std::filesystem::path& path, Writers allowed) {
  struct stat status {};
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  if (::stat(folder.c_str(), &status) == 0)
    if (auto exposure = find_exposure(folder, status, allowed)) return exposure;
  return ::stat(path.c_str(), &status) == 0 ? find_exposure(path, status, allowed) : std::nullopt;
}

void require_protected(const std::filesystem::path& path, Writers allowed) {
  if (const auto exposure = find_exposure(path, allowed)) throw InputError(*exposure);
}

void require_protected(const std::filesystem::path& path, const struct stat& status, Writers allowed) {
  if (const auto exposure = find_exposure(path, status, allowed)) throw InputError(*exposure);
}

}  // namespace strainwave
