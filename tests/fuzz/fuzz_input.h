// SPDX-License-Identifier: BSD-3-Clause
// Reads numbers and CAN frames from the front of a fuzzer's bytes. After their end it reads zeros.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>

#include "drivers/can/can_frame.h"

namespace strainwave::fuzz {

class FuzzInput {
 public:
  FuzzInput(const std::uint8_t* data, std::size_t size) : rest_(data, size) {}

  bool empty() const { return rest_.empty(); }
  std::uint8_t byte() {
    if (rest_.empty()) return 0;
    const std::uint8_t value = rest_.front();
    rest_ = rest_.subspan(1);
    return value;
  }
  std::uint64_t number(std::size_t bytes) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < bytes; ++i) value |= std::uint64_t{byte()} << (8U * i);
    return value;
  }
  /// A length byte, taken modulo 9, then that many bytes.
  CanFrame frame(std::uint32_t id) {
    CanFrame frame;
    frame.id = id;
    frame.size = static_cast<std::uint8_t>(byte() % (kMaxCanBytes + 1));
    for (std::size_t i = 0; i < frame.size; ++i) frame.bytes[i] = byte();
    return frame;
  }

 private:
  std::span<const std::uint8_t> rest_;
};

/// Ends the process, because a property that must hold for every input does not.
[[noreturn]] inline void fail(const char* condition, const char* file, int line) {
  std::fprintf(stderr, "%s:%d: not for every input: %s\n", file, line, condition);
  std::abort();
}
#define STRAINWAVE_FUZZ_CHECK(condition) \
  static_cast<void>((condition) || (strainwave::fuzz::fail(#condition, __FILE__, __LINE__), false))

}  // namespace strainwave::fuzz

/// Every harness defines it. The fuzzer calls it, or the test that replays the corpus.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
