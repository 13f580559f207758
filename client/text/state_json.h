// SPDX-License-Identifier: BSD-3-Clause
// States as JSON for scripts: fields under their own names, codes also in words. Not real-time.
#pragma once

#include <string>
#include <vector>

#include "client/protocol/client.h"

namespace strainwave {

/// {"joints": [{"prefix": ..., "joint": ..., "age_s": ..., <fields>, "mode_text": ..., "fault_text": ...,
/// "notes": ...}]}. A value that is not finite becomes null. Joints that were not heard are left out.
/// `indent`: blanks for each level, or -1 for one line.
std::string to_json(const StateView& states, const std::vector<JointName>& joints, int indent = 2);

}  // namespace strainwave
