// SPDX-License-Identifier: BSD-3-Clause
// The parts of strainwavectl's man page and completion that its command line does not contain.
#include "client/options/command_options.h"
#include "drivers/injected_fault.h"

namespace strainwave {

namespace {

// Lists the joints of all daemons heard. A name has no characters that are special to a shell.
constexpr const char* kJointsHeard =
    R"x($(strainwavectl status --json --timeout_s 0.3 2>/dev/null | grep -o '"joint": *"[A-Za-z0-9_-]*"' | cut -d '"' -f 4))x";

std::string injected_faults() {
  std::string words;
  for (std::int32_t number = 0; number < kInjectedFaultCount; ++number)
    words += (number == 0 ? "" : " ") + std::string(to_text(static_cast<InjectedFault>(number)));
  return words;
}

}  // namespace

Manual manual_of_strainwavectl() {
  return {
      .program = "strainwavectl",
      .section = 1,
      .files = {{"~/.strainwave-key", "a secret key (keygen), where STRAINWAVE_KEY or --key names it"},
                {"/usr/share/strainwave/tables/", "gain tables that are shipped, for load-table"},
                {"/usr/share/doc/strainwave/docs/", "the documentation, beginning with quick-start.md"}},
      .examples = {{"strainwavectl status", "every joint of the prefix"},
                   {"strainwavectl enable elbow", "switch the drive on and hold the position"},
                   {"strainwavectl move elbow 0.5 --wait", "go to 0.5 rad, and say how long it took"},
                   {"strainwavectl move elbow 0.5 wrist -0.2", "two joints leave and arrive together"},
                   {"strainwavectl path wave.csv --wait", "follow a path of one or several joints"},
                   {"strainwavectl disable --all", "stop every joint of the daemon and switch it off"},
                   {"strainwavectl commission elbow --config arm.toml --out elbow",
                    "measure a joint, and make its table, configuration and report"},
                   {"strainwavectl record elbow --out elbow.lcm --duration_s 10",
                    "what the joint does, for export and identification"}},
      .see_also = {"strainwaved(8)", "strainwave-telemetry(8)", "strainwave-design(1)", "strainwave-spy(1)"},
      .values = {{"JOINT", kJointsHeard}, {"FAULT", injected_faults()}}};
}

}  // namespace strainwave
