// SPDX-License-Identifier: BSD-3-Clause
// A sysfs attribute that stays open: reads or writes a number in one system call, without allocation. read()
// and write() are real-time safe in user space; the kernel's driver may take locks.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "base/unique_fd.h"

namespace strainwave {

class SysfsFile {
 public:
  enum class Access { kRead, kWrite };
  /// Throws InputError with `where` when the file cannot be opened.
  SysfsFile(const std::filesystem::path& path, Access access, const std::string& where);

  /// Returns the number in the file, or nothing when the file holds no number.
  std::optional<std::uint64_t> read() noexcept;
  bool write(std::uint64_t number) noexcept;

 private:
  UniqueFd fd_;
};

/// Read or write a whole small attribute. Not real-time. Throw InputError with `where`.
std::string read_attribute(const std::filesystem::path& path, const std::string& where);
void write_attribute(const std::filesystem::path& path, std::string_view text, const std::string& where);

}  // namespace strainwave
