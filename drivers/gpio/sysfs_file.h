// SPDX-License-Identifier: BSD-3-Clause
// One attribute file of sysfs that is kept open: a number is read or written in one system call, without
// allocation. On this side read() and write() are real-time safe; the kernel's driver may take locks.
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
  /// Throws InputError naming `where` when the file cannot be opened.
  SysfsFile(const std::filesystem::path& path, Access access, const std::string& where);

  /// The number that the file holds, or nothing.
  std::optional<std::uint64_t> read() noexcept;
  bool write(std::uint64_t number) noexcept;

 private:
  UniqueFd fd_;
};

/// Whole small attributes; not real-time. Throws InputError naming `where`.
std::string read_attribute(const std::filesystem::path& path, const std::string& where);
void write_attribute(const std::filesystem::path& path, std::string_view text, const std::string& where);

}  // namespace strainwave
