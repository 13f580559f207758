// SPDX-License-Identifier: BSD-3-Clause
// timing: shows the timing of the daemon's loop, as the daemon reports it.
#include <fmt/format.h>

#include <map>
#include <string>

#include "base/printable.h"
#include "client/commands/commands.h"
#include "client/protocol/latest_messages.h"
#include "strainwave/client_error.h"

namespace strainwave {

namespace {

std::string describe(const timing_v1& timing) {
  std::string text = fmt::format(
      "real time                {}\n"
      "period                   {} s, {}\n"
      "cycles                   {}\n"
      "overruns                 {}\n"
      "wake-up latency, worst   {:.1f} us\n"
      "execution time, worst    {:.1f} us\n"
      "position delay, worst    {}\n"
      "page faults in the loop  {}\n"
      "state records dropped    {}\n",
      timing.real_time == 1 ? "yes (SCHED_FIFO, locked memory)" : "no (refused by the system)",
      timing.period_s, counted(timing.joint_count, "joint"), timing.cycles, timing.overruns,
      static_cast<double>(timing.wakeup_latency_max_ns) * 1e-3,
      static_cast<double>(timing.execution_time_max_ns) * 1e-3,
      timing.position_delay_max_ns > 0
          ? fmt::format("{:.1f} us", static_cast<double>(timing.position_delay_max_ns) * 1e-3)
          : "not measured by any drive",
      timing.page_faults, timing.state_records_dropped);
  for (int reason = 1; reason < kReasonCount; ++reason) {
    if (timing.rejects[reason] == 0) continue;
    text += fmt::format("refused messages         {} ({})\n", timing.rejects[reason],
                        to_text(static_cast<Reason>(reason)));
  }
  return text;
}

std::vector<ResultField> fields_of(const timing_v1& timing) {
  std::map<std::string, std::int64_t> refused;
  for (int reason = 1; reason < kReasonCount; ++reason)
    if (timing.rejects[reason] > 0)
      refused.emplace(to_text(static_cast<Reason>(reason)), timing.rejects[reason]);
  return {{"real_time", timing.real_time == 1},
          {"period_s", timing.period_s},
          {"joint_count", std::int64_t{timing.joint_count}},
          {"cycles", std::int64_t{timing.cycles}},
          {"overruns", std::int64_t{timing.overruns}},
          {"wakeup_latency_max_ns", std::int64_t{timing.wakeup_latency_max_ns}},
          {"execution_time_max_ns", std::int64_t{timing.execution_time_max_ns}},
          {"position_delay_max_ns", std::int64_t{timing.position_delay_max_ns}},
          {"page_faults", std::int64_t{timing.page_faults}},
          {"state_records_dropped", std::int64_t{timing.state_records_dropped}},
          {"rejects", refused}};
}

}  // namespace

void show_timing(Client& client, const Output& output) {
  const std::string& prefix = client.options().prefix;
  LatestMessages<Latest<timing_v1>> timings(client.connection());
  timings.keep({prefix, ""});
  if (!client.wait_until([&] { return timings.find(prefix) != nullptr; },
                         Deadline(client.options().timeout_s))) {
    throw ClientError(
        ExitStatus::kNoAnswer,
        fmt::format("no timing message on {} in {} s: it comes once a second while strainwaved runs",
                    timing_channel(prefix), client.options().timeout_s));
  }
  const timing_v1& timing = timings.find(prefix)->message;
  std::string text = describe(timing);
  text.pop_back();  // removes the last newline, because say() adds one
  say(output, text, fields_of(timing));
}

}  // namespace strainwave
