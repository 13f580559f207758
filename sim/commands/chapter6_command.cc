// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <chrono>
#include <iostream>
#include <memory>

#include "base/text_file.h"
#include "sim/commands/commands.h"
#include "sim/studies/chapter6_figures.h"
#include "sim/studies/html_page.h"
#include "sim/studies/performance_tables.h"

namespace strainwave {

namespace {

struct Chapter6Options {
  std::string tables;
  std::string data;
  std::string out = "chapter6";
  bool no_figures = false;
};

std::string introduction(const Chapter6& chapter) {
  return "<h1>Chapter 6: friction that varies with temperature</h1>\n<p>Every controller of Z. Zhao (2006), "
         "chapter 6, "
         "on the same joint: the plant has the Stribeck curve, the exponential law over temperature and true "
         "stiction; "
         "the controllers know only their gain tables. <b>Ideal</b>: exact state, no torque limit, as in the "
         "paper. <b>Limited</b>: exact state, 34 N.m. <b>Realistic</b>: encoder of 320000 counts per "
         "revolution and "
         "no "
         "velocity sensor, one sample of computation delay, 34 N.m, supply and back-EMF. C1 and C3 know no "
         "temperature and no friction; C2 and C4 are scheduled and feed friction forward; C4+ is what "
         "the daemon runs, the shipped table with observer, reference shaping and quiet rest. The physical "
         "limit is the time-optimal motion with the same "
         "motor and known "
         "friction, free to move at once; a controller with one sample of delay cannot come below the limit "
         "plus one "
         "sample. The paper states neither its sampling period nor its run length: compare "
         "orderings.</p>\n<p>" +
         std::to_string(chapter.runs.size()) + " runs, " + number(static_cast<double>(chapter.periods), 4) +
         " periods of 1 ms with 10 sub-steps each, computed in " + number(chapter.computation_s, 3) +
         " s.</p>\n";
}

void run(const Chapter6Options& options) {
  const auto start = std::chrono::steady_clock::now();
  const std::filesystem::path data =
      options.data.empty() ? shared_folder("data") : std::filesystem::path(options.data);
  const auto tables = read_chapter6_tables(tables_folder(options.tables));
  const auto source = read_source_indices(data / "performance_index.csv");
  const std::filesystem::path out = options.out;
  make_folder(out);
  const Chapter6 chapter = run_chapter6(chapter6_contenders(tables));

  const auto performance = performance_tables(chapter, source);
  std::string markdown = "# Tables 8 to 11\n\n";
  for (const TextTable& table : performance) markdown += table.markdown();
  write_text_file(out / "tables.md", markdown);
  write_text_file(out / "runs.csv", run_table(chapter).csv());
  std::cout << markdown;
  if (!options.no_figures) {
    auto figures = friction_figures(data, tables.source.back().friction);
    for (Figure& figure : response_figures(chapter)) figures.push_back(std::move(figure));
    draw_figures(figures, out / "figures");
    write_text_file(out / "chapter6.html",
                    html_page(introduction(chapter), performance, figures, out / "figures"));
  }
  const double total_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::cout << chapter.runs.size() << " runs of " << chapter.periods << " periods in "
            << number(chapter.computation_s, 3) << " s ("
            << number(static_cast<double>(chapter.periods) / chapter.computation_s, 3)
            << " periods/s); with tables and figures " << number(total_s, 3) << " s\nwritten to "
            << out.string() << "\n";
}

}  // namespace

void add_chapter6_command(CLI::App& program, CommandBody& chosen) {
  const auto options = std::make_shared<Chapter6Options>();
  CLI::App* command =
      program.add_subcommand("chapter6", "Every controller in every scenario of Zhao (2006), chapter 6");
  command->add_option("--tables", options->tables,
                      "folder with c1.json .. c4.json and rhs17-6006.json (default: the installed tables)");
  command->add_option("--data", options->data,
                      "folder with the catalogue's CSV files (default: the installed data)");
  command->add_option("--out", options->out, "folder to write to")->capture_default_str();
  command->add_flag("--no-figures", options->no_figures, "tables only");
  command->callback([&chosen, options] {
    chosen = [options] {
      run(*options);
      return ExitStatus::kDone;
    };
  });
}

}  // namespace strainwave
