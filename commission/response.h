// SPDX-License-Identifier: BSD-3-Clause
// The frequency response from torque to motor velocity that a trace shows while the motor slides. Joint side, SI. Not real-time.
//
//   H(f) = sum conj(T(f)) V(f) / sum |T(f)|^2    over stretches; T, V: spectra of a stretch with a Hann window
#pragma once

#include <vector>

#include "commission/commission_record.h"
#include "commission/joint_trace.h"

namespace strainwave {

/// At the frequencies of SineSum, below a quarter of the sample rate. Empty if the motor never slides for 0.8 s one way.
std::vector<ResponsePoint> measure_response(const JointTrace& trace, double gear_ratio);

}  // namespace strainwave
