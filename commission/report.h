// SPDX-License-Identifier: BSD-3-Clause
// Report of a commissioning as a page of HTML: self-contained, without scripts, every text escaped. Pure; not real-time.
#pragma once

#include <string>
#include <vector>

#include "commission/commission_record.h"

namespace strainwave {

/// Results of the design from the record.
struct ReportedDesign {
  std::vector<FrictionAtSpeed>
      friction;             ///< of the table, at the record's temperature; the intervals are not used
  std::string certificate;  ///< output of verify
  std::string next;         ///< commands for the first motion
};

/// Motor velocity in rad/s for a sinusoidal torque of 1 N.m at `frequency_Hz`. The phase is from -pi / 2 to pi / 2, minus that of
/// the delay:
///   (Jl s^2 + D s + K) / (s (Jm Jl s^2 + (Jm + Jl) (D s + K)))  e^(-s delay),   s = 2 pi i f
ResponsePoint response_of(const ResponseModel& model, double frequency_Hz);

std::string to_html(const CommissionRecord& record, const ReportedDesign& design);

}  // namespace strainwave
