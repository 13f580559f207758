// SPDX-License-Identifier: BSD-3-Clause
// Event logs for tests, written byte by byte. The code is independent of the writer under test.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "lcmtypes/wire.h"

namespace strainwave::testing {

inline constexpr std::uint32_t kLogSyncWord = 0xEDA1DA01;

class EventLogFile {
 public:
  explicit EventLogFile(const std::filesystem::path& path) : file_(path, std::ios::binary) {}

  template <typename Message>
  void add(std::int64_t received_us, std::string_view channel, const Message& message) {
    add_bytes(received_us, channel, encode(message));
  }
  void add_bytes(std::int64_t received_us, std::string_view channel, const std::vector<std::uint8_t>& bytes) {
    put(kLogSyncWord, 4);
    put(static_cast<std::uint64_t>(number_++), 8);
    put(static_cast<std::uint64_t>(received_us), 8);
    put(channel.size(), 4);
    put(bytes.size(), 4);
    file_ << channel;
    for (const std::uint8_t byte : bytes) file_.put(static_cast<char>(byte));
    file_.flush();
  }
  /// The last `bytes` bytes of a big-endian number.
  void put(std::uint64_t value, int bytes) {
    for (int i = bytes - 1; i >= 0; --i) file_.put(static_cast<char>(value >> (8 * i) & 0xFFU));
    file_.flush();
  }

 private:
  std::ofstream file_;
  std::int64_t number_ = 0;
};

}  // namespace strainwave::testing
