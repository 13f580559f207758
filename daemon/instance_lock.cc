// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/instance_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <system_error>

#include "base/input_error.h"

namespace strainwave {

namespace {

namespace fs = std::filesystem;

// NOLINTBEGIN(concurrency-mt-unsafe): before any thread
fs::path runtime_directory() {
  const auto variable = [](const char* name) -> std::string {
    const char* value = std::getenv(name);
    return value == nullptr ? "" : value;
  };
  // The first of systemd's directories.
  if (const std::string ours = variable("RUNTIME_DIRECTORY"); !ours.empty())
    return ours.substr(0, ours.find(':'));
  if (::geteuid() == 0) return "/run/strainwave";
  if (const std::string users = variable("XDG_RUNTIME_DIR"); !users.empty())
    return fs::path(users) / "strainwave";
  if (const std::string home = variable("HOME"); !home.empty()) return fs::path(home) / ".strainwave";
  throw InputError("no directory for locks: set RUNTIME_DIRECTORY to one that only this user can write");
}
// NOLINTEND(concurrency-mt-unsafe)

// CAN interfaces and LCM's network belong to this network namespace, so the locks do, too.
std::string file_name(const std::string& name) {
  struct stat network {};
  const bool known = ::stat("/proc/self/ns/net", &network) == 0;
  std::string file = name + "@" + std::to_string(known ? network.st_ino : 0) + ".lock";
  std::replace_if(
      file.begin(), file.end(), [](unsigned char c) { return c == '/' || std::isspace(c) != 0; }, '-');
  return file;
}

}  // namespace

fs::path lock_directory() {
  fs::path directory = runtime_directory();
  if (::mkdir(directory.c_str(), 0700) != 0 && errno != EEXIST)
    throw InputError(directory.string() + ": the directory for locks cannot be made: " +
                     std::generic_category().message(errno) + "; set RUNTIME_DIRECTORY to another");
  struct stat status {};
  if (::lstat(directory.c_str(), &status) != 0 || !S_ISDIR(status.st_mode))
    throw InputError(directory.string() + ": is not a directory for locks: set RUNTIME_DIRECTORY to another");
  const bool somebody_elses = ::geteuid() != 0 && status.st_uid != ::geteuid();
  if (somebody_elses || (status.st_mode & (S_IWGRP | S_IWOTH)) != 0)
    throw InputError(
        directory.string() +
        ": other users may write this directory for locks, and keep the daemon from starting: it must belong "
        "to the user that runs strainwaved, with mode 0755 or less");
  return directory;
}

InstanceLock::InstanceLock(const std::string& name, const std::string& remedy) {
  const fs::path path = lock_directory() / file_name(name);
  file_.reset(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600));
  if (!file_)
    throw InputError(path.string() + ": the lock cannot be made: " + std::generic_category().message(errno));
  // If root runs this, the file must belong to the directory's owner: else the service could not open it at its next start.
  struct stat folder {};
  if (::geteuid() == 0 && ::stat(path.parent_path().c_str(), &folder) == 0)
    (void)!::fchown(file_.get(), folder.st_uid, folder.st_gid);
  if (::flock(file_.get(), LOCK_EX | LOCK_NB) == 0) return;
  const int error = errno;
  if (error == EWOULDBLOCK) throw InputError("another strainwaved already runs with " + name + ": " + remedy);
  throw std::system_error(error, std::generic_category(), "taking the lock " + name);
}

}  // namespace strainwave
