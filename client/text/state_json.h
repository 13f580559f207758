// SPDX-License-Identifier: BSD-3-Clause
// States as JSON for scripts: each field has its own name, and codes are repeated as words. Not real-time.
#pragma once

#include <string>
#include <vector>

#include "client/protocol/client.h"

namespace strainwave {

/// {"joints": [{"prefix": ..., "joint": ..., "age_s": ..., <fields>, "mode_text": ..., "fault_text": ...,
/// "notes": ...}]}. A value that is not finite becomes null. Joints without a received state are left out.
/// `indent`: spaces for each level, or -1 for one line.
std::string to_json(const StateView& states, const std::vector<JointName>& joints, int indent = 2);

}  // namespace strainwave
