// SPDX-License-Identifier: BSD-3-Clause
#include "base/text_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <system_error>

#include "base/input_error.h"
#include "base/unique_fd.h"

namespace strainwave {

namespace {

constexpr std::uintmax_t kMaxFileBytes = 128u << 20;

// A full or failing disk is not bad input, so the error is NotAchieved.
[[noreturn]] void fail_to_write(const std::filesystem::path& path, int error) {
  throw NotAchieved(path.string() + ": cannot write: " + std::generic_category().message(error));
}

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what, int error) {
  throw InputError(path.string() + ": " + what + ": " + std::generic_category().message(error));
}

// Follows links to the file that `path` finally names, which need not exist. Throws InputError for a folder, pipe, device or endless link.
std::filesystem::path behind_links(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    throw InputError(path.string() + ": is a folder: name a file");
  if (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error))
    throw InputError(path.string() + ": is a pipe or a device: name a file");
  constexpr int kMostLinks = 40;  // the kernel's limit
  std::filesystem::path target = path;
  for (int links = 0; std::filesystem::is_symlink(target, error); ++links) {
    const std::filesystem::path next = std::filesystem::read_symlink(target, error);
    if (error || links >= kMostLinks)
      throw InputError(path.string() + ": is a symbolic link that cannot be followed: name a file");
    target = target.parent_path() / next;
  }
  return target;
}

// A temporary file beside the target (rename must not cross file systems), removed unless it was renamed.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::filesystem::path& target)
      : target_(target), name_(target.string() + ".XXXXXX"), descriptor_(::mkstemp(name_.data())) {
    if (!descriptor_) fail(target_, "cannot create a file beside it", errno);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    if (!renamed_) ::unlink(name_.c_str());
  }

  void write(std::string_view text) {
    while (!text.empty()) {
      const ssize_t written = ::write(descriptor_.get(), text.data(), text.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail_to_write(target_, errno);
      text.remove_prefix(static_cast<std::size_t>(written));
    }
  }
  void become_target() {
    // mkstemp makes a private file, but other users may read the result as far as the umask allows.
    const mode_t mask = ::umask(0);
    ::umask(mask);
    if (::fchmod(descriptor_.get(), 0666 & ~mask) != 0 || ::fsync(descriptor_.get()) != 0)
      fail_to_write(target_, errno);
    if (::rename(name_.c_str(), target_.c_str()) != 0) fail(target_, "cannot be replaced", errno);
    renamed_ = true;
    sync_folder();
  }

 private:
  // Makes the rename durable. Some file systems refuse to sync a folder; the data are safe either way.
  void sync_folder() const {
    const std::filesystem::path folder = target_.has_parent_path() ? target_.parent_path() : ".";
    const UniqueFd descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (descriptor) ::fsync(descriptor.get());
  }

  std::filesystem::path target_;
  std::string name_;
  UniqueFd descriptor_;
  bool renamed_ = false;
};

}  // namespace

std::string read_text_file(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    throw InputError(path.string() + ": is a folder, not a file");
  // Reading a pipe without a writer would wait for ever, and a device may never end.
  if (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error))
    throw InputError(path.string() + ": is a pipe or a device, not a file");
  std::ifstream file(path, std::ios::binary);
  if (!file) fail(path, "cannot be read", errno);
  if (std::filesystem::file_size(path, error) > kMaxFileBytes) {
    throw InputError(path.string() + ": is larger than 128 MiB, the most that this program reads");
  }
  std::ostringstream text;
  text << file.rdbuf();
  if (file.bad()) fail(path, "cannot be read", errno);
  return std::move(text).str();
}

void write_text_file(const std::filesystem::path& path, std::string_view text) {
  TemporaryFile file(behind_links(path));
  file.write(text);
  file.become_target();
}

void make_folder(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::exists(path, error) && !std::filesystem::is_directory(path, error))
    throw InputError(path.string() + ": is a file: name a folder; the program makes it if it is missing");
  std::filesystem::create_directories(path, error);
  if (error)
    throw InputError(path.string() + ": cannot be made: " + error.message() + ": name another folder");
}

}  // namespace strainwave
