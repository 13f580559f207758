// SPDX-License-Identifier: BSD-3-Clause
// Position from a hardware counter: a Count of the kernel's Counter subsystem, such as a quadrature decoder of the SoC.
// The sysfs file stays open. read() is as real-time safe as SysfsFile. The constructor configures the counter.
//
// The count wraps at its ceiling, and the shorter way round is taken as the motion of a period. A joint must
// therefore move less than half the ceiling in a period. Source: the kernel's
// Documentation/driver-api/generic-counter.rst, ABI sysfs-bus-counter.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "drivers/gpio/count_source.h"
#include "drivers/gpio/sysfs_file.h"

namespace strainwave {

struct CounterConfig {
  std::filesystem::path count_folder;      ///< ".../counter0/count0"
  std::optional<std::uint64_t> ceiling;    ///< set at the start; if empty: the counter's value, or 2^32 - 1
  std::string function = "quadrature x4";  ///< written if the counter has this attribute
};

/// Accumulates the steps of a count that wraps between 0 and `ceiling`.
class CountUnwrapper {
 public:
  explicit CountUnwrapper(std::uint64_t ceiling) noexcept : ceiling_(ceiling) {}
  /// Returns the accumulated count, or nothing when `count` is above the ceiling.
  std::optional<std::int64_t> step(std::uint64_t count) noexcept;

 private:
  std::uint64_t ceiling_;
  std::uint64_t last_ = 0;
  std::int64_t total_ = 0;
  bool begun_ = false;
};

class CounterCounts final : public CountSource {
 public:
  /// Throws InputError for a missing counter or a value that the counter refuses.
  CounterCounts(const CounterConfig& config, const std::string& where);

  Sample read(std::int64_t now_ns) noexcept override;
  void clear_fault() noexcept override { implausible_ = false; }

 private:
  SysfsFile count_;
  CountUnwrapper unwrapper_;
  std::int64_t counts_ = 0;
  bool implausible_ = false;
};

}  // namespace strainwave
