// SPDX-License-Identifier: BSD-3-Clause
// A drive's electronic data sheet (EDS), or the device configuration file (DCF) made from one: which entries its object dictionary
// has, of what type, who may write and map them, and what they hold. Vendors' files differ from the standard in many ways. What
// cannot be read is noted with the entry, for the reader of that entry to judge. Not real-time. Source: CiA 306-1.
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
  std::optional<std::int64_t>
      value;  ///< ParameterValue (DCF), else DefaultValue, with the node id where it says so
  std::optional<std::int64_t> low;  ///< unset as well where the type has no such number
  std::optional<std::int64_t> high;
  std::string unclear;  ///< what of it could not be read, with its line; empty: nothing
};

struct EdsFile {
  std::string file;          ///< for messages
  std::uint8_t node_id = 0;  ///< a DCF is that of one node, an EDS whatever it was read for
  std::map<Entry, EdsEntry> entries;

  const EdsEntry* find(Entry entry) const noexcept;
  /// Whether any sub-index of `index` is there.
  bool has_index(std::uint16_t index) const noexcept;
};

/// `node_id` is what $NODEID stands for, unless the file is a DCF. Throws InputError naming the file when it has no objects or is larger than 4 MiB.
EdsFile parse_eds(const std::string& file, std::string_view text, std::uint8_t node_id);
EdsFile read_eds(const std::filesystem::path& path, std::uint8_t node_id);

}  // namespace strainwave::canopen
