// States as JSON for scripts: fields under their own names, codes also in words. Not real-time.
#pragma once

#include <string>
#include <vector>

#include "client/client.h"

namespace strainwave {

/// {"prefix": ..., "joints": [{"joint": ..., "age_s": ..., <fields>, "mode_text": ..., "fault_text": ...,
/// "notes": ...}]}. A value that is not finite becomes null. Joints that were not heard are left out.
std::string to_json(const Client& client, const std::vector<std::string>& joints);

}  // namespace strainwave
