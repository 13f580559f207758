// plot-record: a flight record as a picture, by gnuplot. Needs neither daemon nor LCM.
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "client/commands/commands.h"
#include "client/link/exit_status.h"
#include "client/text/flight_record.h"

namespace strainwave {

namespace {

/// Runs gnuplot with `script` as its input; its exit status, or -1 with errno when there is no gnuplot.
int run_gnuplot(const std::string& script) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> input(std::tmpfile(), &std::fclose);
  if (!input || std::fwrite(script.data(), 1, script.size(), input.get()) != script.size() ||
      std::fflush(input.get()) != 0)
    return -1;
  std::rewind(input.get());
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, ::fileno(input.get()), STDIN_FILENO);
  std::string program = "gnuplot";
  const std::array<char*, 2> arguments{program.data(), nullptr};
  pid_t child = 0;
  const int problem = ::posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  errno = problem;
  if (problem != 0) return -1;
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

}  // namespace

void plot_record(const Output& output, const PlotRecordArguments& arguments) {
  const FlightRecordInfo info = read_flight_record(arguments.file);
  const std::filesystem::path png =
      arguments.out ? *arguments.out : std::filesystem::path(arguments.file.string() + ".png");
  const int status = run_gnuplot(plot_script(info, arguments.file, png, arguments.around_s));
  if (status < 0)
    throw ClientError(ExitStatus::kFile,
                      fmt::format("gnuplot cannot be run ({}): it is needed to draw; install the "
                                  "package gnuplot-nox",
                                  std::strerror(errno)));
  if (status != 0 || !std::filesystem::exists(png))
    throw ClientError(ExitStatus::kFile,
                      fmt::format("{} could not be drawn; gnuplot says why above", png.string()));
  output.stream << fmt::format("{}: joint {}, fault {}\n", png.string(), info.head.at("joint"),
                               info.head.at("fault"));
}

}  // namespace strainwave
