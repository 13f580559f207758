// SPDX-License-Identifier: BSD-3-Clause
#include "client/protocol/event_log_writer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "client/protocol/output_file.h"
#include "lcmtypes/channels.h"

namespace strainwave {

namespace {

lcm_eventlog_t* open_log(const std::filesystem::path& file) {
  lcm_eventlog_t* const log = ::lcm_eventlog_create(file.c_str(), "w");
  if (log == nullptr) throw not_writable(file);
  return log;
}

}  // namespace

// A joint's name has no characters with a special meaning in a regular expression.
std::string recorded_channels(const std::string& prefix, const std::vector<std::string>& joints) {
  if (joints.empty()) return prefix + "\\..*";
  return fmt::format("{}\\.(({})\\..*|{})", prefix, fmt::join(joints, "|"), channel_kind::kTiming);
}

EventLogWriter::EventLogWriter(Connection& connection, const std::string& prefix,
                               const std::vector<std::string>& joints, const std::filesystem::path& file,
                               bool overwrite)
    : name_(file.string()),
      claim_(claim_output(file, overwrite)),
      log_(open_log(file), &::lcm_eventlog_destroy),
      subscription_(
          connection.subscribe(recorded_channels(prefix, joints), &EventLogWriter::on_message, this)) {}

void EventLogWriter::on_message(const ReceivedMessage& message) {
  if (!good_) return;
  std::string name = message.channel;  // liblcm requires writable text and data
  std::vector<std::uint8_t> data(message.bytes.begin(), message.bytes.end());
  lcm_eventlog_event_t event{};
  event.timestamp = message.received_us;
  event.channellen = static_cast<std::int32_t>(name.size());
  event.datalen = static_cast<std::int32_t>(data.size());
  event.channel = name.data();
  event.data = data.data();
  good_ = ::lcm_eventlog_write_event(log_.get(), &event) == 0;
  if (good_) ++counts_[name];
}

void EventLogWriter::finish() {
  good_ = good_ && std::fflush(log_->f) == 0;
  if (!good_)
    throw ClientError(ExitStatus::kRefused, name_ + " is incomplete: writing failed; is the disk full?");
}

}  // namespace strainwave
