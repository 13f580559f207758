// SPDX-License-Identifier: BSD-3-Clause
// Fixture of the configuration tests: writes a text as a file into the test's own folder, and reads it as the daemon does.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "base/text_file.h"
#include "daemon/config/config.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_folder.h"

namespace strainwave {

using testing::expect_mentions;

class ConfigFileTest : public ::testing::Test {
 protected:
  /// The text of an example of config/.
  static std::string example(const std::string& name) {
    return read_text_file(std::string(STRAINWAVE_SOURCE_DIR "/config/") + name);
  }
  /// `text` with its first `from` replaced, which must be there.
  static std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
  }
  DaemonConfig read(const std::string& text) {
    std::ofstream(folder_ / "c.toml") << text;
    return read_config(folder_ / "c.toml");
  }
  /// The refusal of `text`.
  std::string error_of(const std::string& text) {
    return testing::refusal_of([&] { ConfigFileTest::read(text); });
  }

  TemporaryFolder temporary_;
  const std::filesystem::path& folder_ = temporary_.path();
};

}  // namespace strainwave
