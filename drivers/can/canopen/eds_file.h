// SPDX-License-Identifier: BSD-3-Clause
// A drive's electronic data sheet (EDS), or a device configuration file (DCF): the entries of its object dictionary
// with type, access, mapping and value. Vendors' files differ from the standard in many ways. Text that cannot be read
// is noted with its entry, and the user of that entry decides. Not real-time. Source: CiA 306-1.
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
  std::optional<std::int64_t> value;  ///< ParameterValue (DCF), else DefaultValue; $NODEID is replaced
  std::optional<std::int64_t> low;    ///< empty as well where the type is not a whole number
  std::optional<std::int64_t> high;
  std::string unclear;  ///< what could not be read, with its line; empty: nothing
};

struct EdsFile {
  std::string file;          ///< for messages
  std::uint8_t node_id = 0;  ///< from the DCF, or the argument of read_eds()
  std::map<Entry, EdsEntry> entries;

  const EdsEntry* find(Entry entry) const noexcept;
  /// Returns whether any sub-index of `index` exists.
  bool has_index(std::uint16_t index) const noexcept;
};

/// `node_id` replaces $NODEID, unless the file is a DCF. Throws InputError with the file when it has no objects or is larger than 4 MiB.
EdsFile parse_eds(const std::string& file, std::string_view text, std::uint8_t node_id);
EdsFile read_eds(const std::filesystem::path& path, std::uint8_t node_id);

}  // namespace strainwave::canopen
