// The periods of the daemons that are heard, which a state alone does not tell: for what is computed from states. Bounded: in a crowd
// of prefixes, made up or not, those that said it the longest ago are forgotten. Not real-time.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
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
    return found == periods_s_.end() ? std::nullopt : std::optional(found->second.period_s);
  }

 private:
  struct Said {
    double period_s = 0.0;
    std::uint64_t when = 0;  ///< counted in messages
  };

  void note(const std::string& prefix, double period_s) {
    if (!std::isfinite(period_s) || period_s <= 0.0) return;
    if (periods_s_.size() >= kMaxDaemons && !periods_s_.contains(prefix))
      periods_s_.erase(
          std::min_element(periods_s_.begin(), periods_s_.end(),
                           [](const auto& a, const auto& b) { return a.second.when < b.second.when; }));
    periods_s_[prefix] = {period_s, ++said_};
  }
  std::map<std::string, Said> periods_s_;
  std::uint64_t said_ = 0;
};

}  // namespace strainwave
