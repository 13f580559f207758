// SPDX-License-Identifier: BSD-3-Clause
// The PDOs of a simulated CANopen node, four per direction. They are configured through the object dictionary
// by the rules of the standard: disable, count 0, map, count, enable; anything else is refused. Source: CiA
// 301 (4.2.0), 7.2.2 and 7.5.2.35 to 7.5.2.38.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "tests/support/can_nodes/frame.h"
#include "tests/support/can_nodes/object_dictionary.h"

namespace strainwave::can_nodes {

inline constexpr int kPdosPerDirection = 4;
inline constexpr int kMaxMappedObjects = 8;

enum class Reception { kNotMine, kTaken, kTooShort, kTooLong };

/// Counts since the last clear_counts().
struct PdoCounts {
  long received = 0;
  long superseded = 0;          ///< a second RPDO replaced the first one before its SYNC
  long syncs_without_rpdo = 0;  ///< no RPDO since the last SYNC, although a synchronous one is enabled
  long transmitted = 0;
};

class PdoTable {
 public:
  /// Adds 1400h.., 1600h.., 1800h.. and 1A00h.. to `dictionary`. Every PDO begins disabled and unmapped,
  /// except the profile's first ones: controlword in, statusword out.
  PdoTable(ObjectDictionary& dictionary, std::uint8_t node_id);

  /// Sets whether PDOs may be configured in the node's state.
  void set_configurable(bool configurable) { configurable_ = configurable; }

  Reception receive(const Frame& frame, std::int64_t now_us = 0);
  /// The earliest deadline of the RPDOs that have come since begin(). The first reception starts the monitoring.
  std::optional<std::int64_t> rpdo_deadline_us() const;
  /// Forgets the receptions after a missed deadline was reported. Deadlines run again from the next RPDO on.
  void forget_rpdos() { received_us_ = {}; }
  /// At a SYNC: applies the synchronous RPDOs that were held for it.
  void use_held();
  /// At a SYNC: the TPDOs that are due with it, with the present values of the dictionary.
  std::vector<Frame> due_at_sync();
  /// The event-driven TPDOs that are due.
  std::vector<Frame> due_by_event(std::int64_t now_us);
  /// The node became operational: held RPDOs are stale, and event-driven TPDOs are due at once.
  void begin();

  const PdoCounts& counts() const { return counts_; }
  void clear_counts() { counts_ = PdoCounts{}; }

 private:
  struct Transmit {
    int syncs = 0;
    std::optional<std::vector<std::uint8_t>> last;
    std::int64_t sent_us = 0;
  };

  void add_objects(std::uint16_t communication, std::uint16_t mapping, std::uint32_t first_id);
  Abort check_communication(Key key, std::int64_t value) const;
  Abort check_mapping(Key key, std::int64_t value) const;
  Abort check_entry(Key key, std::int64_t value) const;
  bool enabled(std::uint16_t communication) const;
  std::uint32_t id_of(std::uint16_t communication) const;
  std::int64_t type_of(std::uint16_t communication) const { return dictionary_.number({communication, 2}); }
  std::vector<Key> mapped(std::uint16_t mapping) const;
  std::vector<std::uint8_t> pack(std::uint16_t mapping) const;
  void unpack(std::uint16_t mapping, std::span<const std::uint8_t> bytes);

  ObjectDictionary& dictionary_;
  std::uint8_t node_id_;
  bool configurable_ = true;
  std::array<std::optional<std::vector<std::uint8_t>>, kPdosPerDirection> held_;
  std::array<Transmit, kPdosPerDirection> transmit_;
  std::array<std::optional<std::int64_t>, kPdosPerDirection> received_us_;
  PdoCounts counts_;
};

}  // namespace strainwave::can_nodes
