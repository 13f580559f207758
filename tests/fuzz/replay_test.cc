// SPDX-License-Identifier: BSD-3-Clause
// Runs one fuzz harness over its corpus, which keeps the findings of the fuzzer, without a fuzzer.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "tests/fuzz/fuzz_input.h"

namespace strainwave::fuzz {
namespace {

std::vector<std::uint8_t> bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Corpus, PassesThroughTheHarness) {
  std::size_t inputs = 0;
  for (const auto& entry : std::filesystem::directory_iterator(STRAINWAVE_CORPUS)) {
    SCOPED_TRACE(entry.path().filename());
    const std::vector<std::uint8_t> bytes = bytes_of(entry.path());
    EXPECT_EQ(LLVMFuzzerTestOneInput(bytes.data(), bytes.size()), 0);
    ++inputs;
  }
  EXPECT_GT(inputs, 0U) << STRAINWAVE_CORPUS;
}

TEST(Corpus, EveryBeginningOfAnInputPassesToo) {
  for (const auto& entry : std::filesystem::directory_iterator(STRAINWAVE_CORPUS)) {
    SCOPED_TRACE(entry.path().filename());
    const std::vector<std::uint8_t> bytes = bytes_of(entry.path());
    for (std::size_t size = 0; size < bytes.size(); size += 1 + bytes.size() / 8)
      EXPECT_EQ(LLVMFuzzerTestOneInput(bytes.data(), size), 0);
  }
}

}  // namespace
}  // namespace strainwave::fuzz
