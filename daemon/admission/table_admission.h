// Whether a gain table may control a joint: its structure, its identity, its limits, its certificate. Pure; not real-time.
#pragma once

#include <cstdint>
#include <string>

#include "control/gain_table.h"
#include "lcmtypes/vocabulary.h"

namespace strainwave {

struct TableVerdict {
  Reason reason = Reason::kAccepted;
  std::string text;  ///< why, with the numbers; when accepted, the certificate's smallest margin
};

/// Judges `table` for a joint that is `expected` (its own inertia, ratio, period) and delivers at most
/// `torque_limit_Nm`, which holds where it is below the table's. The certificate is recomputed here for the joint's own plant, never taken on trust.
TableVerdict judge_table(const GainTable& table, const PlantIdentity& expected, double torque_limit_Nm);

/// A short name for the table's content, never 0: the same bits give the same number.
std::int64_t table_digest(const GainTable& table);

}  // namespace strainwave
