// SPDX-License-Identifier: BSD-3-Clause
#include "lcmtypes/event_log.h"

#include <algorithm>
#include <array>
#include <bit>
#include <string_view>

#include "base/input_error.h"
#include "lcmtypes/channels.h"

namespace strainwave {

namespace {
constexpr std::string_view kSyncWord = "\xED\xA1\xDA\x01";
constexpr std::string_view kMcapMagic = "\x89MCA";
constexpr std::uint64_t kHeaderBytes = 4 + 8 + 8 + 4 + 4;
/// Least number of bytes that are read at once. Any size works; 64 KiB holds about fifty states.
constexpr std::uint64_t kReadBytes = 1U << 16;

// Removes a number from the front of `bytes`; LCM's numbers are big-endian.
template <typename Integer>
Integer take(std::string_view& bytes) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < sizeof(Integer); ++i) bits = bits << 8 | static_cast<std::uint8_t>(bytes[i]);
  bytes.remove_prefix(sizeof(Integer));
  return static_cast<Integer>(bits);
}

}  // namespace

EventLogReader::EventLogReader(const std::filesystem::path& file)
    : name_(file.string()), file_(file, std::ios::binary) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) throw InputError(name_ + ": is a folder, not a file");
  if (!file_) throw InputError(name_ + ": cannot be read: is it there, and may you read it?");
  size_ = std::filesystem::file_size(file, error);
  if (error) throw InputError(name_ + ": is not a regular file: copy it to one first");
}

/// Returns `count` bytes from `offset` on, or fewer at the end of the file. They are valid until the next call.
std::string_view EventLogReader::bytes_at(std::uint64_t offset, std::uint64_t count) {
  if (offset < buffer_at_ || offset + count > buffer_at_ + buffer_.size()) {
    buffer_.resize(std::min(std::max(count, kReadBytes), size_ - std::min(offset, size_)));
    buffer_at_ = offset;
    file_.clear();
    file_.seekg(static_cast<std::streamoff>(offset));
    file_.read(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    buffer_.resize(static_cast<std::size_t>(file_.gcount()));
  }
  return std::string_view(buffer_).substr(offset - buffer_at_, count);
}

/// Returns the first place of a sync word that begins at `from` or later and ends at `to` or before.
std::optional<std::uint64_t> EventLogReader::sync_word_between(std::uint64_t from, std::uint64_t to) {
  while (from + kSyncWord.size() <= to) {
    const std::string_view bytes = bytes_at(from, std::min(kReadBytes, to - from));
    if (const auto at = bytes.find(kSyncWord); at != std::string_view::npos) return from + at;
    if (bytes.size() < kSyncWord.size()) return std::nullopt;
    from += bytes.size() - (kSyncWord.size() - 1);  // a sync word may span two reads
  }
  return std::nullopt;
}

/// Judges an event that reaches beyond the file's end. It is cut off, unless a sync word follows: then its length is damaged.
EventLogReader::Found EventLogReader::cut_off() {
  return sync_word_between(offset_ + 1, size_) ? Found::kDamage : Found::kCutOff;
}

EventLogReader::Found EventLogReader::look(Header& header) {
  if (offset_ >= size_) return Found::kEnd;
  std::string_view bytes = bytes_at(offset_, kHeaderBytes);
  if (!kSyncWord.starts_with(bytes.substr(0, kSyncWord.size()))) return Found::kDamage;
  if (bytes.size() < kHeaderBytes) return cut_off();
  bytes.remove_prefix(kSyncWord.size());
  header.number = take<std::int64_t>(bytes);
  header.received_us = take<std::int64_t>(bytes);
  header.channel_bytes = take<std::uint32_t>(bytes);
  header.data_bytes = take<std::uint32_t>(bytes);
  if (header.channel_bytes == 0 || header.channel_bytes > kMaxChannelLength || header.data_bytes > kMaxData)
    return Found::kDamage;
  const std::uint64_t end = offset_ + kHeaderBytes + header.channel_bytes + header.data_bytes;
  if (end > size_) return cut_off();
  // If no event follows, the length may be wrong. Then other events begin within this one.
  const bool followed = kSyncWord.starts_with(bytes_at(end, kSyncWord.size()));
  return followed || !sync_word_between(offset_ + 1, end) ? Found::kEvent : Found::kDamage;
}

void EventLogReader::skip() {
  if (damage_.places == 0) damage_.first_byte = offset_;
  const std::uint64_t next = sync_word_between(offset_ + 1, size_).value_or(size_);
  damage_.skipped_bytes += next - offset_;
  offset_ = next;
}

void EventLogReader::read_body(const Header& header, LogEvent& event) {
  event.number = header.number;
  event.received_us = header.received_us;
  std::string_view body =
      bytes_at(offset_ + kHeaderBytes, std::uint64_t{header.channel_bytes} + header.data_bytes);
  event.channel = body.substr(0, header.channel_bytes);
  body.remove_prefix(std::min<std::size_t>(body.size(), header.channel_bytes));
  event.data.assign(body.begin(), body.end());
  offset_ += kHeaderBytes + header.channel_bytes + header.data_bytes;
  any_ = true;
}

void EventLogReader::refuse_what_is_no_log() {
  if (bytes_at(0, kMcapMagic.size()) == kMcapMagic)
    throw InputError(name_ +
                     ": is an MCAP file for viewers: give the LCM event log from which it was exported");
  throw InputError(name_ + ": is not an LCM event log: its " + std::to_string(size_) +
                   " bytes have no event; give a log of strainwavectl record or lcm-logger");
}

bool EventLogReader::next(LogEvent& event) {
  bool skipping = false;
  for (;;) {
    Header header;
    switch (look(header)) {
      case Found::kEvent:
        read_body(header, event);
        return true;
      case Found::kCutOff:
        truncated_ = true;
        return false;
      case Found::kEnd:
        if (!any_ && damage_.places > 0) refuse_what_is_no_log();
        return false;
      case Found::kDamage:
        skip();
        // Sync words that begin no event belong to the same damaged place.
        if (!skipping) ++damage_.places;
        skipping = true;
        break;
    }
  }
}

void require_undamaged(const EventLogReader& reader, const std::filesystem::path& file) {
  const LogDamage& damage = reader.damage();
  if (damage.places == 0) return;
  throw InputError(file.string() + ": at byte " + std::to_string(damage.first_byte) + ": " +
                   std::to_string(damage.skipped_bytes) +
                   " bytes are damaged, and events may be missing: record it again (strainwavectl export "
                   "still reads the other events)");
}

}  // namespace strainwave
