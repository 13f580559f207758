// SPDX-License-Identifier: BSD-3-Clause
// export: converts an LCM event log to CSV or MCAP. Needs neither LCM nor a daemon.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <map>

#include "base/printable.h"
#include "base/text_file.h"
#include "client/commands/commands.h"
#include "client/protocol/output_file.h"
#include "client/text/mcap_flight.h"
#include "client/text/mcap_log.h"
#include "client/text/message_csv.h"
#include "client/text/state_csv.h"
#include "lcmtypes/channels.h"
#include "lcmtypes/event_log.h"
#include "lcmtypes/wire.h"

namespace strainwave {

namespace {

std::ofstream create(const std::filesystem::path& path, bool overwrite) {
  refuse_to_replace(path, overwrite);
  std::ofstream file(path);
  if (!file) throw not_writable(path);
  return file;
}

void require_complete(std::ofstream& file, const std::filesystem::path& path) {
  if (!file.flush())
    throw ClientError(ExitStatus::kRefused,
                      path.string() + " is incomplete: writing failed; is the disk full?");
}

/// Facts about a log that the export needs before it writes the first line.
struct LogSpan {
  std::int64_t first_us = 0;  ///< time of receipt of its first message
  int weights = 0;            ///< largest number of weights in its states
};

LogSpan span_of(const std::filesystem::path& log) {
  EventLogReader reader(log);
  LogSpan span;
  bool begun = false;
  for (LogEvent event; reader.next(event);) {
    const auto name = parse_channel(event.channel);
    if (!name) continue;
    if (!begun) span.first_us = event.received_us;
    begun = true;
    if (name->kind != channel_kind::kState) continue;
    if (const auto state = decode_exactly<state_v1>(event.data))
      span.weights = std::max(span.weights, weights_in_use(*state));
  }
  return span;
}

double time_s(const LogEvent& event, const LogSpan& span) {
  return 1e-6 * static_cast<double>(event.received_us - span.first_us);
}

/// The states of all joints in one file.
class StateExport {
 public:
  StateExport(const std::filesystem::path& path, bool overwrite, const LogSpan& span)
      : path_(path), file_(create(path, overwrite)), span_(span) {
    file_ << "joint,time_s" << state_csv_columns(span.weights) << '\n';
  }
  bool take(const ChannelName& name, const LogEvent& event) {
    const auto state =
        name.kind == channel_kind::kState ? decode_exactly<state_v1>(event.data) : std::nullopt;
    if (state)
      file_ << fmt::format("{},{:.6f}", name.joint, time_s(event, span_))
            << state_csv_values(*state, span_.weights) << '\n';
    if (state) ++counts_[name.joint];
    return state.has_value();
  }
  void finish(const Output& output) {
    require_complete(file_, path_);
    for (const auto& [joint, count] : counts_)
      say(output, fmt::format("{}: {} in {}", joint, counted(count, "state"), path_.string()),
          {{"joint", joint}, {"states", std::int64_t{count}}, {"file", path_.string()}});
  }

 private:
  std::filesystem::path path_;
  std::ofstream file_;
  LogSpan span_;
  std::map<std::string, long> counts_;
};

/// One file per channel: the time of receipt of a message, then its fields.
class ChannelExport {
 public:
  ChannelExport(const std::filesystem::path& folder, bool overwrite, const LogSpan& span)
      : folder_(folder), overwrite_(overwrite), span_(span) {
    make_folder(folder);
  }
  bool take(const ChannelName& name, const LogEvent& event) {
    if (name.kind == channel_kind::kState) return write<state_v1>(event);
    if (name.kind == channel_kind::kTemperature) return write<temperature_v1>(event);
    if (name.kind == channel_kind::kLimits) return write<limits_v1>(event);
    if (name.kind == channel_kind::kTiming) return write<timing_v1>(event);
    if (name.kind == channel_kind::kSetpoint) return write<setpoint_v1>(event);
    if (name.kind == channel_kind::kCommand) return write<command_v1>(event);
    if (name.kind == channel_kind::kInject) return write<inject_v1>(event);
    if (name.kind == channel_kind::kAck) return write<ack_v1>(event);
    return false;
  }
  void finish(const Output& output) {
    for (auto& [channel, file] : files_) {
      require_complete(file.stream, file.path);
      say(output, fmt::format("{}: {} in {}", channel, counted(file.count, "message"), file.path.string()),
          {{"channel", channel}, {"messages", std::int64_t{file.count}}, {"file", file.path.string()}});
    }
  }

 private:
  struct File {
    std::filesystem::path path;
    std::ofstream stream;
    long count = 0;
  };
  template <typename Message>
  bool write(const LogEvent& event) {
    const auto message = decode_exactly<Message>(event.data);
    if (!message) return false;
    auto found = files_.find(event.channel);
    if (found == files_.end()) {
      // parse_channel() has checked that the name is a plain file name.
      const std::filesystem::path path = folder_ / (event.channel + ".csv");
      found = files_.emplace(event.channel, File{path, create(path, overwrite_)}).first;
      found->second.stream << "received_us,time_s" << columns<Message>() << '\n';
    }
    found->second.stream << fmt::format("{},{:.6f}", event.received_us, time_s(event, span_))
                         << values(*message) << '\n';
    ++found->second.count;
    return true;
  }

  template <typename Message>
  std::string columns() const {
    if constexpr (std::same_as<Message, state_v1>)
      return state_csv_columns(span_.weights);
    else
      return csv_columns<Message>();
  }
  template <typename Message>
  std::string values(const Message& message) const {
    if constexpr (std::same_as<Message, state_v1>)
      return state_csv_values(message, span_.weights);
    else
      return csv_values(message);
  }

  std::filesystem::path folder_;
  bool overwrite_;
  LogSpan span_;
  std::map<std::string, File> files_;
};

/// All messages of Strainwave in one MCAP file.
class McapExport {
 public:
  McapExport(const std::filesystem::path& path, bool overwrite)
      : path_(path), log_(checked(path, overwrite)) {}
  bool take(const ChannelName& name, const LogEvent& event) {
    return log_.take(name, event.channel, event.received_us, event.data);
  }
  void finish(const Output& output) {
    log_.finish();
    say(output, fmt::format("{} in {}", counted(log_.messages(), "message"), path_.string()),
        {{"messages", static_cast<std::int64_t>(log_.messages())}, {"file", path_.string()}});
  }

 private:
  static const std::filesystem::path& checked(const std::filesystem::path& path, bool overwrite) {
    (void)create(path, overwrite);
    return path;
  }
  std::filesystem::path path_;
  McapLog log_;
};

/// Counts messages with an earlier time of receipt than the message before.
class FallingTimes {
 public:
  void take(const LogEvent& event) {
    if (event.received_us < last_us_) ++falls_;
    last_us_ = event.received_us;
  }
  void report(const Output& output) const {
    if (falls_ == 0) return;
    say(output,
        fmt::format(
            "the times of receipt jump back {}: logs were joined, or the recorder's clock was set back",
            falls_ == 1 ? "once" : counted(falls_, "time")),
        {{"falling_times", std::int64_t{falls_}}});
  }

 private:
  std::int64_t last_us_ = std::numeric_limits<std::int64_t>::min();
  long falls_ = 0;
};

void report_damage(const Output& output, const LogDamage& damage) {
  if (damage.places == 0) return;
  say(output,
      fmt::format(
          "WARNING: the log is damaged: {} in {} skipped, from byte {} on; messages are missing there",
          counted(damage.skipped_bytes, "byte"), counted(damage.places, "place"), damage.first_byte),
      {{"skipped_bytes", static_cast<std::int64_t>(damage.skipped_bytes)},
       {"damaged_places", std::int64_t{damage.places}},
       {"first_damaged_byte", static_cast<std::int64_t>(damage.first_byte)}});
}

template <typename Export>
void export_into(Export into, const Output& output, const std::filesystem::path& log) {
  EventLogReader reader(log);
  long others = 0;
  long taken = 0;
  FallingTimes times;
  for (LogEvent event; reader.next(event);) {
    const auto name = parse_channel(event.channel);
    const bool ours = name && into.take(*name, event);
    ++(ours ? taken : others);
    if (ours) times.take(event);
  }
  into.finish(output);
  if (taken == 0)
    say(output, fmt::format("nothing in {} could be exported", log.string()),
        {{"exported", std::int64_t{0}}});
  if (others > 0)
    say(output, fmt::format("left out: {}", counted(others, "other message")),
        {{"left_out", std::int64_t{others}}});
  times.report(output);
  report_damage(output, reader.damage());
  if (reader.truncated()) say(output, "the log's last message is cut off", {{"truncated", true}});
}

void export_flight_record(const Output& output, const ExportArguments& arguments) {
  if (!arguments.mcap)
    throw ClientError(ExitStatus::kUsage,
                      arguments.log.string() +
                          " is a flight record, which is CSV already: --mcap makes an MCAP file of it");
  (void)create(arguments.out, arguments.overwrite);
  const FlightMcap written = write_flight_mcap(arguments.log, arguments.out);
  say(output,
      fmt::format("{}: {} in {}", written.topic, counted(written.messages, "message"),
                  arguments.out.string()),
      {{"channel", written.topic},
       {"messages", static_cast<std::int64_t>(written.messages)},
       {"file", arguments.out.string()}});
}

}  // namespace

void export_log(const Output& output, const ExportArguments& arguments) {
  std::error_code neither_is_there;
  if (std::filesystem::equivalent(arguments.log, arguments.out, neither_is_there))
    throw ClientError(ExitStatus::kUsage,
                      arguments.out.string() + " is the log that export reads: choose another name");
  refuse_name_of_mcap(arguments.out, arguments.mcap);
  if (is_flight_record(arguments.log)) return export_flight_record(output, arguments);
  const LogSpan span = span_of(arguments.log);  // before anything is created
  if (arguments.mcap)
    export_into(McapExport(arguments.out, arguments.overwrite), output, arguments.log);
  else if (is_named(arguments.out, ".csv"))
    export_into(StateExport(arguments.out, arguments.overwrite, span), output, arguments.log);
  else
    export_into(ChannelExport(arguments.out, arguments.overwrite, span), output, arguments.log);
}

}  // namespace strainwave
