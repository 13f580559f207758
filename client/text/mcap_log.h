// SPDX-License-Identifier: BSD-3-Clause
// LCM messages as an MCAP file: each Strainwave channel is a topic, each message is JSON. Signatures of
// orders and gain tables are left out. Not real-time.
#pragma once

#include <map>
#include <span>

#include "client/text/mcap_writer.h"
#include "lcmtypes/channels.h"

namespace strainwave {

class McapLog {
 public:
  /// Throws InputError when `file` cannot be written. An existing file is replaced.
  explicit McapLog(const std::filesystem::path& file);

  /// Takes one message that LCM delivered at `received_us` since the epoch. Returns false if it is malformed or not of Strainwave.
  bool take(const ChannelName& name, const std::string& channel, std::int64_t received_us,
            std::span<const std::uint8_t> data);

  /// Throws InputError when any data was lost.
  void finish() { writer_.finish(); }
  std::uint64_t messages() const noexcept { return writer_.messages(); }
  bool good() const noexcept { return writer_.good(); }

 private:
  McapWriter writer_;
  std::map<std::string, std::uint16_t> channels_;
};

}  // namespace strainwave
