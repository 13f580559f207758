// SPDX-License-Identifier: BSD-3-Clause
// Makes the core's own messages in wire form: acknowledgements, temperature, limits, timing. The gateway publishes
// them. Not real-time.
#pragma once

#include <array>
#include <map>
#include <string>

#include "daemon/admission/admission.h"
#include "daemon/gateway/shared_memory.h"
#include "daemon/realtime/loop/realtime_loop.h"

namespace strainwave {

/// Writes acknowledgements and remembers the last one of every authentic sender, so that a resent order gets
/// the same answer.
class Answers {
 public:
  Answers(std::string prefix, std::int64_t session_id, std::vector<std::string> joints,
          decltype(OutboundMemory::messages)& out);

  void answer(const Requester& to, Reason reason, const std::string& text);
  /// Sends the last answer to this sender again if it has the same sequence. Otherwise sends nothing: the order is
  /// still in progress.
  void repeat(const Requester& to);

  void temperature(const StateRecord& record);
  /// Sends the limits and properties of joint number `joint`.
  void limits(std::size_t joint, const PlantIdentity& plant, const JointLoopConfig& config);
  void timing(const LoopTotals& statistics, const std::array<std::int64_t, kReasonCount>& rejects,
              const LoopConfig& config, bool real_time, std::int64_t records_dropped);

 private:
  struct Last {
    std::int64_t sequence;
    WireMessage message;
  };
  template <typename T>
  WireMessage wire(const std::string& channel, const T& message) const;

  std::string prefix_;
  std::int64_t session_id_;
  std::vector<std::string> joints_;
  decltype(OutboundMemory::messages)& out_;
  std::map<std::int64_t, Last> last_;  ///< by sender, bounded
};

}  // namespace strainwave
