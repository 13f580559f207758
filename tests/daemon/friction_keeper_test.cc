// SPDX-License-Identifier: BSD-3-Clause
// Learned friction survives a restart of the daemon, and no file can prevent the daemon's start.
#include "daemon/friction_keeper.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "base/text_file.h"
#include "daemon/admission/table_admission.h"
#include "tests/support/joint_bench.h"
#include "tests/support/temporary_folder.h"

namespace strainwave::testing {
namespace {

class FrictionKeeperTest : public ::testing::Test {
 protected:
  static StateRecord learned(double scale) {
    StateRecord record{};
    record.friction_rules_id = friction_rules_digest(demo_table().friction);
    std::fill(std::begin(record.state.friction_scales), std::end(record.state.friction_scales), scale);
    record.state.friction_learned_C = 20.0;
    record.state.friction_age_s = 3600.0;
    return record;
  }
  /// One run of the daemon, in which its joint publishes these records.
  void live(std::initializer_list<StateRecord> records) {
    FrictionKeeper keeper(folder(), {"elbow"});
    keeper.start();
    for (const StateRecord& record : records) keeper.observe(record, 1);
    keeper.finish();
  }
  /// The state with which the next run of the daemon begins.
  state_v1 restored(const FuzzyFriction& rules = demo_table().friction) {
    JointBench bench({demo_joint()});
    FrictionKeeper keeper(folder(), {"elbow"});
    keeper.restore(0, rules, bench.joint(0), bench.time().now_ns);
    bench.bring_to_hold(0);
    return bench.state(0);
  }
  std::filesystem::path folder() { return temporary_.path() / "state"; }
  std::filesystem::path file() { return friction_file(folder(), "elbow"); }
  TemporaryFolder temporary_;
};

TEST_F(FrictionKeeperTest, RestoresScalesAgeAndTemperature) {
  live({learned(0.5)});
  const state_v1 state = restored();
  EXPECT_EQ(state.friction_scales[0], 0.5);
  EXPECT_EQ(state.friction_learned_C, 20.0);
  EXPECT_NEAR(state.friction_age_s, 3600.0, 60.0);
}

TEST_F(FrictionKeeperTest, RestoresNoLoad) {
  StateRecord record = learned(0.5);
  record.state.learned_load_Nm = 8.0;
  live({record});
  EXPECT_EQ(restored().learned_load_Nm, 0.0);
}

TEST_F(FrictionKeeperTest, RemovesTheFileOfAJointThatWasReset) {
  live({learned(0.5)});
  JointBench bench({demo_joint()});
  FrictionKeeper keeper(folder(), {"elbow"});
  keeper.restore(0, demo_table().friction, bench.joint(0), 0);
  keeper.start();
  StateRecord reset = learned(0.0);
  reset.state.friction_age_s = -1.0;
  keeper.observe(reset, 1);
  keeper.finish();
  EXPECT_FALSE(std::filesystem::exists(file()));
}

TEST_F(FrictionKeeperTest, DoesNotUseWhatWasLearnedWithOtherRules) {
  live({learned(0.5)});
  FuzzyFriction other = demo_table().friction;
  other.rules[0].friction.coulomb_Nm += 0.001;
  EXPECT_EQ(restored(other).friction_scales[0], 0.0);
  EXPECT_TRUE(std::filesystem::exists(file())) << "it is no damage";
}

TEST_F(FrictionKeeperTest, DoesNotUseAnotherJointsFile) {
  live({learned(0.5)});
  std::string text = read_text_file(file());
  write_text_file(file(), text.replace(text.find("elbow"), 5, "wrist"));
  EXPECT_EQ(restored().friction_scales[0], 0.0);
}

TEST_F(FrictionKeeperTest, SetsADamagedFileAsideAndStarts) {
  make_folder(folder());
  for (const char* text : {"", "{", "[1]", "{\"joint\": \"elbow\"}", "\xff\xfe\x00"}) {
    write_text_file(file(), text);
    EXPECT_EQ(restored().friction_scales[0], 0.0) << text;
    EXPECT_FALSE(std::filesystem::exists(file())) << text;
    EXPECT_TRUE(std::filesystem::exists(file().string() + ".damaged")) << text;
  }
}

TEST_F(FrictionKeeperTest, StartsWithAFolderWhereTheFileShouldBe) {
  make_folder(file());
  EXPECT_EQ(restored().friction_scales[0], 0.0);
}

TEST_F(FrictionKeeperTest, WritesOnceAMinuteWhileTheDaemonRuns) {
  FrictionKeeper keeper(folder(), {"elbow"});
  keeper.start();
  keeper.observe(learned(0.5), 1);
  keeper.observe(learned(0.6), FrictionKeeper::kEvery_ns);
  EXPECT_FALSE(std::filesystem::exists(file()));
  keeper.observe(learned(0.7), 1 + FrictionKeeper::kEvery_ns);
  for (int i = 0; i < 1000 && !std::filesystem::exists(file()); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  ASSERT_TRUE(std::filesystem::exists(file()));
  EXPECT_EQ(parse_kept_friction(read_text_file(file()), "f").scale[0], 0.7);
}

TEST_F(FrictionKeeperTest, GoesOnWhereNothingCanBeWritten) {
  std::ofstream(folder()) << "a file where the folder should be";
  live({learned(0.5)});
  EXPECT_TRUE(std::filesystem::is_regular_file(folder()));
}

}  // namespace
}  // namespace strainwave::testing
