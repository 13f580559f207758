// SPDX-License-Identifier: BSD-3-Clause
// Writes an LCM event log with COUNT states of a joint at 200 Hz and some messages of each other kind.
//
//   mcap_sample LOG COUNT
#include <cmath>
#include <cstdlib>
#include <limits>
#include <strainwave/ack_v1.hpp>
#include <strainwave/state_v1.hpp>
#include <strainwave/timing_v1.hpp>

#include "strainwave/vocabulary.h"
#include "tests/support/event_log_file.h"

int main(int argc, char** argv) {
  using namespace strainwave;
  if (argc != 3) return 2;
  constexpr std::int64_t kStart_us = 1'700'000'000'000'000;
  constexpr std::int64_t kLate_us = 1000;
  constexpr std::int64_t kPeriod_us = 5000;
  testing::EventLogFile log(argv[1]);
  const long count = std::atol(argv[2]);
  for (long k = 0; k < count; ++k) {
    state_v1 state{};
    state.utime = kStart_us + k * kPeriod_us;
    state.session_id = std::numeric_limits<std::int64_t>::max();
    state.cycle = 5 * k;
    state.joint_position_rad = std::sin(0.01 * static_cast<double>(k));
    state.temperature_used_C = std::numeric_limits<double>::quiet_NaN();
    state.rule_count = 5;
    state.mode = static_cast<std::int32_t>(Mode::kTracking);
    log.add(state.utime + kLate_us, "SW.elbow.STATE", state);
    if (k % 200 != 0) continue;
    timing_v1 timing{};
    timing.utime = state.utime;
    log.add(timing.utime + kLate_us, "SW.TIMING", timing);
    ack_v1 answer{};
    answer.utime = state.utime;
    const char* words = "a \"quoted\" word, a \\ and \xC3\xA9";
    for (std::size_t i = 0; words[i] != '\0'; ++i) answer.text[i] = static_cast<std::uint8_t>(words[i]);
    log.add(answer.utime + kLate_us, "SW.elbow.ACK", answer);
  }
  return 0;
}
