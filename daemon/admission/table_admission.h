// SPDX-License-Identifier: BSD-3-Clause
// Whether a gain table may control a joint: its structure, its identity, its limits, its certificate. Pure; not real-time.
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
  double torque_limit_Nm = 0.0;   ///< that it delivers; holds where it is below the table's
  std::optional<LinkModel> link;  ///< its spring, where its model has one
  int delay_periods = 0;          ///< between a torque's computation and its effect, >= 0
  EncoderSide encoder_side = EncoderSide::kMotor;
  bool law_acts =
      true;  ///< false: the drive closes its own loop, and of a table only friction and inertia are used
};

/// Judges `table` for a joint that is `expected`. The certificate is recomputed here, never taken on trust. The joint must be in the box with
/// its delay, and by its damping only where its model has one. It is refused, too, where its link swings up with that damping, or with the least
/// of any joint's.
/// Where the law does not act nothing is certified.
TableVerdict judge_table(const GainTable& table, const ExpectedJoint& expected);

/// The same in two parts: all but the box's proof, which takes milliseconds, and that proof, which may take seconds.
TableVerdict judge_table_but_box(const GainTable& table, const ExpectedJoint& expected);
TableVerdict judge_box(const GainTable& table);

/// A short name for the table's content, never 0: the same bits give the same number.
std::int64_t table_digest(const GainTable& table);

/// Of its temperature rules: what a joint learned of its friction belongs to them. Never 0.
std::int64_t friction_rules_digest(const FuzzyFriction& friction);

}  // namespace strainwave
