// SPDX-License-Identifier: BSD-3-Clause
#include "client/text/mcap_writer.h"

#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <concepts>

#include "base/input_error.h"

namespace strainwave {

namespace {

constexpr std::string_view kMagic{"\x89MCAP0\r\n", 8};

/// Numbers of the records in the specification.
enum class Opcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0B,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

/// The content of a record, field by field.
class Content {
 public:
  template <std::unsigned_integral Integer>
  Content& number(Integer value) {
    for (std::size_t i = 0; i < sizeof(Integer); ++i)
      bytes_ += static_cast<char>((std::uint64_t{value} >> (8U * i)) & 0xFFU);
    return *this;
  }
  /// A byte count and the bytes: for text, and for arrays and maps with encoded entries.
  Content& text(std::string_view text) { return number(static_cast<std::uint32_t>(text.size())).raw(text); }
  Content& raw(std::string_view bytes) {
    bytes_ += bytes;
    return *this;
  }
  std::string_view bytes() const noexcept { return bytes_; }

  std::string as(Opcode opcode) const {
    Content record;
    record.number(static_cast<std::uint8_t>(opcode)).number(static_cast<std::uint64_t>(bytes_.size()));
    return record.raw(bytes_).bytes_;
  }

 private:
  std::string bytes_;
};

std::uint32_t crc_of(std::uint32_t crc, std::string_view bytes) {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): characters as bytes
  return static_cast<std::uint32_t>(
      ::crc32_z(crc, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

std::string compressed(std::string_view bytes) {
  constexpr int kLevel = 3;  // default of zstd
  std::string result(::ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size = ::ZSTD_compress(result.data(), result.size(), bytes.data(), bytes.size(), kLevel);
  if (::ZSTD_isError(size) != 0U) throw InputError(std::string("zstd: ") + ::ZSTD_getErrorName(size));
  result.resize(size);
  return result;
}

}  // namespace

void McapWriter::Span::take(std::uint64_t time_ns) noexcept {
  first_ns = any ? std::min(first_ns, time_ns) : time_ns;
  last_ns = any ? std::max(last_ns, time_ns) : time_ns;
  any = true;
}

McapWriter::McapWriter(const std::filesystem::path& file, std::string_view library)
    : name_(file.string()), file_(file, std::ios::binary | std::ios::trunc), data_crc_(crc_of(0, {})) {
  if (!file_)
    throw InputError(name_ + " cannot be written: check that its folder exists and that you may write to it");
  put(kMagic);
  put(Content().text("").text(library).as(Opcode::kHeader));
}

void McapWriter::put(std::string_view bytes) {
  file_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  data_crc_ = crc_of(data_crc_, bytes);
  offset_ += bytes.size();
}

std::uint16_t McapWriter::add_channel(const std::string& topic, const std::string& schema_name,
                                      const std::string& schema) {
  auto known = schema_ids_.find(schema_name);
  if (known == schema_ids_.end()) {
    const auto id = static_cast<std::uint16_t>(schemas_.size() + 1);  // 0 means none
    known = schema_ids_.emplace(schema_name, id).first;
    schemas_.push_back(
        Content().number(id).text(schema_name).text("jsonschema").text(schema).as(Opcode::kSchema));
    open_ += schemas_.back();
  }
  const auto id = static_cast<std::uint16_t>(channels_.size());
  Channel channel;
  channel.record =
      Content().number(id).number(known->second).text(topic).text("json").text("").as(Opcode::kChannel);
  open_ += channel.record;
  channels_.push_back(std::move(channel));
  return id;
}

void McapWriter::write(std::uint16_t channel, std::uint64_t received_ns, std::uint64_t sent_ns,
                       std::string_view json) {
  Channel& its = channels_.at(channel);
  its.index += Content().number(received_ns).number(static_cast<std::uint64_t>(open_.size())).bytes();
  open_ += Content()
               .number(channel)
               .number(its.sequence++)
               .number(received_ns)
               .number(sent_ns)
               .raw(json)
               .as(Opcode::kMessage);
  open_span_.take(received_ns);
  span_.take(received_ns);
  ++its.messages;
  ++messages_;
  if (open_.size() >= kChunkBytes || open_span_.last_ns - open_span_.first_ns >= kChunkSpan_ns) end_chunk();
}

void McapWriter::end_chunk() {
  if (open_.empty()) return;
  const std::string bytes = compressed(open_);
  Chunk chunk;
  chunk.span = open_span_;
  chunk.offset = offset_;
  chunk.compressed = bytes.size();
  chunk.uncompressed = open_.size();
  put(Content()
          .number(open_span_.first_ns)
          .number(open_span_.last_ns)
          .number(static_cast<std::uint64_t>(open_.size()))
          .number(crc_of(crc_of(0, {}), open_))
          .text("zstd")
          .number(static_cast<std::uint64_t>(bytes.size()))
          .raw(bytes)
          .as(Opcode::kChunk));
  chunk.length = offset_ - chunk.offset;
  for (std::size_t id = 0; id < channels_.size(); ++id) {
    if (channels_[id].index.empty()) continue;
    chunk.index_offsets[static_cast<std::uint16_t>(id)] = offset_;
    put(Content().number(static_cast<std::uint16_t>(id)).text(channels_[id].index).as(Opcode::kMessageIndex));
    channels_[id].index.clear();
  }
  chunk.index_length = offset_ - chunk.offset - chunk.length;
  chunks_.push_back(std::move(chunk));
  open_.clear();
  open_span_ = {};
  file_.flush();
}

std::string McapWriter::statistics() const {
  Content counts;
  for (std::size_t id = 0; id < channels_.size(); ++id)
    counts.number(static_cast<std::uint16_t>(id)).number(channels_[id].messages);
  return Content()
      .number(messages_)
      .number(static_cast<std::uint16_t>(schemas_.size()))
      .number(static_cast<std::uint32_t>(channels_.size()))
      .number(std::uint32_t{0})  // attachments
      .number(std::uint32_t{0})  // metadata
      .number(static_cast<std::uint32_t>(chunks_.size()))
      .number(span_.first_ns)
      .number(span_.last_ns)
      .text(counts.bytes())
      .as(Opcode::kStatistics);
}

void McapWriter::write_summary(std::uint64_t summary_offset) {
  std::string summary;
  std::string offsets;
  const auto group = [&](Opcode opcode, const std::string& records) {
    if (records.empty()) return;
    offsets += Content()
                   .number(static_cast<std::uint8_t>(opcode))
                   .number(summary_offset + summary.size())
                   .number(static_cast<std::uint64_t>(records.size()))
                   .as(Opcode::kSummaryOffset);
    summary += records;
  };
  std::string records;
  for (const std::string& schema : schemas_) records += schema;
  group(Opcode::kSchema, records);
  records.clear();
  for (const Channel& channel : channels_) records += channel.record;
  group(Opcode::kChannel, records);
  group(Opcode::kStatistics, statistics());
  records.clear();
  for (const Chunk& chunk : chunks_) {
    Content indexes;
    for (const auto& [channel, offset] : chunk.index_offsets) indexes.number(channel).number(offset);
    records += Content()
                   .number(chunk.span.first_ns)
                   .number(chunk.span.last_ns)
                   .number(chunk.offset)
                   .number(chunk.length)
                   .text(indexes.bytes())
                   .number(chunk.index_length)
                   .text("zstd")
                   .number(chunk.compressed)
                   .number(chunk.uncompressed)
                   .as(Opcode::kChunkIndex);
  }
  group(Opcode::kChunkIndex, records);

  const std::uint64_t offsets_offset = summary_offset + summary.size();
  // The checksum covers the summary and the footer up to itself.
  constexpr std::size_t kChecksumBytes = 4;
  const std::string footer =
      Content().number(summary_offset).number(offsets_offset).number(std::uint32_t{0}).as(Opcode::kFooter);
  const std::string covered = summary + offsets + footer.substr(0, footer.size() - kChecksumBytes);
  put(covered);
  put(Content().number(crc_of(crc_of(0, {}), covered)).bytes());
}

void McapWriter::finish() {
  end_chunk();
  put(Content().number(data_crc_).as(Opcode::kDataEnd));
  write_summary(offset_);
  put(kMagic);
  if (!file_.flush()) throw NotAchieved(name_ + " is incomplete: writing failed; is the disk full?");
}

}  // namespace strainwave
