// SPDX-License-Identifier: BSD-3-Clause
#include "telemetry/compression.h"

#include <zlib.h>

#include <algorithm>
#include <stdexcept>

namespace strainwave {

namespace {

constexpr int kGzipWindow = MAX_WBITS + 16;  // zlib: + 16 selects the gzip header
constexpr int kMemoryLevel = 8;              // default of zlib

}  // namespace

std::string gzip(std::string_view text) {
  z_stream stream{};
  if (::deflateInit2(&stream, Z_BEST_SPEED, Z_DEFLATED, kGzipWindow, kMemoryLevel, Z_DEFAULT_STRATEGY) !=
      Z_OK)
    throw std::runtime_error("zlib cannot begin to compress: is memory left?");
  std::string packed(::deflateBound(&stream, text.size()), '\0');
  // zlib only reads from this pointer, which its interface declares non-const.
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  const int result = ::deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  ::deflateEnd(&stream);
  if (result != Z_STREAM_END) throw std::runtime_error("zlib did not compress a page of metrics");
  return packed;
}

bool takes_gzip(std::string_view accept_encoding) {
  while (!accept_encoding.empty()) {
    std::string_view entry = accept_encoding.substr(0, accept_encoding.find(','));
    accept_encoding.remove_prefix(std::min(accept_encoding.size(), entry.size() + 1));
    entry.remove_prefix(std::min(entry.size(), entry.find_first_not_of(" \t")));
    if (entry.substr(0, entry.find_first_of("; \t")) != "gzip") continue;
    const std::size_t weight = entry.find("q=");  // weight 0: not accepted
    return weight == std::string_view::npos ||
           entry.find_first_of("123456789", weight) != std::string_view::npos;
  }
  return false;
}

}  // namespace strainwave
