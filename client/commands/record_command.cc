// SPDX-License-Identifier: BSD-3-Clause
// record: writes every message of a prefix to an LCM event log or an MCAP file.
#include <fmt/format.h>

#include <algorithm>

#include "base/printable.h"
#include "client/commands/commands.h"
#include "client/protocol/event_log_writer.h"
#include "client/protocol/output_file.h"
#include "client/text/mcap_log.h"

namespace strainwave {

namespace {

/// Writes received messages to an MCAP file.
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

  UniqueFd claim_;  ///< claim on the file, before it is opened and emptied
  McapLog log_;
  std::map<std::string, long> counts_;
  Subscription subscription_;
};

/// Tracks the senders of the recorded messages, and counts their missing messages.
class Senders {
 public:
  Senders(Connection& connection, const std::string& channels)
      : connection_(connection), subscription_(connection.subscribe(channels, &Senders::on_message, this)) {
    connection.read_ahead();
  }

  std::uint64_t missing() const {
    std::uint64_t sum = 0;
    for (const LcmSource& source : sources_) sum += connection_.missing(source);
    return sum;
  }
  /// The likely reason for missing messages, and its remedy.
  std::string remedy() const {
    if (const std::uint64_t without_room = connection_.without_room(); without_room > 0)
      return fmt::format(
          "memory had no room for {} of them while the file was being written: is the disk too slow?",
          without_room);
    const Connection::SocketQueue queue = connection_.socket_queue();
    if (queue.given_bytes < queue.asked_bytes)
      return fmt::format(
          "the system limits the socket's queue to {} of {} bytes: as root, sysctl net.core.rmem_max={}",
          queue.given_bytes, queue.asked_bytes, queue.asked_bytes);
    return "the network lost them, or this program got no processor time for too long";
  }

 private:
  static constexpr std::size_t kMost = MissingMessages::kSources;
  void on_message(const ReceivedMessage& message) {
    if (sources_.size() < kMost && std::ranges::find(sources_, message.from) == sources_.end())
      sources_.push_back(message.from);
  }

  Connection& connection_;
  std::vector<LcmSource> sources_;
  Subscription subscription_;
};

/// Waits for the end of the recording. An interrupt is a normal end.
template <typename Log>
void wait_for_end(Client& client, const Log& log, const Deadline& end) {
  try {
    client.wait_until([&] { return !log.good(); }, end);
  } catch (const ClientError& error) {
    if (error.status() != ExitStatus::kInterrupted) throw;
  }
}

template <typename Log>
void record_into(Log& log, const Senders& senders, Client& client, const Output& output,
                 const RecordArguments& arguments) {
  constexpr double kNoEnd_s = 1e9;
  wait_for_end(client, log, Deadline(arguments.duration_s.value_or(kNoEnd_s)));
  log.finish();
  std::int64_t messages = 0;
  for (const auto& [channel, count] : log.counts()) {
    messages += count;
    say(output,
        fmt::format("{}: {} in {}", printable(channel), counted(count, "message"), arguments.file.string()),
        {{"channel", channel}, {"messages", std::int64_t{count}}, {"file", arguments.file.string()}});
  }
  const auto missing = static_cast<std::int64_t>(senders.missing());
  const std::string lost = missing > 0 ? fmt::format("{} more from the same senders {} missing: {}", missing,
                                                     missing == 1 ? "is" : "are", senders.remedy())
                                       : "none is missing";
  say(output, fmt::format("{}: {}; {}", arguments.file.string(), counted(messages, "message"), lost),
      {{"file", arguments.file.string()},
       {"messages", messages},
       {"missing", missing},
       {"without_room", static_cast<std::int64_t>(client.connection().without_room())},
       {"socket_queue_bytes", std::int64_t{client.connection().socket_queue().given_bytes}}});
}

}  // namespace

void record(Client& client, const Output& output, const RecordArguments& arguments) {
  refuse_name_of_mcap(arguments.file, arguments.mcap);
  if (is_named(arguments.file, ".csv"))
    throw ClientError(
        ExitStatus::kUsage,
        arguments.file.string() +
            " would not be a CSV file: record an LCM log, then convert it with strainwavectl export");
  for (const std::string& joint : arguments.joints) client.wait_for_joint(joint);
  if (arguments.joints.empty()) client.wait_for_joints();
  const Senders senders(client.connection(), recorded_channels(client.options().prefix, arguments.joints));
  if (arguments.mcap) {
    McapRecording log(client, arguments);
    return record_into(log, senders, client, output, arguments);
  }
  EventLogWriter log(client.connection(), client.options().prefix, arguments.joints, arguments.file,
                     arguments.overwrite);
  record_into(log, senders, client, output, arguments);
}

}  // namespace strainwave
