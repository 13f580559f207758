// SPDX-License-Identifier: BSD-3-Clause
// Writes received LCM messages to an event log in the format of lcm-logger, with liblcm's writer. Not real-time.
#pragma once

#include <lcm/eventlog.h>

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/unique_fd.h"
#include "client/protocol/connection.h"

namespace strainwave {

/// A pattern for Connection::subscribe(): the channels of `prefix`, or only those of `joints` and of the daemon itself.
std::string recorded_channels(const std::string& prefix, const std::vector<std::string>& joints);

class EventLogWriter {
 public:
  /// Creates `file` and writes every message of `prefix` from now on, or only those of `joints` and of the
  /// daemon itself. Throws ClientError (usage) if the file exists and `overwrite` is false, if another
  /// process writes it, or if it cannot be created.
  EventLogWriter(Connection& connection, const std::string& prefix, const std::vector<std::string>& joints,
                 const std::filesystem::path& file, bool overwrite);

  /// False if writing has failed. The log then ends there.
  bool good() const noexcept { return good_; }
  /// Number of written messages, by channel.
  const std::map<std::string, long>& counts() const noexcept { return counts_; }
  /// Flushes the log. Throws ClientError (refused) when a message was lost.
  void finish();

 private:
  void on_message(const ReceivedMessage& message);

  std::string name_;
  UniqueFd claim_;  ///< claim on the file, before it is opened and emptied
  std::unique_ptr<lcm_eventlog_t, void (*)(lcm_eventlog_t*)> log_;
  std::map<std::string, long> counts_;
  bool good_ = true;
  Subscription subscription_;
};

}  // namespace strainwave
