// Whether a gain table may control a joint: its structure, its identity, its limits, its certificate. Pure; not real-time.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "control/gain_table.h"
#include "control/link_model.h"
#include "lcmtypes/vocabulary.h"

namespace strainwave {

struct TableVerdict {
  Reason reason = Reason::kAccepted;
  std::string text;  ///< why, with the numbers; when accepted, the certificate's smallest margin
};

/// The joint that tables are judged for.
struct ExpectedJoint {
  PlantIdentity plant;            ///< its own inertia, ratio, period
  double torque_limit_Nm = 0.0;   ///< that it delivers; holds where it is below the table's
  std::optional<LinkModel> link;  ///< its spring, where it is told of it
  int delay_periods = 0;          ///< between a torque's computation and its effect, 0..kMaxSpringDelay
};

/// Judges `table` for a joint that is `expected`. The certificate is recomputed here for the joint's own plant, never taken on trust. It is
/// of a rigid joint; on one with a spring gains under which the link swings up are refused, on any of the slopes.
TableVerdict judge_table(const GainTable& table, const ExpectedJoint& expected);

/// A short name for the table's content, never 0: the same bits give the same number.
std::int64_t table_digest(const GainTable& table);

}  // namespace strainwave
