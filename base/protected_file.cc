// SPDX-License-Identifier: BSD-3-Clause
#include "base/protected_file.h"

#include <unistd.h>

#include <list>
#include <string>
#include <system_error>

#include "base/input_error.h"

namespace strainwave {

namespace {

namespace fs = std::filesystem;

/// The kernel's limit of links in one path.
constexpr int kMaxLinks = 40;

/// Owner of /: root, or the overflow user 65534 in a user namespace without root.
uid_t owner_of_root() {
  constexpr uid_t kUnknown = 65534;
  struct stat status {};
  return ::stat("/", &status) == 0 && status.st_uid == kUnknown ? kUnknown : 0;
}

std::optional<std::string> find_third_owner(const fs::path& path, const struct stat& status) {
  if (status.st_uid == 0 || status.st_uid == ::geteuid()) return std::nullopt;
  return path.string() + ": is owned by user " + std::to_string(status.st_uid) +
         ": root or the user that runs strainwaved must own it";
}

std::optional<std::string> exposure_of(const fs::path& path, const struct stat& status, Writers allowed) {
  if (auto owner = find_third_owner(path, status)) return owner;
  if (S_ISDIR(status.st_mode) && (status.st_mode & S_ISVTX) != 0) return std::nullopt;
  if ((status.st_mode & S_IWOTH) != 0)
    return path.string() + ": everyone may write it: chmod o-w " + path.string();
  if (allowed == Writers::kNobody && (status.st_mode & S_IWGRP) != 0)
    return path.string() + ": its group may write it: chmod g-w " + path.string();
  return std::nullopt;
}

/// Walks from / to a file through every folder and link that determines where the path leads.
class Way {
 public:
  explicit Way(const fs::path& path) { walk(fs::absolute(path)); }

  std::optional<std::string> find_exposure(Writers allowed) {
    for (int links = 0; !left_.empty();) {
      const fs::path next = left_.front() == ".." ? here_.parent_path() : here_ / left_.front();
      left_.pop_front();
      struct stat status {};
      if (::lstat(next.c_str(), &status) != 0) return std::nullopt;
      if (!S_ISREG(status.st_mode) && status.st_uid == root_) status.st_uid = 0;
      if (S_ISLNK(status.st_mode)) {
        if (auto owner = find_third_owner(next, status)) return owner;
        std::error_code gone;
        const fs::path target = fs::read_symlink(next, gone);
        if (gone || ++links > kMaxLinks) return std::nullopt;
        walk(target);
        continue;
      }
      if (auto exposure = exposure_of(next, status, allowed)) return exposure;
      here_ = next;
    }
    return std::nullopt;
  }

 private:
  /// Inserts the names of `path` before those that are left. An absolute path restarts at /.
  void walk(const fs::path& path) {
    std::list<fs::path> names;
    for (const fs::path& name : path)
      if (!name.empty() && name != ".") names.push_back(name);
    if (path.is_absolute()) here_.clear();
    left_.splice(left_.begin(), names);
  }

  uid_t root_ = owner_of_root();
  fs::path here_;
  std::list<fs::path> left_;
};

}  // namespace

std::optional<std::string> find_exposure(const std::filesystem::path& path, Writers allowed) {
  return Way(path).find_exposure(allowed);
}

void require_protected(const std::filesystem::path& path, Writers allowed) {
  if (const auto exposure = find_exposure(path, allowed)) throw InputError(*exposure);
}

void require_protected(const std::filesystem::path& path, const struct stat& status, Writers allowed) {
  if (const auto exposure = exposure_of(path, status, allowed)) throw InputError(*exposure);
}

}  // namespace strainwave
