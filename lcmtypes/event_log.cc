#include "lcmtypes/event_log.h"

#include <array>

#include "base/input_error.h"
#include "lcmtypes/channels.h"

namespace strainwave {

namespace {
constexpr std::uint32_t kSyncWord = 0xEDA1DA01;
/// 0x89, "MCA" of its first bytes.
constexpr std::uint32_t kMcapMagic = 0x894D4341;
constexpr std::uint64_t kHeaderBytes = 4 + 8 + 8 + 4 + 4;
}  // namespace

EventLogReader::EventLogReader(const std::filesystem::path& file)
    : name_(file.string()), file_(file, std::ios::binary) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) throw InputError(name_ + ": is a folder, not a file");
  if (!file_) throw InputError(name_ + ": cannot be read: is it there, and may you read it?");
}

// Big-endian, as everything on LCM's wire.
template <typename Integer>
bool EventLogReader::read(Integer& value) {
  std::array<char, sizeof(Integer)> bytes{};
  if (!file_.read(bytes.data(), bytes.size())) return false;
  std::uint64_t bits = 0;
  for (const char byte : bytes) bits = bits << 8 | static_cast<std::uint8_t>(byte);
  value = static_cast<Integer>(bits);
  return true;
}

void EventLogReader::refuse(const std::string& why) const {
  throw InputError(name_ + ": at byte " + std::to_string(offset_) + ": " + why +
                   "; an LCM event log is expected, as strainwavectl record and lcm-logger write it");
}

bool EventLogReader::next(LogEvent& event) {
  if (file_.peek() == std::ifstream::traits_type::eof()) return false;
  truncated_ = true;  // until the event is whole
  std::uint32_t sync_word = 0, channel_bytes = 0, data_bytes = 0;
  if (!read(sync_word)) return false;
  if (sync_word == kMcapMagic && offset_ == 0)
    refuse(
        "this is an MCAP file, which viewers read and nothing turns back; give the log that it was exported "
        "from");
  if (sync_word != kSyncWord) refuse("no event begins here");
  if (!read(event.number) || !read(event.received_us) || !read(channel_bytes) || !read(data_bytes))
    return false;
  if (channel_bytes == 0 || channel_bytes > kMaxChannelLength)
    refuse("a channel's name of " + std::to_string(channel_bytes) + " bytes");
  if (data_bytes > kMaxData) refuse("a message of " + std::to_string(data_bytes) + " bytes");
  event.channel.resize(channel_bytes);
  event.data.resize(data_bytes);
  if (!file_.read(event.channel.data(), static_cast<std::streamsize>(channel_bytes))) return false;
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): bytes into bytes
  if (!file_.read(reinterpret_cast<char*>(event.data.data()), static_cast<std::streamsize>(data_bytes)))
    return false;
  truncated_ = false;
  offset_ += kHeaderBytes + channel_bytes + data_bytes;
  return true;
}

}  // namespace strainwave
