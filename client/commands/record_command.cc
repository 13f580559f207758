// record: every message of a prefix to an LCM event log.
#include <fmt/format.h>

#include "base/printable.h"
#include "client/commands/commands.h"
#include "client/link/event_log_writer.h"
#include "client/link/output_file.h"
#include "client/text/mcap_log.h"

namespace strainwave {

namespace {

/// What is heard, into an MCAP file as it comes.
class McapRecording {
 public:
  McapRecording(Client& client, const RecordArguments& arguments)
      : claim_(claim_output(arguments.file, arguments.overwrite)),
        log_(arguments.file),
        subscription_(client.connection().subscribe(
            recorded_channels(client.options().prefix, arguments.joints), &McapRecording::on_message, this)) {
  }

  bool good() const noexcept { return log_.good(); }
  const std::map<std::string, long>& counts() const noexcept { return counts_; }
  void finish() { log_.finish(); }

 private:
  void on_message(const ReceivedMessage& message) {
    const auto name = parse_channel(message.channel);
    if (good() && name && log_.take(*name, message.channel, message.received_us, message.bytes))
      ++counts_[message.channel];
  }

  UniqueFd claim_;  ///< of the file, before it is opened and emptied
  McapLog log_;
  std::map<std::string, long> counts_;
  Subscription subscription_;
};

/// Waits until the recording is over; an interrupt is a normal end.
template <typename Log>
void wait_for_end(Client& client, const Log& log, const Deadline& end) {
  try {
    client.wait_until([&] { return !log.good(); }, end);
  } catch (const ClientError& error) {
    if (error.status() != ExitStatus::kInterrupted) throw;
  }
}

template <typename Log>
void record_into(Log& log, Client& client, const Output& output, const RecordArguments& arguments) {
  constexpr double kNoEnd_s = 1e9;
  wait_for_end(client, log, Deadline(arguments.duration_s.value_or(kNoEnd_s)));
  log.finish();
  for (const auto& [channel, count] : log.counts())
    say(output, fmt::format("{}: {} messages in {}", printable(channel), count, arguments.file.string()),
        {{"channel", channel}, {"messages", std::int64_t{count}}, {"file", arguments.file.string()}});
}

}  // namespace

void record(Client& client, const Output& output, const RecordArguments& arguments) {
  refuse_name_of_mcap(arguments.file, arguments.mcap);
  if (is_named(arguments.file, ".csv"))
    throw ClientError(ExitStatus::kUsage, arguments.file.string() +
                                              " would be no CSV file: record an LCM log, and strainwavectl "
                                              "export makes CSV of it");
  for (const std::string& joint : arguments.joints) client.wait_for_joint(joint);
  if (arguments.joints.empty()) client.wait_for_joints();
  if (arguments.mcap) {
    McapRecording log(client, arguments);
    return record_into(log, client, output, arguments);
  }
  EventLogWriter log(client.connection(), client.options().prefix, arguments.joints, arguments.file,
                     arguments.overwrite);
  record_into(log, client, output, arguments);
}

}  // namespace strainwave
