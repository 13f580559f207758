// SPDX-License-Identifier: BSD-3-Clause
// Places for a bounded number of names from the network. Each name belongs to the address it was first heard from. When all places are
// taken, the address with the most names loses the name that has been silent longest. First hosts are compared, then the ports of
// that host. So a sender that invents names loses only its own, and a sender on another port keeps its names. Not real-time.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "transport/lcm_reassembly.h"

namespace strainwave {

template <typename Name>
class FairPlaces {
 public:
  explicit FairPlaces(std::size_t places) : places_(places) {}

  /// Notes that `name` was heard from `from`, and gives it a place. Returns the name that lost its place for it, if any.
  std::optional<Name> take(const Name& name, const LcmSource& from, double now_s) {
    if (const auto known = names_.find(name); known != names_.end()) {
      known->second.heard_s = now_s;
      return std::nullopt;
    }
    std::optional<Name> lost;
    if (names_.size() >= places_) {
      lost = crowding_name();
      leave(*lost);
    }
    names_[name] = {from, now_s};
    ++hosts_[from.address];
    ++ports_[{from.address, from.port}];
    return lost;
  }

  void leave(const Name& name) {
    const auto found = names_.find(name);
    if (found == names_.end()) return;
    const LcmSource from = found->second.from;
    names_.erase(found);
    subtract(hosts_, from.address);
    subtract(ports_, Port{from.address, from.port});
  }

 private:
  using Port = std::pair<std::uint32_t, std::uint16_t>;
  struct Place {
    LcmSource from;
    double heard_s = 0.0;
  };

  template <typename Counts, typename Key>
  static void subtract(Counts& counts, const Key& key) {
    const auto found = counts.find(key);
    if (--found->second == 0) counts.erase(found);
  }

  Name crowding_name() const {
    const auto order = [&](const auto& entry) {
      const LcmSource& from = entry.second.from;
      return std::tuple(hosts_.at(from.address), ports_.at({from.address, from.port}), -entry.second.heard_s);
    };
    return std::max_element(names_.begin(), names_.end(),
                            [&](const auto& a, const auto& b) { return order(a) < order(b); })
        ->first;
  }

  std::size_t places_;
  std::map<Name, Place> names_;
  std::map<std::uint32_t, std::size_t> hosts_;  ///< number of names per host
  std::map<Port, std::size_t> ports_;           ///< number of names per port of a host
};

}  // namespace strainwave
