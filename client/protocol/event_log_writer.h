// SPDX-License-Identifier: BSD-3-Clause
// What is heard on LCM, into an event log as lcm-logger writes it (liblcm's own writer). Not real-time.
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

/// The channels of `prefix`, or only those of `joints` and the daemon as a whole, as Connection::subscribe() takes them.
std::string recorded_channels(const std::string& prefix, const std::vector<std::string>& joints);

class EventLogWriter {
 public:
  /// Creates `file` and writes every message of `prefix` from now on, or only those of `joints` and the
  /// daemon as a whole. Throws ClientError (file): it exists and `overwrite` is false, another process writes it, or it cannot
  /// be created.
  EventLogWriter(Connection& connection, const std::string& prefix, const std::vector<std::string>& joints,
                 const std::filesystem::path& file, bool overwrite);

  /// False: writing has failed, the log ends here.
  bool good() const noexcept { return good_; }
  /// Messages written, by channel.
  const std::map<std::string, long>& counts() const noexcept { return counts_; }
  /// Brings everything to the disk. Throws ClientError (file) when anything was lost.
  void finish();

 private:
  void on_message(const ReceivedMessage& message);

  std::string name_;
  UniqueFd claim_;  ///< of the file, before it is opened and emptied
  std::unique_ptr<lcm_eventlog_t, void (*)(lcm_eventlog_t*)> log_;
  std::map<std::string, long> counts_;
  bool good_ = true;
  Subscription subscription_;
};

}  // namespace strainwave
