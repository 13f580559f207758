// SPDX-License-Identifier: BSD-3-Clause
#include "client/watch/help.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "client/text/text.h"

namespace strainwave {

namespace {

constexpr std::size_t kHelpIndent = 13;  // column of the explanation of a key

constexpr std::array<std::string_view, 21> kHelp{
    "up, down     select a joint",
    "s            stop the selected joint: needs no key and no session",
    "S            stop every joint of this watch, including those out of sight",
    "e            enable: the joint holds where it is",
    "h            hold: stop within the limits and stay enabled",
    "c            clear a fault; the joint stays off",
    "] [          jog: move the target by one step, up or down",
    "+ -          a larger or smaller step",
    "?            this help, and back",
    "q, Ctrl-C    end; joints go on as they are",
    "",
    "error_rad    setpoint - position, at the instant when the position was measured",
    "torque_Nm    as the drive reports it",
    "temp_C       what schedules the gains; 'from' says where it comes from",
    "notes        faults, and limits in force; docs/faults.md explains each",
    "rules        weight of each temperature rule, cold to warm",
    "rejects      orders that the daemon refused, from all clients, by reason",
    "",
    "white on red: fault, silence, or two daemons on the same channels",
    "black on amber: a limit is in force, or a command was refused",
    "commands are signed with --key FILE; without it, a daemon may refuse them",
};

/// `kHelp` in lines of `columns`. The explanation of a key wraps under itself.
std::vector<std::string> help_lines(std::size_t columns) {
  std::vector<std::string> lines;
  for (const std::string_view entry : kHelp) {
    const bool key = entry.size() > kHelpIndent && entry[kHelpIndent - 1] == ' ' && entry[kHelpIndent] != ' ';
    const std::size_t indent = key ? kHelpIndent : 0;
    std::string label(entry.substr(0, indent));
    for (const std::string& line : wrapped(entry.substr(indent), columns - indent, kHelp.size())) {
      lines.push_back(label + line);
      label.assign(indent, ' ');
    }
  }
  return lines;
}

}  // namespace

void draw_help(Screen& screen, int first, int end) {
  std::vector<std::string> lines = help_lines(static_cast<std::size_t>(screen.columns() - 1));
  const auto rows = static_cast<std::size_t>(std::max(0, end - first));
  if (lines.size() > rows) std::erase(lines, "");
  if (lines.size() > rows && rows > 0) {
    lines.resize(rows);
    lines.back() = "... a larger terminal shows more";
  }
  for (const std::string& line : lines) screen.put(first++, 1, line);
}

}  // namespace strainwave
