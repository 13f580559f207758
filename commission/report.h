// SPDX-License-Identifier: BSD-3-Clause
// What a commissioning found, as a page of HTML for people: self-contained, without scripts, every text escaped. Pure; not real-time.
#pragma once

#include <string>
#include <vector>

#include "commission/commission_record.h"

namespace strainwave {

/// What the design made of the record.
struct ReportedDesign {
  std::vector<FrictionAtSpeed>
      friction;             ///< of the table, at the record's temperature; the intervals are not used
  std::string certificate;  ///< what verify printed
  std::string next;         ///< commands of the first motion
};

/// The velocity of the motor in rad/s for a torque of 1 N.m that swings at `frequency_Hz`, and its phase, from -pi / 2 to pi / 2 less that of
/// the delay:
///   (Jl s^2 + D s + K) / (s (Jm Jl s^2 + (Jm + Jl) (D s + K)))  e^(-s delay),   s = 2 pi i f
ResponsePoint response_of(const ResponseModel& model, double frequency_Hz);

/// The page.
std::string to_html(const CommissionRecord& record, const ReportedDesign& design);

}  // namespace strainwave
