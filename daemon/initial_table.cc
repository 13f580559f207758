// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/initial_table.h"

#include "base/input_error.h"
#include "base/protected_file.h"
#include "control/table/gain_table_json.h"
#include "daemon/admission/table_admission.h"
#include "daemon/assembly.h"
#include "daemon/config/config_doubts.h"

namespace strainwave {

std::optional<InitialTable> read_initial_table(const JointConfig& joint) {
  if (joint.table.empty()) return std::nullopt;
  try {
    require_protected(joint.table, writers_allowed(joint));
    InitialTable initial;
    initial.table = read_gain_table(joint.table);
    const TableVerdict judged = judge_table(initial.table, expected_joint(joint));
    if (judged.reason != Reason::kAccepted)
      throw InputError(joint.table.string() + ": refused for joint " + joint.name + ": " + judged.text);
    initial.verdict = judged.text;
    initial.doubts = doubt_torque(joint.name, joint.loop.controller, initial.table);
    return initial;
  } catch (const InputError& error) {
    throw InputError(joint.table_place + ": " + error.what());
  }
}

}  // namespace strainwave
