// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/can_nodes/object_dictionary.h"

#include "tests/support/can_nodes/frame.h"

namespace strainwave::can_nodes {

namespace {

bool is_signed(DataType type) {
  return type == DataType::kInteger8 || type == DataType::kInteger16 || type == DataType::kInteger32;
}

std::int64_t number_of(DataType type, std::span<const std::uint8_t> bytes) {
  const std::uint64_t raw = little_endian(bytes);
  if (!is_signed(type)) return static_cast<std::int64_t>(raw);
  const std::size_t unused_bits = 64 - 8 * bytes.size();
  return static_cast<std::int64_t>(raw << unused_bits) >> unused_bits;
}

}  // namespace

std::size_t size_of(DataType type) {
  switch (type) {
    case DataType::kInteger8:
    case DataType::kUnsigned8:
      return 1;
    case DataType::kInteger16:
    case DataType::kUnsigned16:
      return 2;
    case DataType::kInteger32:
    case DataType::kUnsigned32:
    case DataType::kReal32:
      return 4;
    case DataType::kVisibleString:
      break;
  }
  return 0;
}

void ObjectDictionary::add(Key key, Object object) {
  defaults_[key] = object.value;
  objects_[key] = std::move(object);
}

void ObjectDictionary::guard(std::uint16_t first, std::uint16_t last, Guard guard) {
  guards_.push_back({first, last, std::move(guard)});
}

const Object* ObjectDictionary::find(Key key) const {
  const auto found = objects_.find(key);
  return found == objects_.end() ? nullptr : &found->second;
}

Abort ObjectDictionary::missing(Key key) const {
  const auto next = objects_.lower_bound({key.index, 0});
  return next != objects_.end() && next->first.index == key.index ? Abort::kNoSubIndex : Abort::kNoObject;
}

std::int64_t ObjectDictionary::shown(Key key) const {
  const auto pretended = pretended_.find(key);
  return pretended != pretended_.end() ? pretended->second : number(key);
}

Abort ObjectDictionary::read(Key key, std::vector<std::uint8_t>& bytes) const {
  const Object* object = find(key);
  if (object == nullptr) return missing(key);
  bytes.clear();
  if (object->type == DataType::kVisibleString) {
    bytes.assign(object->text.begin(), object->text.end());
  } else {
    append_little_endian(bytes, static_cast<std::uint64_t>(shown(key)), size_of(object->type));
  }
  return Abort::kNone;
}

Abort ObjectDictionary::write(Key key, std::span<const std::uint8_t> bytes) {
  const auto found = objects_.find(key);
  if (found == objects_.end()) return missing(key);
  Object& object = found->second;
  if (object.access != Access::kReadWrite) return Abort::kReadOnly;
  const std::size_t size = size_of(object.type);
  if (bytes.size() > size) return Abort::kLengthTooHigh;
  if (bytes.size() < size) return Abort::kLengthTooLow;
  const std::int64_t value = number_of(object.type, bytes);
  if (value > object.high) return Abort::kValueTooHigh;
  if (value < object.low) return Abort::kValueTooLow;
  for (const GuardedRange& range : guards_) {
    if (key.index < range.first || key.index > range.last) continue;
    if (const Abort refused = range.guard(key, value); refused != Abort::kNone) return refused;
  }
  object.value = value;
  if (listener_) listener_(key);
  return Abort::kNone;
}

void ObjectDictionary::restore(std::uint16_t first, std::uint16_t last) {
  for (auto& [key, object] : objects_)
    if (key.index >= first && key.index <= last) object.value = defaults_.at(key);
}

}  // namespace strainwave::can_nodes
