// SPDX-License-Identifier: BSD-3-Clause
// What was heard on LCM as an MCAP file: each channel of ours a topic, each message JSON. Orders' signatures and gain tables are left
// out. Not real-time.
#pragma once

#include <map>
#include <span>

#include "client/text/mcap_writer.h"
#include "lcmtypes/channels.h"

namespace strainwave {

class McapLog {
 public:
  /// Throws InputError when `file` cannot be written; an existing one is replaced.
  explicit McapLog(const std::filesystem::path& file);

  /// One message as LCM delivered it at `received_us` since the epoch. False: it is none of ours, or malformed.
  bool take(const ChannelName& name, const std::string& channel, std::int64_t received_us,
            std::span<const std::uint8_t> data);

  /// Throws InputError when anything was lost.
  void finish() { writer_.finish(); }
  std::uint64_t messages() const noexcept { return writer_.messages(); }
  bool good() const noexcept { return writer_.good(); }

 private:
  McapWriter writer_;
  std::map<std::string, std::uint16_t> channels_;
};

}  // namespace strainwave
