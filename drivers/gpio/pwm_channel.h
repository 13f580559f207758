// SPDX-License-Identifier: BSD-3-Clause
// One channel of a PWM chip (sysfs). set_duty() makes one system call into the kernel's PWM driver. It
// allocates nothing, but the driver may take a lock. The constructor exports and configures the channel and
// may wait. Source: the kernel's Documentation/driver-api/pwm.rst, ABI/testing/sysfs-class-pwm.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "drivers/gpio/sysfs_file.h"

namespace strainwave {

struct PwmConfig {
  std::filesystem::path chip_folder;  ///< ".../pwmchip0"
  int channel = 0;
  double frequency_Hz = 20000.0;
  bool inversed = false;  ///< polarity
};

class PwmChannel {
 public:
  /// Starts with `idle_duty` (0 to 1). Throws InputError for a missing channel or a period that the channel refuses.
  PwmChannel(const PwmConfig& config, double idle_duty, const std::string& where);
  /// Sets the idle duty. The channel stays on because the level of a disabled PWM output is not defined.
  ~PwmChannel();
  PwmChannel(const PwmChannel&) = delete;
  PwmChannel& operator=(const PwmChannel&) = delete;

  /// Clamps `duty` to 0..1. Returns false when the kernel refuses; the duty is then unknown.
  bool set_duty(double duty) noexcept;
  bool set_idle() noexcept { return set_duty(idle_duty_); }
  /// Smallest step of the duty; the kernel counts in nanoseconds.
  double resolution() const noexcept { return 1.0 / static_cast<double>(period_ns_); }

 private:
  void export_channel(const PwmConfig& config, const std::string& where);
  void configure(const PwmConfig& config, const std::string& where);

  std::filesystem::path folder_;
  std::int64_t period_ns_;
  double idle_duty_;
  std::int64_t duty_ns_ = -1;  ///< last written; -1: unknown
  std::unique_ptr<SysfsFile> duty_;
};

}  // namespace strainwave
