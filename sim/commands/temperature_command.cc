// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <chrono>
#include <iostream>
#include <memory>

#include "base/parallel.h"
#include "base/text_file.h"
#include "sim/commands/commands.h"
#include "sim/studies/html_page.h"
#include "sim/studies/temperature_report.h"

namespace strainwave {

namespace {

struct TemperatureOptions {
  std::string tables;
  std::string out = "temperature";
};

void run(const TemperatureOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  const FlexibleTables gains = read_flexible_tables(tables_folder(options.tables));
  const std::vector<FrictionWay> ways = friction_ways(gains);
  const std::filesystem::path out = options.out;
  make_folder(out);
  const std::vector<TemperatureRow> rows = run_temperatures(ways, sensor_faults());
  std::vector<HundredMoves> hundred(ways.size());
  run_in_parallel(ways.size(), [&](std::size_t i) {
    hundred[i] = {ways[i].name, run_hundred_moves(ways[i], kHundredMoves_rad, kColdest_C)};
  });
  write_text_file(out / "temperature.csv", temperature_rows(rows).csv());
  write_text_file(out / "hundred-moves.csv", hundred_moves_rows(hundred).csv());
  std::vector<TextTable> tables = temperature_tables(rows, hundred);
  tables.push_back(
      learned_table(run_temperatures({ways.front(), ways.back()}, sensor_faults(), kLearnedAfter)));
  tables.push_back(friction_known_table(run_friction_known(ways, study_table(gains))));
  tables.push_back(friction_table(study_table(gains), temperature_plant()));
  const std::vector<Figure> figures = temperature_figures(rows, hundred);
  draw_figures(figures, out);
  write_text_file(
      out / "temperature.html",
      html_page("<h1>Why temperature</h1>\n<p>Gear csf-17-50, motor side 0.089 kg.m2, link 0.1 kg.m2, "
                "encoder of 320000 counts on the motor's side, one period of delay. Errors are the "
                "link's, from the path that all follow.</p>\n",
                tables, figures, out));
  for (const TextTable& table : tables) std::cout << table.markdown();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  std::cout << "computed in " << number(seconds, 3) << " s; written to " << out.string() << "\n";
}

}  // namespace

void add_temperature_command(CLI::App& program, CommandBody& chosen) {
  const auto options = std::make_shared<TemperatureOptions>();
  CLI::App* command = program.add_subcommand(
      "temperature", "What it is worth to know the temperature: ways to compensate friction, cold and warm");
  add_tables_option(*command, options->tables);
  command->add_option("--out", options->out, "folder to write to")->capture_default_str();
  command->callback([&chosen, options] {
    chosen = [options] {
      run(*options);
      return ExitStatus::kDone;
    };
  });
}

}  // namespace strainwave
