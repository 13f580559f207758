// SPDX-License-Identifier: BSD-3-Clause
// Reads LCM's event log (lcm-logger, strainwavectl record) event by event. The file is untrusted. liblcm's
// own reader ends the program on a wrong length; this reader skips damaged bytes and counts them. Not
// real-time; needs no LCM library.
//
// An event: sync word 0xEDA1DA01, int64 number, int64 time of receipt in us since the epoch, int32 length of
// the channel's name, int32 length of the data, name, data; all big-endian. Source: liblcm's lcm/eventlog.h
// and eventlog.c.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace strainwave {

struct LogEvent {
  std::int64_t number = 0;
  std::int64_t received_us = 0;  ///< since the epoch, by the recorder's clock
  std::string channel;
  std::vector<std::uint8_t> data;
};

/// Parts of a log that were skipped, since they hold no event.
struct LogDamage {
  std::uint64_t skipped_bytes = 0;
  int places = 0;
  std::uint64_t first_byte = 0;  ///< of the first place, from the file's beginning
};

class EventLogReader {
 public:
  /// LCM's own limit for one message is below this.
  static constexpr std::uint32_t kMaxData = 16u << 20;

  /// Throws InputError when the file cannot be opened.
  explicit EventLogReader(const std::filesystem::path& file);

  /// Reads the next event, and skips damage before it: see damage(). Returns false at the end, also when the last event
  /// is cut off (the recorder was killed): see truncated(). Throws InputError when the whole file holds no event.
  bool next(LogEvent& event);
  bool truncated() const noexcept { return truncated_; }
  const LogDamage& damage() const noexcept { return damage_; }

 private:
  struct Header {
    std::int64_t number = 0;
    std::int64_t received_us = 0;
    std::uint32_t channel_bytes = 0;
    std::uint32_t data_bytes = 0;
  };
  enum class Found { kEvent, kCutOff, kDamage, kEnd };

  std::string_view bytes_at(std::uint64_t offset, std::uint64_t count);
  Found look(Header& header);
  Found cut_off();
  std::optional<std::uint64_t> sync_word_between(std::uint64_t from, std::uint64_t to);
  void skip();
  void read_body(const Header& header, LogEvent& event);
  void refuse_what_is_no_log();

  std::string name_;
  std::ifstream file_;
  std::uint64_t size_ = 0;
  std::string buffer_;           ///< a part of the file
  std::uint64_t buffer_at_ = 0;  ///< where it begins in the file
  std::uint64_t offset_ = 0;     ///< position of the event that is read next
  bool any_ = false;             ///< at least one event was read
  bool truncated_ = false;
  LogDamage damage_;
};

/// Throws InputError if parts were skipped, for programs that need every event. Call it at the end.
void require_undamaged(const EventLogReader& reader, const std::filesystem::path& file);

}  // namespace strainwave
