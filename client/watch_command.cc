// watch: joints over time.
#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "client/commands.h"
#include "client/exit_status.h"
#include "client/text.h"

namespace strainwave {

namespace {

constexpr std::size_t kUnlimited = std::string::npos;

/// Columns of the terminal on standard output: a longer line would wrap and spoil the rewriting in place.
std::size_t terminal_columns() {
  winsize size{};
  if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return 80;
  return size.ws_col;
}

std::vector<std::string> rows(const Client& client, const std::vector<std::string>& joints) {
  std::vector<std::string> lines;
  for (const std::string& joint : joints) {
    if (const JointView* view = client.find(joint)) {
      lines.push_back(state_row(joint, *view, seconds_between(view->received, now())));
    }
  }
  return lines;
}

/// Waits one interval. False: interrupted, which is how a watch normally ends.
bool wait_interval(Client& client, const Deadline& interval) {
  try {
    client.wait_until([] { return false; }, interval);
    return true;
  } catch (const ClientError& error) {
    if (error.status() == ExitStatus::kInterrupted) return false;
    throw;
  }
}

}  // namespace

void watch(Client& client, const Output& output, const WatchArguments& arguments) {
  for (const std::string& joint : arguments.joints) client.wait_for_joint(joint);
  if (arguments.joints.empty()) client.wait_for_joints();
  const bool in_place = output.terminal && !arguments.plain;
  const std::optional<Deadline> end =
      arguments.duration_s ? std::optional<Deadline>(*arguments.duration_s) : std::nullopt;
  std::size_t written = 0;  // lines above the cursor that belong to us
  bool running = true;
  while (running) {
    const std::size_t columns = in_place ? terminal_columns() : kUnlimited;
    if (in_place && written > 0) output.stream << fmt::format("\x1b[{}A", written);
    if (in_place || written == 0)
      output.stream << clipped(state_header(), columns) << (in_place ? "\x1b[K\n" : "\n");
    const std::vector<std::string> joints =
        arguments.joints.empty() ? client.states().joints(client.options().prefix) : arguments.joints;
    const std::vector<std::string> lines = rows(client, joints);
    for (const std::string& line : lines)
      output.stream << clipped(line, columns) << (in_place ? "\x1b[K\n" : "\n");
    output.stream.flush();
    written = lines.size() + 1;
    running = wait_interval(client, Deadline(arguments.interval_s)) && !(end && end->passed());
  }
}

}  // namespace strainwave
