// SPDX-License-Identifier: BSD-3-Clause
// What a fuzzer's bytes mean to the harnesses: numbers and CAN frames, taken from the front. Beyond the end: zeros.
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
  /// A length byte (0..8), then that many bytes.
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

/// Ends the process: a property that must hold for every input did not.
[[noreturn]] inline void fail(const char* condition, const char* file, int line) {
  std::fprintf(stderr, "%s:%d: not for every input: %s\n", file, line, condition);
  std::abort();
}
#define STRAINWAVE_FUZZ_CHECK(condition) \
  static_cast<void>((condition) || (strainwave::fuzz::fail(#condition, __FILE__, __LINE__), false))

}  // namespace strainwave::fuzz

/// Defined once in every harness; the fuzzer calls it, or the test that replays the corpus.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
