// SPDX-License-Identifier: BSD-3-Clause
// Options of record, export, play, plot-record.
#include <CLI/CLI.hpp>
#include <memory>

#include "client/options/command_options.h"

namespace strainwave {

namespace {

void add_record(CLI::App& app, Invocation& invocation) {
  CLI::App* command =
      app.add_subcommand("record", "record every message of the prefix in an LCM event log, until Ctrl-C");
  auto arguments = std::make_shared<RecordArguments>();
  add_joints(*command, arguments->joints, "only these joints; none: all of the prefix");
  command->add_option("--out", arguments->file, "the log, readable by lcm-logplayer")
      ->required()
      ->type_name("FILE");
  auto duration_s = std::make_shared<double>(0.0);
  add_seconds(*command, "--duration_s", *duration_s, "end after this time");
  command->add_flag("--overwrite", arguments->overwrite, "replace the file if it exists");
  command->add_flag("--mcap", arguments->mcap,
                    "an MCAP file (Foxglove, PlotJuggler) instead of an LCM event log");
  command->callback([&invocation, arguments, duration_s] {
    if (*duration_s > 0.0) arguments->duration_s = *duration_s;
    invocation.command = [arguments](Client& client, const Output& output) {
      record(client, output, *arguments);
    };
  });
}

void add_export(CLI::App& app, Invocation& invocation) {
  CLI::App* command = app.add_subcommand("export", "decode an LCM event log into CSV (needs no daemon)");
  auto arguments = std::make_shared<ExportArguments>();
  command
      ->add_option("LOG", arguments->log, "from record, or from lcm-logger; with --mcap also a flight record")
      ->required()
      ->type_name("");
  command
      ->add_option(
          "--out", arguments->out,
          "a folder for one file per channel; or a name that ends in .csv for the states of all joints")
      ->required()
      ->type_name("DIR|FILE.csv");
  command->add_flag("--overwrite", arguments->overwrite, "replace files that exist");
  command->add_flag("--mcap", arguments->mcap, "one MCAP file (Foxglove, PlotJuggler) instead of CSV");
  command->callback([&invocation, arguments] {
    invocation.local_command = [arguments](const Output& output) { export_log(output, *arguments); };
  });
}

void add_play(CLI::App& app, Invocation& invocation) {
  CLI::App* command =
      app.add_subcommand("play", "replay the setpoints of a log with their timing, signed again with --key");
  auto arguments = std::make_shared<PlayArguments>();
  command->add_option("LOG", arguments->log, "from record, or from lcm-logger")->required()->type_name("");
  command->add_option("--joint", arguments->joint, "the joint that the setpoints were for, and that moves")
      ->required()
      ->type_name("JOINT");
  command->callback([&invocation, arguments] {
    invocation.command = [arguments](Client& client, const Output& output) {
      play(client, output, *arguments);
    };
  });
}

void add_plot_record(CLI::App& app, Invocation& invocation) {
  CLI::App* command =
      app.add_subcommand("plot-record", "draw a flight record into a PNG (needs gnuplot, no daemon)");
  auto arguments = std::make_shared<PlotRecordArguments>();
  auto around_s = std::make_shared<double>(0.0);
  command->add_option("FILE", arguments->file, "the record")->required()->type_name("");
  command->add_option("--out", arguments->out, "the picture; otherwise FILE.png")->type_name("PNG");
  add_seconds(*command, "--around_s", *around_s, "draw only this much time before and after the fault");
  command->callback([&invocation, arguments, around_s] {
    if (*around_s > 0.0) arguments->around_s = *around_s;
    invocation.local_command = [arguments](const Output& output) { plot_record(output, *arguments); };
  });
}

}  // namespace

void add_log_commands(CLI::App& app, Invocation& invocation) {
  add_record(app, invocation);
  add_export(app, invocation);
  add_play(app, invocation);
  add_plot_record(app, invocation);
}

}  // namespace strainwave
