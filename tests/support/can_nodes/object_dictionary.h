// SPDX-License-Identifier: BSD-3-Clause
// The object dictionary of a simulated CANopen node: typed objects with access rights and ranges, and the
// abort codes of refused accesses. Source: CiA 301 (4.2.0), 7.4 and table 22.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace strainwave::can_nodes {

/// The numbers of the data types, which PDO mapping and EDS files also use.
enum class DataType : std::uint16_t {
  kInteger8 = 0x02,
  kInteger16 = 0x03,
  kInteger32 = 0x04,
  kUnsigned8 = 0x05,
  kUnsigned16 = 0x06,
  kUnsigned32 = 0x07,
  kReal32 = 0x08,
  kVisibleString = 0x09,
};

/// SDO abort codes.
enum class Abort : std::uint32_t {
  kNone = 0,
  kToggleBit = 0x05030000,
  kUnknownCommand = 0x05040001,
  kUnsupportedAccess = 0x06010000,
  kWriteOnly = 0x06010001,
  kReadOnly = 0x06010002,
  kNoObject = 0x06020000,
  kNotMappable = 0x06040041,
  kPdoLength = 0x06040042,
  kLength = 0x06070010,
  kLengthTooHigh = 0x06070012,
  kLengthTooLow = 0x06070013,
  kNoSubIndex = 0x06090011,
  kInvalidValue = 0x06090030,
  kValueTooHigh = 0x06090031,
  kValueTooLow = 0x06090032,
  kGeneral = 0x08000000,
  kDeviceState = 0x08000022,
};

enum class Access : std::uint8_t { kConstant, kReadOnly, kReadWrite };
enum class Mappable : std::uint8_t { kNo, kReceive, kTransmit, kBoth };

struct Key {
  std::uint16_t index = 0;
  std::uint8_t sub = 0;
  auto operator<=>(const Key&) const = default;
};

struct Object {
  DataType type = DataType::kUnsigned32;
  Access access = Access::kReadWrite;
  std::int64_t value = 0;  ///< numbers; bits of a REAL32
  Mappable mappable = Mappable::kNo;
  std::int64_t low = std::numeric_limits<std::int64_t>::min();  ///< lowest value that may be written
  std::int64_t high = std::numeric_limits<std::int64_t>::max();
  std::string text{};  ///< of a VISIBLE_STRING
};

/// Size in bytes of a number of this type; 0 for a string.
std::size_t size_of(DataType type);

class ObjectDictionary {
 public:
  /// Decides before a write whether `value` may be written now.
  using Guard = std::function<Abort(Key, std::int64_t value)>;
  /// Called after `key` was written from the bus.
  using Listener = std::function<void(Key)>;

  void add(Key key, Object object);
  /// Removes an object that the device does not have. Guards of it have no effect.
  void remove(std::uint16_t index) {
    std::erase_if(objects_, [index](const auto& object) { return object.first.index == index; });
  }
  /// Makes the object read-only from the bus.
  void make_read_only(Key key) { objects_.at(key).access = Access::kReadOnly; }
  void guard(std::uint16_t first, std::uint16_t last, Guard guard);
  void listen(Listener listener) { listener_ = std::move(listener); }

  /// Access from the bus, with all checks.
  Abort read(Key key, std::vector<std::uint8_t>& bytes) const;
  Abort write(Key key, std::span<const std::uint8_t> bytes);

  const Object* find(Key key) const;
  /// Access from the device itself. Without the object, it reads 0 and sets nothing.
  std::int64_t number(Key key) const {
    const Object* object = find(key);
    return object == nullptr ? 0 : object->value;
  }
  void set(Key key, std::int64_t value) {
    if (const auto found = objects_.find(key); found != objects_.end()) found->second.value = value;
  }

  /// From now on, every reader on the bus gets this value of the object.
  void pretend(Key key, std::int64_t value) { pretended_[key] = value; }
  void pretend_nothing() { pretended_.clear(); }
  /// The value that a reader on the bus gets.
  std::int64_t shown(Key key) const;

  /// Restores the added values, for the indices from `first` to `last`.
  void restore(std::uint16_t first, std::uint16_t last);

 private:
  Abort missing(Key key) const;

  struct GuardedRange {
    std::uint16_t first;
    std::uint16_t last;
    Guard guard;
  };

  std::map<Key, Object> objects_;
  std::map<Key, std::int64_t> defaults_;
  std::map<Key, std::int64_t> pretended_;
  std::vector<GuardedRange> guards_;
  Listener listener_;
};

}  // namespace strainwave::can_nodes
