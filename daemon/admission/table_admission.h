// SPDX-License-Identifier: BSD-3-Clause
// Judges whether a gain table may control a joint: its structure, identity, limits and certificate. Pure; not real-time.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "control/joint/encoder_side.h"
#include "control/joint/link_model.h"
#include "control/table/gain_table.h"
#include "strainwave/vocabulary.h"

namespace strainwave {

struct TableVerdict {
  Reason reason = Reason::kAccepted;
  std::string text;  ///< why, with the numbers; when accepted, the certificate's smallest margin
};

/// The joint that tables are judged for.
struct ExpectedJoint {
  PlantIdentity plant;            ///< its own inertia, ratio, period
  double torque_limit_Nm = 0.0;   ///< the joint's; applies where it is below the table's
  std::optional<LinkModel> link;  ///< of a flexible joint; none: rigid
  int delay_periods = 0;          ///< between a torque's computation and its effect, >= 0
  EncoderSide encoder_side = EncoderSide::kMotor;
  bool law_acts = true;  ///< false: the drive closes its own loop; only friction and inertia are used
};

/// Judges `table` for the joint `expected`. The certificate is recomputed here, never trusted. The joint and its delay must lie in the
/// table's box; its damping must, too, if the model has one. The table is also refused if the link would oscillate at this damping, or at
/// the least structural damping if it is unknown. If the law does not act, nothing is certified.
TableVerdict judge_table(const GainTable& table, const ExpectedJoint& expected);

/// The same in two parts: everything except the box's proof (milliseconds), and the proof itself (up to seconds).
TableVerdict judge_table_but_box(const GainTable& table, const ExpectedJoint& expected);
TableVerdict judge_box(const GainTable& table);

/// Digest of the table's content, never 0: the same bits give the same number.
std::int64_t table_digest(const GainTable& table);

/// Digest of the temperature rules, never 0. Learned friction is valid only for the rules with which it was learned.
std::int64_t friction_rules_digest(const FuzzyFriction& friction);

}  // namespace strainwave
