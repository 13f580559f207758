// A drive's electronic data sheet: which entries its object dictionary has, of what type, who may write and map them, and what
// they hold when it starts. Read strictly: what is not understood is refused with its line. Not real-time. Source: CiA 306-1.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "drivers/can/canopen/canopen_sdo.h"

namespace strainwave::canopen {

struct EdsEntry {
  std::string name;
  std::size_t bytes = 0;  ///< of a number; 0: text or a block of data
  bool is_signed = false;
  bool readable = true;
  bool writable = false;
  bool mappable = false;
  std::optional<std::int64_t> value;  ///< DefaultValue, the node id added where it says so
  std::optional<std::int64_t> low;
  std::optional<std::int64_t> high;
};

struct EdsFile {
  std::string file;  ///< for messages
  std::map<Entry, EdsEntry> entries;

  const EdsEntry* find(Entry entry) const noexcept;
  /// Whether any sub-index of `index` is there.
  bool has_index(std::uint16_t index) const noexcept;
};

/// Throws InputError naming file, line and what is wrong. `node_id` is what $NODEID stands for.
EdsFile parse_eds(const std::string& file, std::string_view text, std::uint8_t node_id);
EdsFile read_eds(const std::filesystem::path& path, std::uint8_t node_id);

}  // namespace strainwave::canopen
