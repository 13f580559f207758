// SPDX-License-Identifier: BSD-3-Clause
// An MCAP file, which Foxglove, PlotJuggler and the mcap readers of many languages open. Not real-time.
//
// The writer gathers messages into chunks. Each chunk is compressed separately (zstd) and written as a whole, so after a crash
// the file is readable up to its last chunk. finish() adds indexes and statistics, with which a large file opens quickly.
//
// Source: the MCAP specification, https://mcap.dev/spec, version 0 (magic "\x89MCAP0\r\n"); all numbers little-endian.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace strainwave {

class McapWriter {
 public:
  /// A chunk ends at this number of uncompressed bytes, or at this time span of its messages. It bounds the loss in a crash.
  static constexpr std::size_t kChunkBytes = std::size_t{1} << 20;
  static constexpr std::uint64_t kChunkSpan_ns = 1'000'000'000;

  /// Creates `file`; `library` names the writing program. Throws InputError when it cannot be written.
  McapWriter(const std::filesystem::path& file, std::string_view library);

  /// Adds a topic whose messages are JSON texts of `schema` (a JSON schema). A schema name is stored only once.
  std::uint16_t add_channel(const std::string& topic, const std::string& schema_name,
                            const std::string& schema);

  /// Writes one message with its times of receipt and of sending (ns since the epoch).
  void write(std::uint16_t channel, std::uint64_t received_ns, std::uint64_t sent_ns, std::string_view json);

  /// Ends the last chunk and adds the summary. Throws InputError when any data could not be written. Do not write afterwards.
  void finish();

  std::uint64_t messages() const noexcept { return messages_; }
  /// False if writing has failed, for example on a full disk. The file then ends there.
  bool good() const noexcept { return file_.good(); }

 private:
  struct Span {
    std::uint64_t first_ns = 0;
    std::uint64_t last_ns = 0;
    bool any = false;
    void take(std::uint64_t time_ns) noexcept;
  };
  struct Channel {
    std::string record;  ///< encoded, as in the file
    std::uint32_t sequence = 0;
    std::uint64_t messages = 0;
    std::string index;  ///< index of the open chunk: pairs of time and offset
  };
  struct Chunk {
    Span span;
    std::uint64_t offset = 0;
    std::uint64_t length = 0;
    std::map<std::uint16_t, std::uint64_t> index_offsets;
    std::uint64_t index_length = 0;
    std::uint64_t compressed = 0;
    std::uint64_t uncompressed = 0;
  };

  void put(std::string_view bytes);
  void end_chunk();
  void write_summary(std::uint64_t summary_offset);
  std::string statistics() const;

  std::string name_;
  std::ofstream file_;
  std::uint64_t offset_ = 0;
  std::uint32_t data_crc_;
  std::map<std::string, std::uint16_t> schema_ids_;
  std::vector<std::string> schemas_;  ///< encoded, as in the file
  std::vector<Channel> channels_;     ///< numbered from 0
  std::vector<Chunk> chunks_;
  std::string open_;  ///< the open chunk, uncompressed
  Span open_span_;
  Span span_;
  std::uint64_t messages_ = 0;
};

}  // namespace strainwave
