// SPDX-License-Identifier: BSD-3-Clause
#include "client/protocol/key_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

#include "base/input_error.h"
#include "base/unique_fd.h"

namespace strainwave {

namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what) {
  throw InputError(path.string() + ": " + what + ": " + std::generic_category().message(errno));
}

// O_EXCL keeps an existing file or link.
void write_new_file(const std::filesystem::path& path, const std::string& line, mode_t mode) {
  const UniqueFd file(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode));
  if (file.get() < 0 && errno == EEXIST)
    throw InputError(path.string() + ": exists already and is not overwritten: give another name to --out");
  if (file.get() < 0) fail(path, "cannot be made");
  const std::string text = line + "\n";
  if (::write(file.get(), text.data(), text.size()) != static_cast<ssize_t>(text.size()) ||
      ::fsync(file.get()) != 0) {
    ::unlink(path.c_str());
    fail(path, "cannot be written");
  }
}

std::filesystem::path public_path(const std::filesystem::path& path) {
  return path.string() + ".pub";
}

SecretKeyText parse(std::string_view line, const std::filesystem::path& path) {
  try {
    return parse_secret_line(line);
  } catch (const InputError& error) {
    throw InputError(path.string() + ": " + error.what());
  }
}

}  // namespace

SecretKeyText read_secret_key(const std::filesystem::path& path) {
  const UniqueFd file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (file.get() < 0) fail(path, "the key cannot be read");
  struct stat status {};
  if (::fstat(file.get(), &status) != 0) fail(path, "the key cannot be read");
  if (!S_ISREG(status.st_mode))
    throw InputError(path.string() + ": is not a file: give the file that strainwavectl keygen wrote");
  std::array<char, 512> text{};
  const ssize_t size = ::read(file.get(), text.data(), text.size());
  if (size < 0) fail(path, "the key cannot be read");
  const std::string_view content(text.data(), static_cast<std::size_t>(size));
  // Checks the content first, because a public key may be readable by all.
  SecretKeyText key = parse(content.substr(0, content.find('\n')), path);
  if ((status.st_mode & (S_IRWXG | S_IRWXO)) != 0)
    throw InputError(path.string() + ": other users can reach this secret key: chmod 600 " + path.string() +
                     ", and make a new key if they may have read it");
  return key;
}

AuthorizedKey write_new_key(const std::filesystem::path& path, Role role, const std::string& comment) {
  if (!is_valid_comment(comment))
    throw InputError(
        "--comment: at most 100 bytes without control characters or spaces at the ends are allowed");
  const SecretKeyText secret{SecretKey::generate(), role, comment};
  AuthorizedKey key{secret.key.public_key(), role, comment};
  write_new_file(public_path(path), to_line(key), 0644);
  try {
    write_new_file(path, to_line(secret), 0600);
  } catch (const InputError&) {
    ::unlink(public_path(path).c_str());
    throw;
  }
  return key;
}

}  // namespace strainwave
