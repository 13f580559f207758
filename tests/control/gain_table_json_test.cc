// SPDX-License-Identifier: BSD-3-Clause
#include "control/table/gain_table_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

#include "base/input_error.h"
#include "base/text_file.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

const std::filesystem::path kTables = STRAINWAVE_SOURCE_DIR "/data/tables";

std::string message_of(const std::string& text) {
  return testing::refusal_of([&] { gain_table_from_json(text, "table.json"); });
}

std::string reference_text() {
  return read_text_file(kTables / "c4.json");
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto position = text.find(from);
  EXPECT_NE(position, std::string::npos) << from;
  return text.replace(position, from.size(), to);
}

TEST(GainTableJson, ReadsBackToTheSameBitsForArbitraryNumbers) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 50; ++i) {
    GainTable table = read_gain_table(kTables / "c4.json");
    for (auto& F : table.primary.F) {
      if (&F - table.primary.F.data() >= table.primary.rule_count) break;
      for (double& gain : F) gain = std::uniform_real_distribution<double>(-1e3, 1e3)(random);
    }
    table.torque_limit_Nm = std::nextafter(34.0, i % 2 == 0 ? 0.0 : 100.0);
    table.primary.cost_bound = std::ldexp(std::uniform_real_distribution<double>(0.5, 1.0)(random), -300);
    const GainTable read = gain_table_from_json(to_json(table), "test");
    EXPECT_EQ(to_json(read), to_json(table));
    EXPECT_EQ(read.primary.F, table.primary.F);
    EXPECT_EQ(read.primary.P, table.primary.P);
    EXPECT_EQ(read.primary.cost_bound, table.primary.cost_bound);
    EXPECT_EQ(read.torque_limit_Nm, table.torque_limit_Nm);
  }
}

TEST(GainTableJson, EveryShippedTableReadsBackToTheSameBytes) {
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kTables)) {
    if (entry.is_directory() || entry.path().string().ends_with("-friction.json")) continue;
    const std::string text = read_text_file(entry.path());
    EXPECT_EQ(to_json(gain_table_from_json(text, "test")), text) << entry.path();
  }
}

TEST(GainTableJson, NamesUnknownMissingAndRepeatedKeys) {
  const std::string text = reference_text();
  EXPECT_NE(message_of(replaced(text, "\"period_s\"", "\"period_ms\"")).find("plant.period_s: is missing"),
            std::string::npos);
  EXPECT_NE(message_of(replaced(text, "\"period_s\":", "\"extra\": 1, \"period_s\":"))
                .find("plant.extra: unknown key"),
            std::string::npos);
  EXPECT_NE(message_of(replaced(text, "\"period_s\":", "\"gear_ratio\": 1, \"period_s\":"))
                .find("\"gear_ratio\" occurs twice"),
            std::string::npos);
}

TEST(GainTableJson, EveryKeyIsNeeded) {
  const auto document = nlohmann::ordered_json::parse(reference_text());
  for (const auto& [key, value] : document.items()) {
    auto without = document;
    without.erase(key);
    EXPECT_NE(message_of(without.dump()).find(key + ": is missing"), std::string::npos) << key;
    if (!value.is_object()) continue;
    for (const auto& [inner, unused] : value.items()) {
      without = document;
      without[key].erase(inner);
      EXPECT_NE(message_of(without.dump()).find(key + "." + inner + ": is missing"), std::string::npos)
          << key << inner;
    }
  }
}

TEST(GainTableJson, RefusesWrongSizesTypesAndNumbersThatAreNone) {
  auto document = nlohmann::ordered_json::parse(reference_text());
  document["primary"]["rules"][1]["P"][2].erase(0);
  EXPECT_NE(message_of(document.dump()).find("primary.rules[1].P"), std::string::npos);
  const std::string text = reference_text();
  EXPECT_NE(message_of(replaced(text, "\"torque_limit_Nm\": 34.0", "\"torque_limit_Nm\": NaN")), "accepted");
  EXPECT_NE(message_of(replaced(text, "\"torque_limit_Nm\": 34.0", "\"torque_limit_Nm\": 1e999")),
            "accepted");
  EXPECT_NE(message_of(replaced(text, "\"torque_limit_Nm\": 34.0", "\"torque_limit_Nm\": null"))
                .find("must be a number"),
            std::string::npos);
  EXPECT_NE(message_of(replaced(text, "\"torque_limit_Nm\": 34.0", "\"torque_limit_Nm\": \"34\""))
                .find("must be a number"),
            std::string::npos);
  EXPECT_NE(message_of(replaced(text, "\"format\": 1", "\"format\": 2")).find("format 1"), std::string::npos);
  EXPECT_NE(message_of(replaced(text, "forward-euler", "backward-euler")).find("zero-order-hold"),
            std::string::npos);
}

TEST(GainTableJson, ADefectiveTableIsNotWritten) {
  GainTable table = read_gain_table(kTables / "c4.json");
  table.torque_limit_Nm = -1.0;
  const TemporaryFolder folder;
  const auto path = folder.path() / "defective_table.json";
  EXPECT_THROW(write_gain_table(table, path), InputError);
  EXPECT_FALSE(std::filesystem::exists(path));
}

}  // namespace
}  // namespace strainwave
