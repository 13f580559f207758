// SPDX-License-Identifier: BSD-3-Clause
// An MCAP file, which Foxglove, PlotJuggler and the mcap readers of many languages open. Not real-time.
//
// Messages are gathered into chunks, each compressed by itself (zstd) and written whole. So a file whose writer
// was killed is readable to its last chunk. The call of finish() adds indexes and statistics, with which a large file opens quickly.
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
  /// Uncompressed bytes after which a chunk ends, and time of its messages after which it does: what a crash may cost.
  static constexpr std::size_t kChunkBytes = std::size_t{1} << 20;
  static constexpr std::uint64_t kChunkSpan_ns = 1'000'000'000;

  /// Creates `file`; `library` names the writing program. Throws InputError when it cannot be written.
  McapWriter(const std::filesystem::path& file, std::string_view library);

  /// A topic whose messages are JSON texts that fit `schema` (a JSON schema). The same schema name is stored once.
  std::uint16_t add_channel(const std::string& topic, const std::string& schema_name,
                            const std::string& schema);

  /// One message, stamped when it was received and when its sender made it (ns since the epoch).
  void write(std::uint16_t channel, std::uint64_t received_ns, std::uint64_t sent_ns, std::string_view json);

  /// Ends the last chunk and adds the summary. Throws InputError when anything could not be written; nothing may follow.
  void finish();

  std::uint64_t messages() const noexcept { return messages_; }
  /// False: the disk is full, the file ends here.
  bool good() const noexcept { return file_.good(); }

 private:
  struct Span {
    std::uint64_t first_ns = 0;
    std::uint64_t last_ns = 0;
    bool any = false;
    void take(std::uint64_t time_ns) noexcept;
  };
  struct Channel {
    std::string record;  ///< as it stands in the file
    std::uint32_t sequence = 0;
    std::uint64_t messages = 0;
    std::string index;  ///< of the open chunk: pairs of time and offset
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
  std::vector<std::string> schemas_;  ///< as they stand in the file
  std::vector<Channel> channels_;     ///< the number of the first is 0
  std::vector<Chunk> chunks_;
  std::string open_;  ///< the open chunk, uncompressed
  Span open_span_;
  Span span_;
  std::uint64_t messages_ = 0;
};

}  // namespace strainwave
