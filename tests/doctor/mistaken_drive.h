// SPDX-License-Identifier: BSD-3-Clause
// A drive that differs from its configuration: it falsifies the commands and readings of a simulated drive. For tests of the doctor.
#pragma once

#include <cmath>
#include <memory>
#include <random>
#include <utility>

#include "drivers/actuator.h"

namespace strainwave::testing {

/// The differences. The defaults are none.
struct Mistakes {
  double torque_scale = 1.0;    ///< ratio of the acting torque to the commanded
  double position_scale = 1.0;  ///< ratio of the reported position to the true
  double temperature_offset_C = 0.0;
  bool temperature_open = false;    ///< the sensor shows -200 degC
  double slip_above_Nm = 1e9;       ///< commanded torque above which the link slips
  double slip_rad_s = 0.0;          ///< speed of the slip, against the torque
  double lose_above_rad_s = 1e9;    ///< speed above which counts are lost
  double lost_share = 0.0;          ///< share of the motion that is lost there
  bool drive_finds_losses = false;  ///< the drive reports a loss as a fault
  double missed_share = 0.0;        ///< share of the readings that are missing
  double late_share = 0.0;          ///< share of the readings that are a period late
};

class MistakenDrive final : public Actuator {
 public:
  MistakenDrive(std::unique_ptr<Actuator> drive, const Mistakes& mistakes, double period_s, unsigned seed)
      : drive_(std::move(drive)), mistakes_(mistakes), period_s_(period_s), random_(seed) {}

  ActuatorReading read(std::int64_t now_ns) noexcept override {
    ActuatorReading reading = drive_->read(now_ns);
    reading.torque_applied_Nm /= mistakes_.torque_scale;
    reading.joint_position_rad *= mistakes_.position_scale;
    lose_counts(reading);
    slip(reading);
    reading.temperature_C += mistakes_.temperature_offset_C;
    if (mistakes_.temperature_open) reading.temperature_C = -200.0;
    arrive(reading);
    return reading;
  }
  void write(const ActuatorCommand& command) noexcept override {
    torque_Nm_ = command.enable ? command.torque_Nm : 0.0;
    ActuatorCommand scaled = command;
    scaled.torque_Nm *= mistakes_.torque_scale;
    drive_->write(scaled);
  }
  void stop() noexcept override { drive_->stop(); }
  void clear_fault() noexcept override { drive_->clear_fault(); }

 private:
  void lose_counts(ActuatorReading& reading) noexcept {
    const double step_rad = begun_ ? reading.joint_position_rad - true_rad_ : 0.0;
    true_rad_ = reading.joint_position_rad;
    begun_ = true;
    if (std::abs(step_rad) > mistakes_.lose_above_rad_s * period_s_) {
      lost_rad_ += mistakes_.lost_share * step_rad;
      if (mistakes_.drive_finds_losses) {
        reading.fault = ActuatorFault::kImplausible;
        reading.drive_state = DriveState::kFault;
      }
    }
    reading.joint_position_rad -= lost_rad_;
  }
  void slip(ActuatorReading& reading) noexcept {
    if (std::abs(torque_Nm_) > mistakes_.slip_above_Nm)
      slipped_rad_ -= std::copysign(mistakes_.slip_rad_s * period_s_, torque_Nm_);
    reading.link_position_rad += slipped_rad_;
  }
  void arrive(ActuatorReading& reading) noexcept {
    const ActuatorReading now = reading;
    if (chance(mistakes_.late_share)) {
      reading.joint_position_rad =
          before_.has_position ? before_.joint_position_rad : reading.joint_position_rad;
      reading.position_late_periods = 1;
      reading.position_delay_ns = static_cast<std::int64_t>(1.4e9 * period_s_);
    }
    if (chance(mistakes_.missed_share)) {
      reading.has_position = false;
      reading.joint_position_rad = before_.joint_position_rad;
    }
    before_ = now;
  }
  bool chance(double share) noexcept {
    return share > 0.0 && std::uniform_real_distribution<double>(0.0, 1.0)(random_) < share;
  }

  std::unique_ptr<Actuator> drive_;
  Mistakes mistakes_;
  double period_s_;
  std::mt19937_64 random_;
  ActuatorReading before_;
  bool begun_ = false;
  double torque_Nm_ = 0.0;
  double true_rad_ = 0.0, lost_rad_ = 0.0, slipped_rad_ = 0.0;
};

}  // namespace strainwave::testing
