// SPDX-License-Identifier: BSD-3-Clause
#include "commission/commission_record.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/input_error.h"
#include "tests/support/temporary_folder.h"

namespace strainwave::testing {
namespace {

CommissionRecord full_record() {
  CommissionRecord record;
  record.joint = "elbow";
  record.configuration = "arm.toml";
  record.configuration_text = "[[joint]]\nname = \"elbow\"\n";
  record.simulated = true;
  record.joint_time_s = 121.5;
  record.temperature_C = 21.5;
  record.steps = {{"direction", StepOutcome::kDone, "positive torque, positive motion", 8.0},
                  {"friction", StepOutcome::kSkipped, "done before", 0.0},
                  {"comparison", StepOutcome::kFailed, "load_inertia_kgm2", 0.0}};
  record.values = {{"load_inertia_kgm2", "kg m2", 0.3, {0.2, 0.004}, 0.2},
                   {"resonance", "Hz", {}, {31.0, 0.2}, 31.0}};
  record.friction = {{0.5, 21.0, {7.5, 0.1}}};
  record.response = {{3.0, 0.05, -1.6}, {6.0, 0.02, -1.7}};
  record.model = {0.09, 0.2, 8000.0, 1.5, 0.0015};
  record.breakaway_positive_Nm = {8.0, 0.2};
  record.breakaway_negative_Nm = {8.5, 0.3};
  record.kinematic_error_rad = {1e-4, 2e-4};
  record.problem = "load_inertia_kgm2 is wrong";
  return record;
}

TEST(CommissionRecord, ReadsWhatItWrote) {
  const TemporaryFolder folder;
  const CommissionRecord record = full_record();
  write_commission_record(folder.path() / "new", record);
  const std::optional<CommissionRecord> read = read_commission_record(folder.path() / "new");
  ASSERT_TRUE(read);
  EXPECT_EQ(to_json(*read), to_json(record));
  EXPECT_EQ(read->steps[2].outcome, StepOutcome::kFailed);
  EXPECT_EQ(read->values[0].configured, 0.3);
  EXPECT_FALSE(read->values[1].configured);
  EXPECT_EQ(read->breakaway_negative_Nm->half_width_95, 0.3);
}

TEST(CommissionRecord, HasNoKeyForWhatIsNotKnown) {
  CommissionRecord record;
  record.friction = {{0.5, std::numeric_limits<double>::quiet_NaN(), {7.5, 0.1}}};
  const CommissionRecord read = parse_commission_record(to_json(record), "commission.json");
  EXPECT_TRUE(std::isnan(read.friction[0].temperature_C));
  EXPECT_FALSE(read.temperature_C || read.model || read.breakaway_positive_Nm || read.kinematic_error_rad);
  EXPECT_EQ(to_json(record).find("null"), std::string::npos);
}

TEST(CommissionRecord, IsNothingWhereNoneWasWritten) {
  const TemporaryFolder folder;
  EXPECT_FALSE(read_commission_record(folder.path()));
}

TEST(CommissionRecord, RefusesAnotherFormatAndAnUnknownOutcome) {
  std::string text = to_json(full_record());
  const std::string outcome = text;
  text.replace(text.find("\"format\": 1"), 11, "\"format\": 2");
  EXPECT_THROW(parse_commission_record(text, "commission.json"), InputError);
  text = outcome;
  text.replace(text.find("\"skipped\""), 9, "\"perhaps\"");
  EXPECT_THROW(parse_commission_record(text, "commission.json"), InputError);
}

}  // namespace
}  // namespace strainwave::testing
