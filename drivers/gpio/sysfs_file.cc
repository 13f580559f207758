// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/gpio/sysfs_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <system_error>

#include "base/input_error.h"

namespace strainwave {

namespace {

constexpr std::size_t kMaxBytes = 32;  // a 64-bit number has 20 digits

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& where, const char* what,
                       int error) {
  throw InputError(where + ": " + path.string() + " cannot be " + what + " (" +
                   std::generic_category().message(error) +
                   "): is the device there, and may this user use it?");
}

}  // namespace

SysfsFile::SysfsFile(const std::filesystem::path& path, Access access, const std::string& where)
    : fd_(::open(path.c_str(), (access == Access::kRead ? O_RDONLY : O_WRONLY) | O_CLOEXEC)) {
  if (!fd_) fail(path, where, "opened", errno);
}

std::optional<std::uint64_t> SysfsFile::read() noexcept {
  std::array<char, kMaxBytes> text;
  const ssize_t size = ::pread(fd_.get(), text.data(), text.size(), 0);
  if (size <= 0) return std::nullopt;
  std::uint64_t number = 0;
  const char* end = text.data() + size;
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc{} || !(rest == end || (*rest == '\n' && rest + 1 == end))) return std::nullopt;
  return number;
}

bool SysfsFile::write(std::uint64_t number) noexcept {
  std::array<char, kMaxBytes> text;
  char* const end = std::to_chars(text.data(), text.data() + text.size() - 1, number).ptr;
  *end = '\n';
  const auto size = static_cast<std::size_t>(end + 1 - text.data());
  return ::pwrite(fd_.get(), text.data(), size, 0) == static_cast<ssize_t>(size);
}

std::string read_attribute(const std::filesystem::path& path, const std::string& where) {
  const UniqueFd fd(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!fd) fail(path, where, "read", errno);
  std::array<char, 256> text;
  const ssize_t size = ::read(fd.get(), text.data(), text.size());
  if (size < 0) fail(path, where, "read", errno);
  std::string value(text.data(), static_cast<std::size_t>(size));
  while (!value.empty() && (value.back() == '\n' || value.back() == ' ')) value.pop_back();
  return value;
}

void write_attribute(const std::filesystem::path& path, std::string_view text, const std::string& where) {
  const UniqueFd fd(::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_TRUNC));
  if (!fd) fail(path, where, "written", errno);
  const ssize_t size = ::write(fd.get(), text.data(), text.size());
  if (size != static_cast<ssize_t>(text.size())) fail(path, where, "set", errno);
}

}  // namespace strainwave
