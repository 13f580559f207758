// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "sim/commands/commands.h"
#include "sim/studies/own_loop_study.h"
#include "sim/studies/text_table.h"

namespace strainwave {

void add_own_loop_command(CLI::App& program, CommandBody& chosen) {
  const auto tables = std::make_shared<std::string>();
  CLI::App* command = program.add_subcommand(
      "own-loop", "What plan, wind-up and offsets are worth to a drive that closes its own loop of position");
  add_tables_option(*command, *tables);
  command->callback([&chosen, tables] {
    chosen = [tables] {
      TextTable table;
      table.header = {"way", "rate_Hz", "temperature_C", "rms_error_rad", "over_torque_mode"};
      for (const OwnLoopRow& row : run_own_loops(read_flexible_tables(tables_folder(*tables))))
        table.rows.push_back({row.way, number(row.rate_Hz, 5), number(row.temperature_C, 4),
                              number(row.rms_rad, 3), number(row.over_torque_mode, 3)});
      std::cout << table.markdown();
      return ExitStatus::kDone;
    };
  });
}

}  // namespace strainwave
