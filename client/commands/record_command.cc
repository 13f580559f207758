// record: every message of a prefix to an LCM event log.
#include <fmt/format.h>

#include "client/commands/commands.h"
#include "client/link/event_log_writer.h"
#include "client/link/exit_status.h"

namespace strainwave {

namespace {

/// Waits until the recording is over; an interrupt is a normal end.
void wait_for_end(Client& client, const EventLogWriter& log, const Deadline& end) {
  try {
    client.wait_until([&] { return !log.good(); }, end);
  } catch (const ClientError& error) {
    if (error.status() != ExitStatus::kInterrupted) throw;
  }
}

}  // namespace

void record(Client& client, const Output& output, const RecordArguments& arguments) {
  for (const std::string& joint : arguments.joints) client.wait_for_joint(joint);
  if (arguments.joints.empty()) client.wait_for_joints();
  EventLogWriter log(client.connection(), client.options().prefix, arguments.joints, arguments.file,
                     arguments.overwrite);
  constexpr double kNoEnd_s = 1e9;
  wait_for_end(client, log, Deadline(arguments.duration_s.value_or(kNoEnd_s)));
  log.finish();
  for (const auto& [channel, count] : log.counts())
    output.stream << fmt::format("{}: {} messages in {}\n", channel, count, arguments.file.string());
}

}  // namespace strainwave
