// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>

#include "base/text_file.h"
#include "sim/commands/commands.h"
#include "sim/studies/flexible_figures.h"
#include "sim/studies/flexible_report.h"
#include "sim/studies/html_page.h"
#include "sim/studies/peers/planned_peer.h"
#include "sim/studies/wrongly_configured.h"

namespace strainwave {

namespace {

struct FlexibleOptions {
  std::string tables;
  std::string out = "flexible";
  bool full = false;
  bool peers = false;
  bool wrong = false;
  RandomJoints joints{1000};
};

std::vector<FlexibleRow> run_part(const std::string& name, const std::vector<FlexibleCell>& cells,
                                  const std::vector<Contender>& contenders) {
  const std::size_t tenth = cells.size() / 10 + 1;
  auto rows = run_flexible(cells, contenders, [&](std::size_t done) {
    if (done % tenth == 0 || done == cells.size())
      std::cerr << name << ": " << done << " of " << cells.size() << " cells\n";
  });
  return rows;
}

std::size_t number_of(const std::string& name, const std::vector<Contender>& contenders) {
  const auto found = std::find_if(contenders.begin(), contenders.end(),
                                  [&](const Contender& contender) { return contender.name == name; });
  return static_cast<std::size_t>(found - contenders.begin());
}

/// Compares the daemon's controller with a user's alternatives, on the grid alone.
void run_peers(const FlexibleTables& gains, const std::filesystem::path& out) {
  std::vector<Contender> contenders = {daemon_contender(gains)};
  for (Contender& peer : peer_contenders()) contenders.push_back(std::move(peer));
  const auto grid = run_part("grid", flexible_grid(), contenders);
  write_text_file(out / "peers.csv", price_cells(grid, contenders, 0).csv());
  for (const TextTable& table :
       {flexible_summary("The grid", grid, contenders), price_table(grid, contenders, 0)})
    std::cout << table.markdown();
  const TextTable lost = lost_cells(grid, contenders, 0);
  std::cout << (lost.rows.empty() ? contenders.front().name + " loses no cell\n" : lost.markdown());
  std::cout << "written to " << out.string() << "\n";
}

/// Runs the daemon's controller with wrong configurations, on the grid and on joints drawn at random.
void run_wrong(const FlexibleTables& gains, const FlexibleOptions& options) {
  const auto print = [](const std::string& title, const std::vector<FlexibleCell>& cells,
                        const Contender& daemon) {
    std::cout << wrongly_configured_summary(title, run_wrongly_configured(cells, daemon)).markdown();
  };
  const Contender daemon = daemon_contender(gains);
  print("Grid", wrongly_configured_grid(), daemon);
  print("Gains for delays of one and two periods", late_grid(),
        extended_contender("daemon", gains.shipped_for_delays));
  print("Random joints", wrongly_configured_joints(options.joints.count, options.joints.seed), daemon);
}

void run(const FlexibleOptions& options) {
  const FlexibleTables gains = read_flexible_tables(tables_folder(options.tables));
  if (options.wrong) return run_wrong(gains, options);
  const std::filesystem::path out = options.out;
  make_folder(out);
  if (options.peers) return run_peers(gains, out);
  const std::vector<Contender> contenders = flexible_contenders(gains, options.full);
  const std::size_t daemon = number_of("daemon", contenders);
  const auto begin = std::chrono::steady_clock::now();

  const auto grid = run_part("grid", flexible_grid(), contenders);
  std::vector<TextTable> tables = {flexible_summary("The grid", grid, contenders),
                                   price_table(grid, contenders, daemon)};
  write_text_file(out / "grid.csv", flexible_cells(grid, contenders).csv());
  write_text_file(out / "price.csv", price_cells(grid, contenders, daemon).csv());
  if (options.full) {
    const auto effects = run_part("effects", effect_grid(), contenders);
    const auto random =
        run_part("random joints", random_joints(options.joints.count, options.joints.seed), contenders);
    tables.push_back(effect_ranking(effects, contenders));
    tables.push_back(flexible_summary("Joints drawn at random, seed " + std::to_string(options.joints.seed),
                                      random, contenders));
    write_text_file(out / "effects.csv", flexible_cells(effects, contenders).csv());
    write_text_file(out / ("random-seed-" + std::to_string(options.joints.seed) + ".csv"),
                    flexible_cells(random, contenders).csv());
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const auto figures = flexible_figures(grid, contenders);
  draw_figures(figures, out);
  write_text_file(out / "flexible.html", html_page("<h1>The flexible joint</h1>\n<p>Gear csf-17-50, motor "
                                                   "side 0.089 kg.m2, encoder of 320000 counts on the "
                                                   "motor's side, one period of delay, 34 N.m, 75 V.</p>\n",
                                                   tables, figures, out));
  for (const TextTable& table : tables) std::cout << table.markdown();
  std::cout << "computed in " << number(seconds, 3) << " s; written to " << out.string() << "\n";
}

}  // namespace

void add_flexible_command(CLI::App& program, CommandBody& chosen) {
  const auto options = std::make_shared<FlexibleOptions>();
  CLI::App* command =
      program.add_subcommand("flexible", "Every controller on a joint with a spring, over a grid of joints");
  add_tables_option(*command, options->tables);
  command->add_option("--out", options->out, "folder to write to")->capture_default_str();
  command->add_flag("--full", options->full, "every contender, each further effect, and joints at random");
  command->add_flag("--peers", options->peers,
                    "the daemon against servo cascades, disturbance observer and LQG, on "
                    "the grid alone");
  command->add_flag(
      "--wrong", options->wrong,
      "the daemon with a wrong load, stiffness, friction or delay in its model; prints, writes nothing");
  add_random_joints_options(*command, options->joints, "number of random joints, with --full or --wrong");
  command->callback([&chosen, options] {
    chosen = [options] {
      run(*options);
      return ExitStatus::kDone;
    };
  });
}

}  // namespace strainwave
