// SPDX-License-Identifier: BSD-3-Clause
// The PDOs of a simulated CANopen node: four each way, configured through the object dictionary by the rules
// of the standard (disable, count 0, map, count, enable; anything else is refused). Source: CiA 301 (4.2.0),
// 7.2.2 and 7.5.2.35 to 7.5.2.38.
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

/// What happened since the last clear_counts().
struct PdoCounts {
  long received = 0;
  long superseded = 0;          ///< a second RPDO before the SYNC that should have used the first
  long syncs_without_rpdo = 0;  ///< a synchronous RPDO is enabled and none came since the last SYNC
  long transmitted = 0;
};

class PdoTable {
 public:
  /// Adds 1400h.., 1600h.., 1800h.. and 1A00h.. to `dictionary`. Every PDO begins disabled and unmapped, but
  /// for the profile's first ones: controlword in, statusword out.
  PdoTable(ObjectDictionary& dictionary, std::uint8_t node_id);

  /// Whether the node is in a state that lets PDOs be configured.
  void set_configurable(bool configurable) { configurable_ = configurable; }

  Reception receive(const Frame& frame, std::int64_t now_us = 0);
  /// When the first deadline of an RPDO passes that has come since begin(); the deadline begins with the first.
  std::optional<std::int64_t> rpdo_deadline_us() const;
  /// It was missed, and has been told: it begins again with the next one.
  void forget_rpdos() { received_us_ = {}; }
  /// A SYNC came: uses the synchronous RPDOs that were held for it.
  void use_held();
  /// A SYNC came: the TPDOs that are due with it, as the dictionary is now.
  std::vector<Frame> due_at_sync();
  /// The event-driven TPDOs that are due.
  std::vector<Frame> due_by_event(std::int64_t now_us);
  /// The node became operational: what was held is stale, event-driven TPDOs are due at once.
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
