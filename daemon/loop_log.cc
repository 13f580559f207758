// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/loop_log.h"

#include <spdlog/spdlog.h>

#include <cmath>
#include <string>
#include <string_view>

#include "lcmtypes/reading_doubt.h"

namespace strainwave {

namespace {

// The drive's own reason behind a fault, if there is one.
std::string drive_words(const JointConfig& joint, const LoopEvent& event) {
  if (event.drive_error == 0 || joint.drive_error_text == nullptr || has_own_finding(event.fault)) return "";
  return ": " + joint.drive_error_text(event.fault, event.drive_error);
}

}  // namespace

bool tells_of_fault(const LoopEvent& event) noexcept {
  return !event.yield && event.to == Mode::kFaulted;
}

void log_loop_event(const JointConfig& joint, const LoopEvent& event) {
  if (const auto& yield = event.yield)
    return spdlog::warn(
        "{}: yielded to a load of {:.4g} N.m at {:.4g} rad: {} allows {:g} (was {}, cycle {})", joint.name,
        std::abs(yield->load_Nm), yield->position_rad, configuration_key(Notice::kYielded), yield->limit_Nm,
        to_text(event.from), event.cycle);
  if (!tells_of_fault(event))
    return spdlog::info("{}: {} -> {}", joint.name, to_text(event.from), to_text(event.to));
  const std::string_view key = configuration_key(event.fault);
  spdlog::error("{}: fault {}: {}{}{}{} (was {}, cycle {})", joint.name, static_cast<int>(event.fault),
                fault_words(event.fault, event.drive_error), drive_words(joint, event),
                key.empty() ? "" : ", see ", key, to_text(event.from), event.cycle);
}

}  // namespace strainwave
