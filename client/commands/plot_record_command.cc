// SPDX-License-Identifier: BSD-3-Clause
// plot-record: draws a flight record with gnuplot. Needs neither daemon nor LCM.
#include <fmt/format.h>

#include "base/gnuplot.h"
#include "client/commands/commands.h"
#include "client/text/flight_record.h"
#include "strainwave/client_error.h"

namespace strainwave {

void plot_record(const Output& output, const PlotRecordArguments& arguments) {
  const FlightRecordInfo info = read_flight_record(arguments.file);
  const std::filesystem::path png =
      arguments.out ? *arguments.out : std::filesystem::path(arguments.file.string() + ".png");
  run_gnuplot(plot_script(info, arguments.file, png, arguments.around_s));
  if (!std::filesystem::exists(png))
    throw ClientError(ExitStatus::kUsage, fmt::format("{} could not be drawn", png.string()));
  say(output,
      fmt::format("{}: joint {}, fault {}", png.string(), info.head.at("joint"), info.head.at("fault")),
      {{"file", png.string()}, {"joint", info.head.at("joint")}, {"fault", info.head.at("fault")}});
}

}  // namespace strainwave
