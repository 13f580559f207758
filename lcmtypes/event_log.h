// LCM's event log (lcm-logger, strainwavectl record), read event by event. The file is untrusted: liblcm's
// own reader ends the program on a wrong length, this one throws. Not real-time; needs no LCM library.
//
// An event: sync word 0xEDA1DA01, int64 number, int64 time of receipt in us since the epoch, int32 length of
// the channel's name, int32 length of the data, name, data; all big-endian. Source: liblcm's lcm/eventlog.h
// and eventlog.c.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace strainwave {

struct LogEvent {
  std::int64_t number = 0;
  std::int64_t received_us = 0;  ///< since the epoch, by the recorder's clock
  std::string channel;
  std::vector<std::uint8_t> data;
};

class EventLogReader {
 public:
  /// LCM's own limit of one message is below this.
  static constexpr std::uint32_t kMaxData = 16u << 20;

  /// Throws InputError when the file cannot be opened.
  explicit EventLogReader(const std::filesystem::path& file);

  /// The next event. False at the end, also when the last event is cut off (the recorder was killed): see
  /// truncated(). Throws InputError naming file and byte when it is no event log.
  bool next(LogEvent& event);
  bool truncated() const noexcept { return truncated_; }

 private:
  template <typename Integer>
  bool read(Integer& value);
  [[noreturn]] void refuse(const std::string& why) const;

  std::string name_;
  std::ifstream file_;
  std::uint64_t offset_ = 0;  ///< of the event that is read
  bool truncated_ = false;
};

}  // namespace strainwave
