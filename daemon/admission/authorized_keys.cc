// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/admission/authorized_keys.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <map>
#include <string>
#include <system_error>

#include "base/input_error.h"
#include "base/protected_file.h"
#include "base/unique_fd.h"

namespace strainwave {

namespace {

constexpr std::size_t kMaxFileBytes = std::size_t{256} * 1024;

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what) {
  throw InputError(path.string() + ": " + what + ": " + std::generic_category().message(errno));
}

std::string read_protected(const std::filesystem::path& path) {
  require_protected(path, Writers::kNobody);
  struct stat status {};
  const UniqueFd file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (!file || ::fstat(file.get(), &status) != 0) fail(path, "security.authorized_keys cannot be read");
  if (!S_ISREG(status.st_mode)) throw InputError(path.string() + ": security.authorized_keys is not a file");
  require_protected(path, status, Writers::kNobody);
  std::string text;
  std::array<char, 4096> part{};
  ssize_t size = 0;
  while ((size = ::read(file.get(), part.data(), part.size())) > 0 && text.size() <= kMaxFileBytes)
    text.append(part.data(), static_cast<std::size_t>(size));
  if (size < 0) fail(path, "security.authorized_keys cannot be read");
  if (text.size() > kMaxFileBytes)
    throw InputError(path.string() + ": is larger than 256 KiB, the most for a list of keys");
  return text;
}

}  // namespace

std::optional<std::size_t> AuthorizedKeys::find(const KeyId& id) const noexcept {
  const auto found =
      std::find_if(keys_.begin(), keys_.end(), [&](const AuthorizedKey& key) { return key.key.id() == id; });
  return found == keys_.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - keys_.begin()));
}

std::filesystem::path credential_or_file(const std::filesystem::path& path) {
  const char* folder =
      std::getenv("CREDENTIALS_DIRECTORY");  // NOLINT(concurrency-mt-unsafe): before any thread
  if (folder == nullptr || *folder == '\0') return path;
  std::error_code unreadable;
  const std::filesystem::path credential = std::filesystem::path(folder) / path.filename();
  return std::filesystem::exists(credential, unreadable) ? credential : path;
}

AuthorizedKeys read_authorized_keys(const std::filesystem::path& path) {
  const std::string text = read_protected(path);
  std::vector<AuthorizedKey> keys;
  std::map<KeyId, std::size_t> first_line;
  std::size_t number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = std::string_view(text).substr(begin, end - begin);
    begin = end + 1;
    const std::string where = path.string() + ":" + std::to_string(++number) + ": ";
    const std::size_t content = line.find_first_not_of(" \t");
    if (content == std::string_view::npos || line[content] == '#') continue;
    try {
      keys.push_back(parse_public_line(line));
    } catch (const InputError& error) {
      throw InputError(where + error.what());
    }
    const auto [first, is_new] = first_line.try_emplace(keys.back().key.id(), number);
    if (!is_new)
      throw InputError(where + "repeats the key of line " + std::to_string(first->second) +
                       ": a key has one role; delete one of the lines");
    if (keys.size() > AuthorizedKeys::kMaxKeys)
      throw InputError(where + "at most " + std::to_string(AuthorizedKeys::kMaxKeys) + " keys are allowed");
  }
  if (keys.empty())
    throw InputError(path.string() +
                     ": has no key, and no client could give orders: make a key with strainwavectl keygen "
                     "and put the line of its .pub file here");
  return AuthorizedKeys(std::move(keys));
}

}  // namespace strainwave
