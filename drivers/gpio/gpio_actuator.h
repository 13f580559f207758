// SPDX-License-Identifier: BSD-3-Clause
// A DC motor as an Actuator. An amplifier or H-bridge is driven by PWM and digital lines. The encoder uses a
// hardware counter or, for slow joints, edges; ThermometerActuator adds the temperature. read(), write(), stop() and
// clear_fault() are real-time safe in user space. They make a few system calls: one per group of lines, one
// for the PWM, one for the counter. These wait only for locks of the kernel's drivers.
//
// The wiring, not the software, must stop the joint when this process dies: docs/gpio.md.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "drivers/actuator.h"
#include "drivers/gpio/count_source.h"
#include "drivers/gpio/debounce.h"
#include "drivers/gpio/drive_sequence.h"
#include "drivers/gpio/gpio_lines.h"
#include "drivers/gpio/index_capture.h"
#include "drivers/gpio/pwm_channel.h"
#include "drivers/gpio/torque_output.h"

namespace strainwave {

struct GpioMotionConfig {
  double count_rad = 0.0;            ///< joint rotation per count, > 0
  bool encoder_reversed = false;     ///< rising counts mean falling position
  double velocity_filter_s = 0.005;  ///< time constant of the velocity for back-EMF compensation, >= 0
  double period_s = 0.001;
};

/// The hardware parts of a joint; `index` may be null.
struct GpioParts {
  std::unique_ptr<DigitalLines> lines;
  std::unique_ptr<PwmChannel> pwm;
  std::unique_ptr<CountSource> counts;
  std::unique_ptr<EdgeEvents> index;
};

class GpioActuator final : public Actuator {
 public:
  GpioActuator(GpioParts parts, const GpioMotionConfig& motion, const TorqueOutputConfig& torque,
               const DriveSequenceConfig& sequence, const Debounce& debounce = {});
  /// Stops. The parts then set their outputs to safe levels, with the brake shut.
  ~GpioActuator() override;

  ActuatorReading read(std::int64_t now_ns) noexcept override;
  void write(const ActuatorCommand& command) noexcept override;
  void stop() noexcept override;
  void clear_fault() noexcept override;

 private:
  void read_position(ActuatorReading& reading) noexcept;
  void read_inputs(ActuatorReading& reading) noexcept;
  ActuatorFault fault_of_inputs() const noexcept;
  void put_out(const TorqueOutput::Output& torque, const DriveSequence::Outputs& sequence) noexcept;

  GpioParts parts_;
  GpioMotionConfig motion_;
  TorqueOutput torque_;
  DriveSequence sequence_;
  Debounce debounce_;
  IndexCapture index_;
  TorqueOutput::Output last_output_;
  std::uint32_t active_ = 0;  ///< inputs of this period, bits by role
  std::int64_t now_ns_ = 0;
  double position_rad_ = 0.0;
  double velocity_rad_s_ = 0.0;
  bool has_position_ = false;  ///< position_rad_ is from the last period
  bool lines_failed_ = false;
  bool write_failed_ = false;  ///< until clear_fault()
  bool alive_ = false;
};

}  // namespace strainwave
