// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/can_nodes/pdo_table.h"

#include <algorithm>

namespace strainwave::can_nodes {

namespace {

constexpr std::uint16_t kReceiveCommunication = 0x1400;
constexpr std::uint16_t kReceiveMapping = 0x1600;
constexpr std::uint16_t kTransmitCommunication = 0x1800;
constexpr std::uint16_t kTransmitMapping = 0x1A00;
constexpr std::int64_t kDisabled = 0x80000000;
constexpr std::int64_t kExtendedId = 0x20000000;
constexpr std::int64_t kIdMask = 0x7FF;
constexpr std::int64_t kLastSynchronousType = 240;

std::uint16_t plus(std::uint16_t first, int n) {
  return static_cast<std::uint16_t>(first + n);
}

// CiA 301, 7.3.5: identifiers that no PDO may have.
bool restricted(std::int64_t id) {
  return id <= 0x7F || (id >= 0x101 && id <= 0x180) || (id >= 0x581 && id <= 0x5FF) ||
         (id >= 0x601 && id <= 0x67F) || id >= 0x6E0;
}

// A mapping entry is index, sub-index and length in bits.
Key key_of_entry(std::int64_t entry) {
  return {static_cast<std::uint16_t>(entry >> 16), static_cast<std::uint8_t>(entry >> 8)};
}

bool fits_direction(Mappable mappable, bool receive) {
  return mappable == Mappable::kBoth || mappable == (receive ? Mappable::kReceive : Mappable::kTransmit);
}

}  // namespace

PdoTable::PdoTable(ObjectDictionary& dictionary, std::uint8_t node_id)
    : dictionary_(dictionary), node_id_(node_id) {
  add_objects(kReceiveCommunication, kReceiveMapping, 0x200);
  add_objects(kTransmitCommunication, kTransmitMapping, 0x180);
  const auto with_default = [&](std::uint16_t communication, std::uint16_t mapping, std::uint16_t object) {
    Object id = *dictionary_.find({communication, 1});
    id.value &= ~kDisabled;
    dictionary_.add({communication, 1}, id);
    dictionary_.add({mapping, 0}, {DataType::kUnsigned8, Access::kReadWrite, 1});
    dictionary_.add({mapping, 1},
                    {DataType::kUnsigned32, Access::kReadWrite, (std::int64_t{object} << 16) | 16});
  };
  with_default(kReceiveCommunication, kReceiveMapping, 0x6040);
  with_default(kTransmitCommunication, kTransmitMapping, 0x6041);

  for (const std::uint16_t first : {kReceiveCommunication, kTransmitCommunication})
    dictionary_.guard(first, plus(first, kPdosPerDirection - 1),
                      [this](Key key, std::int64_t value) { return check_communication(key, value); });
  for (const std::uint16_t first : {kReceiveMapping, kTransmitMapping})
    dictionary_.guard(first, plus(first, kPdosPerDirection - 1),
                      [this](Key key, std::int64_t value) { return check_mapping(key, value); });
}

void PdoTable::add_objects(std::uint16_t communication, std::uint16_t mapping, std::uint32_t first_id) {
  for (int n = 0; n < kPdosPerDirection; ++n) {
    const std::uint16_t parameter = plus(communication, n);
    const std::int64_t id = first_id + static_cast<std::uint32_t>(n) * 0x100 + node_id_;
    dictionary_.add({parameter, 0}, {DataType::kUnsigned8, Access::kConstant, 5});
    dictionary_.add({parameter, 1}, {DataType::kUnsigned32, Access::kReadWrite, id | kDisabled});
    dictionary_.add({parameter, 2}, {DataType::kUnsigned8, Access::kReadWrite, 255});
    dictionary_.add({parameter, 3}, {DataType::kUnsigned16});
    dictionary_.add({parameter, 5}, {DataType::kUnsigned16});
    dictionary_.add({plus(mapping, n), 0}, {DataType::kUnsigned8});
    for (int i = 1; i <= kMaxMappedObjects; ++i)
      dictionary_.add({plus(mapping, n), static_cast<std::uint8_t>(i)}, {DataType::kUnsigned32});
  }
}

bool PdoTable::enabled(std::uint16_t communication) const {
  return (dictionary_.number({communication, 1}) & kDisabled) == 0;
}

std::uint32_t PdoTable::id_of(std::uint16_t communication) const {
  return static_cast<std::uint32_t>(dictionary_.number({communication, 1}) & kIdMask);
}

Abort PdoTable::check_communication(Key key, std::int64_t value) const {
  switch (key.sub) {
    case 1: {
      // An enabled PDO keeps its identifier. It must be disabled first, without a change of the identifier.
      if (enabled(key.index) && (dictionary_.number(key) & kIdMask) != (value & kIdMask))
        return Abort::kInvalidValue;
      if ((value & kDisabled) != 0) return Abort::kNone;
      if ((value & kExtendedId) != 0 || restricted(value & kIdMask)) return Abort::kInvalidValue;
      return configurable_ ? Abort::kNone : Abort::kDeviceState;
    }
    case 2:
      return value <= kLastSynchronousType || value >= 254 ? Abort::kNone : Abort::kInvalidValue;
    case 3:
      return enabled(key.index) ? Abort::kDeviceState : Abort::kNone;
    default:
      return Abort::kNone;
  }
}

Abort PdoTable::check_mapping(Key key, std::int64_t value) const {
  if (!configurable_) return Abort::kDeviceState;
  // 1600h belongs to 1400h, 1A00h to 1800h. A PDO that cannot be disabled is changed while enabled.
  const auto communication = static_cast<std::uint16_t>(key.index - 0x200);
  if (enabled(communication) && dictionary_.find({communication, 1})->access == Access::kReadWrite)
    return Abort::kUnsupportedAccess;
  if (key.sub != 0) {
    if (dictionary_.number({key.index, 0}) != 0) return Abort::kUnsupportedAccess;
    return check_entry(key, value);
  }
  if (value > kMaxMappedObjects) return Abort::kPdoLength;
  std::size_t bytes = 0;
  for (std::int64_t i = 1; i <= value; ++i) {
    const Key entry{key.index, static_cast<std::uint8_t>(i)};
    if (const Abort wrong = check_entry(entry, dictionary_.number(entry)); wrong != Abort::kNone)
      return wrong;
    bytes += size_of(dictionary_.find(key_of_entry(dictionary_.number(entry)))->type);
  }
  return bytes <= 8 ? Abort::kNone : Abort::kPdoLength;
}

Abort PdoTable::check_entry(Key key, std::int64_t value) const {
  const Object* object = dictionary_.find(key_of_entry(value));
  if (object == nullptr || !fits_direction(object->mappable, key.index < kTransmitMapping))
    return Abort::kNotMappable;
  const bool right_length = static_cast<std::size_t>(value & 0xFF) == 8 * size_of(object->type);
  return right_length ? Abort::kNone : Abort::kNotMappable;
}

std::vector<Key> PdoTable::mapped(std::uint16_t mapping) const {
  std::vector<Key> keys;
  for (std::int64_t i = 1; i <= dictionary_.number({mapping, 0}); ++i)
    keys.push_back(key_of_entry(dictionary_.number({mapping, static_cast<std::uint8_t>(i)})));
  return keys;
}

std::vector<std::uint8_t> PdoTable::pack(std::uint16_t mapping) const {
  std::vector<std::uint8_t> bytes;
  for (const Key key : mapped(mapping))
    append_little_endian(bytes, static_cast<std::uint64_t>(dictionary_.shown(key)),
                         size_of(dictionary_.find(key)->type));
  return bytes;
}

void PdoTable::unpack(std::uint16_t mapping, std::span<const std::uint8_t> bytes) {
  for (const Key key : mapped(mapping)) {
    const std::size_t size = size_of(dictionary_.find(key)->type);
    // A value out of its range is dropped, as in a drive: a PDO has no answer.
    static_cast<void>(dictionary_.write(key, bytes.first(size)));
    bytes = bytes.subspan(size);
  }
}

std::optional<std::int64_t> PdoTable::rpdo_deadline_us() const {
  std::optional<std::int64_t> first_us;
  for (int n = 0; n < kPdosPerDirection; ++n) {
    const std::uint16_t communication = plus(kReceiveCommunication, n);
    const std::int64_t timer_us = dictionary_.number({communication, 5}) * 1000;
    const auto& received_us = received_us_[static_cast<std::size_t>(n)];
    if (enabled(communication) && timer_us > 0 && received_us)
      first_us = std::min(first_us.value_or(INT64_MAX), *received_us + timer_us);
  }
  return first_us;
}

Reception PdoTable::receive(const Frame& frame, std::int64_t now_us) {
  for (int n = 0; n < kPdosPerDirection; ++n) {
    const std::uint16_t communication = plus(kReceiveCommunication, n);
    if (!enabled(communication) || id_of(communication) != frame.id) continue;
    const std::uint16_t mapping = plus(kReceiveMapping, n);
    std::size_t needed = 0;
    for (const Key key : mapped(mapping)) needed += size_of(dictionary_.find(key)->type);
    if (frame.length < needed) return Reception::kTooShort;
    ++counts_.received;
    received_us_[static_cast<std::size_t>(n)] = now_us;
    if (type_of(communication) > kLastSynchronousType) {
      unpack(mapping, frame.bytes().first(needed));
    } else {
      auto& held = held_[static_cast<std::size_t>(n)];
      if (held) ++counts_.superseded;
      held = std::vector<std::uint8_t>(frame.data.begin(),
                                       frame.data.begin() + static_cast<std::ptrdiff_t>(needed));
    }
    return frame.length > needed ? Reception::kTooLong : Reception::kTaken;
  }
  return Reception::kNotMine;
}

void PdoTable::use_held() {
  for (int n = 0; n < kPdosPerDirection; ++n) {
    auto& held = held_[static_cast<std::size_t>(n)];
    const std::uint16_t communication = plus(kReceiveCommunication, n);
    if (!enabled(communication) || type_of(communication) > kLastSynchronousType) continue;
    if (held)
      unpack(plus(kReceiveMapping, n), *held);
    else
      ++counts_.syncs_without_rpdo;
    held.reset();
  }
}

std::vector<Frame> PdoTable::due_at_sync() {
  std::vector<Frame> frames;
  for (int n = 0; n < kPdosPerDirection; ++n) {
    const std::uint16_t communication = plus(kTransmitCommunication, n);
    Transmit& transmit = transmit_[static_cast<std::size_t>(n)];
    const std::int64_t type = type_of(communication);
    if (!enabled(communication) || type > kLastSynchronousType) continue;
    std::vector<std::uint8_t> bytes = pack(plus(kTransmitMapping, n));
    // Type 0: with the next SYNC after a change. Type n: with every n-th SYNC.
    const bool due = type == 0 ? transmit.last != bytes : ++transmit.syncs >= type;
    if (!due) continue;
    transmit.syncs = 0;
    frames.emplace_back(id_of(communication), bytes);
    transmit.last = std::move(bytes);
    ++counts_.transmitted;
  }
  return frames;
}

std::vector<Frame> PdoTable::due_by_event(std::int64_t now_us) {
  std::vector<Frame> frames;
  for (int n = 0; n < kPdosPerDirection; ++n) {
    const std::uint16_t communication = plus(kTransmitCommunication, n);
    Transmit& transmit = transmit_[static_cast<std::size_t>(n)];
    if (!enabled(communication) || type_of(communication) <= kLastSynchronousType) continue;
    const std::int64_t since_us = now_us - transmit.sent_us;
    const std::int64_t inhibit_us = dictionary_.number({communication, 3}) * 100;
    const std::int64_t timer_us = dictionary_.number({communication, 5}) * 1000;
    std::vector<std::uint8_t> bytes = pack(plus(kTransmitMapping, n));
    const bool first = !transmit.last;
    const bool changed = transmit.last != bytes && since_us >= inhibit_us;
    const bool timer = timer_us > 0 && since_us >= timer_us;
    if (!(first || changed || timer)) continue;
    frames.emplace_back(id_of(communication), bytes);
    transmit.last = std::move(bytes);
    transmit.sent_us = now_us;
    ++counts_.transmitted;
  }
  return frames;
}

void PdoTable::begin() {
  held_ = {};
  transmit_ = {};
  received_us_ = {};
}

}  // namespace strainwave::can_nodes
