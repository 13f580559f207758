// SPDX-License-Identifier: BSD-3-Clause
// A fuzzer's bytes as a file in memory, for readers that take a path. Each input overwrites it.
#pragma once

#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "tests/fuzz/fuzz_input.h"

namespace strainwave::fuzz {

class FuzzFile {
 public:
  FuzzFile(const std::uint8_t* data, std::size_t size) : descriptor_(::memfd_create("input", MFD_CLOEXEC)) {
    STRAINWAVE_FUZZ_CHECK(descriptor_ >= 0);
    STRAINWAVE_FUZZ_CHECK(::write(descriptor_, data, size) == static_cast<ssize_t>(size));
    STRAINWAVE_FUZZ_CHECK(::fchmod(descriptor_, 0600) == 0);
  }
  FuzzFile(const FuzzFile&) = delete;
  FuzzFile& operator=(const FuzzFile&) = delete;
  ~FuzzFile() { ::close(descriptor_); }

  std::filesystem::path path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

}  // namespace strainwave::fuzz
