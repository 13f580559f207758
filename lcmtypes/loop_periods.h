// The periods of the daemons that are heard, which a state alone does not tell: for what is computed from states. Bounded, whoever makes
// up prefixes. Not real-time.
#pragma once

#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <strainwave/limits_v1.hpp>
#include <strainwave/timing_v1.hpp>
#include <string>

#include "lcmtypes/channels.h"

namespace strainwave {

class LoopPeriods {
 public:
  static constexpr std::size_t kMaxDaemons = 1024;

  void take(const ChannelName& name, const limits_v1& message) { note(name.prefix, message.period_s); }
  void take(const ChannelName& name, const timing_v1& message) { note(name.prefix, message.period_s); }
  template <typename Other>
  void take(const ChannelName&, const Other&) {}

  /// Seconds; nothing: the daemon has not said it yet.
  std::optional<double> of(const std::string& prefix) const {
    const auto found = periods_s_.find(prefix);
    return found == periods_s_.end() ? std::nullopt : std::optional(found->second);
  }

 private:
  void note(const std::string& prefix, double period_s) {
    const bool room = periods_s_.size() < kMaxDaemons || periods_s_.contains(prefix);
    if (room && std::isfinite(period_s) && period_s > 0.0) periods_s_[prefix] = period_s;
  }
  std::map<std::string, double> periods_s_;
};

}  // namespace strainwave
