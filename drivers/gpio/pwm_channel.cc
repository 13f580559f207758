// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/gpio/pwm_channel.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "base/input_error.h"

namespace strainwave {

namespace {
/// udev sets the permissions of a new channel shortly after the kernel creates it.
constexpr int kExportTries = 100;
constexpr std::chrono::milliseconds kExportTry{10};
}  // namespace

PwmChannel::PwmChannel(const PwmConfig& config, double idle_duty, const std::string& where)
    : folder_(config.chip_folder / ("pwm" + std::to_string(config.channel))),
      period_ns_(std::llround(1e9 / config.frequency_Hz)),
      idle_duty_(idle_duty) {
  export_channel(config, where);
  configure(config, where);
}

PwmChannel::~PwmChannel() {
  (void)set_idle();
}

void PwmChannel::export_channel(const PwmConfig& config, const std::string& where) {
  if (!std::filesystem::exists(folder_)) {
    if (!std::filesystem::exists(config.chip_folder))
      throw InputError(where, "chip", config.chip_folder.string(),
                       "no such PWM chip: see /sys/class/pwm, and whether the pin is set to PWM");
    write_attribute(config.chip_folder / "export", std::to_string(config.channel), where);
  }
  for (int i = 0; i < kExportTries; ++i) {
    try {
      duty_ = std::make_unique<SysfsFile>(folder_ / "duty_cycle", SysfsFile::Access::kWrite, where);
      return;
    } catch (const InputError&) {
      if (i + 1 == kExportTries) throw;
      std::this_thread::sleep_for(kExportTry);
    }
  }
}

// The kernel changes the polarity only of a disabled channel and refuses a period below the duty. A channel
// that was never used has no period. Kernels such as 6.1 then refuse every other setting, even to disable it.
void PwmChannel::configure(const PwmConfig& config, const std::string& where) {
  if (read_attribute(folder_ / "enable", where) != "0") write_attribute(folder_ / "enable", "0", where);
  if (read_attribute(folder_ / "duty_cycle", where) != "0")
    write_attribute(folder_ / "duty_cycle", "0", where);
  write_attribute(folder_ / "period", std::to_string(period_ns_), where);
  if (std::filesystem::exists(folder_ / "polarity"))
    write_attribute(folder_ / "polarity", config.inversed ? "inversed" : "normal", where);
  if (!set_idle()) throw InputError(where + ": " + folder_.string() + ": the duty cannot be set");
  write_attribute(folder_ / "enable", "1", where);
}

bool PwmChannel::set_duty(double duty) noexcept {
  const std::int64_t wanted_ns = std::llround(std::clamp(duty, 0.0, 1.0) * static_cast<double>(period_ns_));
  if (wanted_ns == duty_ns_) return true;
  const bool good = duty_->write(static_cast<std::uint64_t>(wanted_ns));
  duty_ns_ = good ? wanted_ns : -1;
  return good;
}

}  // namespace strainwave
