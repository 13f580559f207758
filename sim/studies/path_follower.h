// SPDX-License-Identifier: BSD-3-Clause
// The controllers of the temperature study (sim/studies/temperature_study.h). Each follows a path that was
// planned beforehand, as a program's stream or as a drive's profile. torque_Nm() is real-time safe.
#pragma once

#include <memory>
#include <optional>

#include "control/joint_controller.h"
#include "sim/studies/closed_loop.h"
#include "sim/studies/peers/servo_peer.h"
#include "sim/studies/smooth_path.h"

namespace strainwave {

/// The daemon's controller under a stream of the path. Samples for every tenth period, with velocity and
/// acceleration, arrive one interval before the controller needs them (JointPlan::lead_s()).
class StreamedController final : public LoopController {
 public:
  /// The known temperature: the sensor's reading plus `shift_C`, or a fixed value.
  struct Told {
    std::optional<double> fixed_C;
    double shift_C = 0.0;  ///< NaN: the sensor is missing
  };
  StreamedController(const JointControllerConfig& config, const GainTable& table, const SmoothPath& path,
                     const Told& told) noexcept;
  double torque_Nm(const LoopSample& sample) noexcept override;
  /// Runs one period and returns all of the controller's result.
  JointStep step(const LoopSample& sample) noexcept;
  void reset() noexcept override;
  bool switched_off() const noexcept override { return off_; }

 private:
  void send(double time_s) noexcept;

  JointControllerConfig config_;
  GainTable table_;
  SmoothPath path_;
  Told told_;
  JointController controller_;
  bool off_ = false;
  long periods_ = 0;
};

/// One of sim/studies/peers/, with the path as its motor's reference.
class PeerOnPath final : public LoopController {
 public:
  PeerOnPath(std::unique_ptr<ServoPeer> peer, const ServoJoint& joint, const SmoothPath& path)
      : peer_(std::move(peer)), joint_(joint), path_(path) {}
  double torque_Nm(const LoopSample& sample) noexcept override;
  void reset() noexcept override { started_ = false; }

 private:
  std::unique_ptr<ServoPeer> peer_;
  ServoJoint joint_;
  SmoothPath path_;
  bool started_ = false;
};

}  // namespace strainwave
