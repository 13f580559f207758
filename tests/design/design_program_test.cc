// SPDX-License-Identifier: BSD-3-Clause
// Above 300 lines: the commands of one program, as users run them.
// strainwave-design as its user sees it: exit status, messages, files.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "base/text_file.h"
#include "base/units.h"
#include "commission/commission_record.h"
#include "control/table/gain_table_json.h"
#include "design/friction/friction_file.h"
#include "design/joint_defaults.h"

namespace strainwave {
namespace {

const std::string kData = STRAINWAVE_SOURCE_DIR "/data/";

class DesignProgram : public ::testing::Test {
 protected:
  DesignProgram() { std::filesystem::create_directories(folder_); }
  ~DesignProgram() override { std::filesystem::remove_all(folder_); }

  // Returns the exit status. `output_` is what the program printed to stdout and stderr.
  int run(const std::string& arguments) {
    const std::string log = (folder_ / "log").string();
    const int status = std::system(
        (STRAINWAVE_BINARY_DIR "/bin/strainwave-design " + arguments + " > '" + log + "' 2>&1").c_str());
    output_ = read_text_file(log);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  /// Decay constant of the exponential law in the new friction file.
  double decay_C() const {
    return friction_file_from_json(read_text_file(file("friction.json")), "made")
        .exponential->law.over_temperature.decay_C;
  }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  std::filesystem::path folder_ =
      std::filesystem::path(::testing::TempDir()) /
      (std::string("design_program_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
  std::string output_;
};

TEST_F(DesignProgram, RefusesGainsThatSwingUpWithTheDelayOfADrive) {
  EXPECT_NE(run("gains --friction " + kData +
                "tables/rhs17-6006-friction.json --weights 0.1,1,1e-4,1e-9 --out " + file("stiff.json")),
            0);
  EXPECT_NE(output_.find("UNSTABLE: eigenvalue 1.19"), std::string::npos) << output_;
  const std::size_t softer = output_.find("--weights 0.1,1,0.0001,");
  ASSERT_NE(softer, std::string::npos) << output_;
  const std::string weights = output_.substr(softer, output_.find('\n', softer) - softer);
  EXPECT_FALSE(std::filesystem::exists(file("stiff.json")));
  EXPECT_EQ(run("verify " STRAINWAVE_SOURCE_DIR "/tests/daemon/admission/stiff_without_delay.json"), 1);
  EXPECT_EQ(run("gains --friction " + kData + "tables/rhs17-6006-friction.json " + weights + " --out " +
                file("soft.json")),
            0)
      << output_;
  EXPECT_EQ(run("verify " + file("soft.json")), 0) << output_;
  EXPECT_EQ(run("verify " + kData + "tables/rhs17-6006.json"), 0) << output_;
}

TEST_F(DesignProgram, VerifiesATableOnAJointWithASpring) {
  const std::string command = "verify " + kData + "tables/total-0.178/c4.json --motor-inertia_kgm2 0.089 ";
  EXPECT_EQ(run(command + "--gear csf-17-50 --load-inertia_kgm2 0.085..0.093"), 0) << output_;
  EXPECT_NE(output_.find("with the spring, delay 1: certified"), std::string::npos) << output_;
  EXPECT_EQ(run(command + "--gear csf-17-50 --load-inertia_kgm2 0.05 --delay 2"), 1) << output_;
  EXPECT_NE(output_.find("with the spring, delay 2: UNSTABLE"), std::string::npos) << output_;
  EXPECT_NE(output_.find("c4.json: NOT CERTIFIED"), std::string::npos) << output_;
  EXPECT_NE(output_.find("link 0.085..0.093 kg m2"), std::string::npos) << "the table's own box\n" << output_;
  const std::string rigid = "verify " + kData + "tables/rhs17-6006.json --motor-inertia_kgm2 0.089 ";
  EXPECT_NE(run(rigid + "--load-inertia_kgm2 0.085..0.093"), 0) << "the table names no gear";
  EXPECT_NE(output_.find("csf-14-50"), std::string::npos) << output_;
  EXPECT_NE(run(command + "--gear csf-17-50 --load-inertia_kgm2 0.3..0.05"), 0);
  EXPECT_NE(output_.find("must be FROM..TO, ascending"), std::string::npos) << output_;
}

// With two periods of delay, the requested torque weight gives an unstable loop, and the program writes softer gains with a lead. A request that is
// stiffer than the result by a quarter of a decade leads to the same result.
TEST_F(DesignProgram, GainsOnASpringAreTheStiffestThatAreCertified) {
  const std::string joint =
      "--motor-inertia_kgm2 0.089 --load-inertia_kgm2 0.1 --damping_Nms_rad 1 --delay 2";
  const std::string design = "gains --friction " + kData +
                             "tables/rhs17-6006-friction.json --gear csf-17-50 " +
                             "--inertia_kgm2 0.189 --out " + file("t.json");
  ASSERT_EQ(run(design + " " + joint + " --weights 0.1,1,1e-4,1e-7"), 0) << output_;
  EXPECT_NE(output_.find("with the spring, delay 2: certified"), std::string::npos) << output_;
  const GainTable table = read_gain_table(file("t.json"));
  EXPECT_EQ(table.box.lead_periods, 2.0);
  EXPECT_EQ(run("verify " + file("t.json")), 0) << output_;
  EXPECT_NE(output_.find("lead 2 periods"), std::string::npos) << output_;
  const double weight = table.primary.weights.torque;
  EXPECT_GT(weight, 1.01e-7);
  const std::string stiffer = std::to_string(1e6 * weight * std::pow(10.0, -0.25));
  ASSERT_EQ(run(design + " " + joint + " --weights 0.1,1,1e-4," + stiffer + "e-6"), 0) << output_;
  EXPECT_NEAR(read_gain_table(file("t.json")).primary.weights.torque, weight, 1e-4 * weight);
}

// At the torque weight of the RHS-17 the gains are too soft for this gear, and no softer gains can be certified.
TEST_F(DesignProgram, GainsForALargeGearBeginStiff) {
  const std::string design =
      "gains --gear csf-32-50 --motor-inertia_kgm2 2.1 --load-inertia_kgm2 1.2..6.9 --out " + file("t.json");
  ASSERT_EQ(run(design), 0) << output_;
  EXPECT_NE(output_.find("trying link 1.2..6.9 kg m2, motor 1.995..2.205 kg m2, torque weight 1e-09"),
            std::string::npos)
      << output_;
  EXPECT_EQ(run("verify " + file("t.json")), 0) << output_;
}

// At this delay, gains that control the heavier loads make the lightest ones oscillate. The suggested narrower range has a certified table.
TEST_F(DesignProgram, GainsForTooWideARangeNameANarrowerOne) {
  const std::string design = "gains --gear csf-17-50 --motor-inertia_kgm2 0.0873..0.0907 --delay 2 --out " +
                             file("t.json") + " --load-inertia_kgm2 ";
  ASSERT_EQ(run(design + "0.03..0.12"), 1) << output_;
  EXPECT_FALSE(std::filesystem::exists(file("t.json")));
  const std::string option = "A table is certified with --load-inertia_kgm2 ";
  const std::size_t at = output_.find(option);
  ASSERT_NE(at, std::string::npos) << output_;
  const std::string range =
      output_.substr(at + option.size(), output_.find(' ', at + option.size()) - at - option.size());
  EXPECT_EQ(run(design + range), 0) << range << output_;
}

// The request has no damping. The shipped table has the same gains, but its proof includes damping.
TEST_F(DesignProgram, GainsForLinksOf50To300GramsAtBothDelaysAreCertifiedWithALead) {
  ASSERT_EQ(run("gains --gear csf-17-50 --load-inertia_kgm2 0.05..0.3 --delay 1..2 --out " + file("t.json")),
            0)
      << output_;
  const GainTable made = read_gain_table(file("t.json"));
  EXPECT_EQ(made.box.link_inertia_kgm2.from, 0.05);
  EXPECT_EQ(made.box.link_inertia_kgm2.to, 0.3);
  EXPECT_EQ(made.box.stiffness_Nm_rad.from, 8100.0);
  EXPECT_EQ(made.box.stiffness_Nm_rad.to, 13000.0);
  EXPECT_EQ(made.box.least_delay, 1);
  EXPECT_EQ(made.box.most_delay, 2);
  EXPECT_TRUE(made.box.motor_inertia_kgm2.holds(0.99 * 0.089) &&
              made.box.motor_inertia_kgm2.holds(1.01 * 0.089));
  EXPECT_NE(output_.find("with a wider range of motor inertias no gains are certified"), std::string::npos)
      << "5 % less and the lightest link swings up\n"
      << output_;
  const GainTable shipped = read_gain_table(kData + "tables/csf-17-50-delays.json");
  EXPECT_EQ(made.box.lead_periods, shipped.box.lead_periods);
  for (int rule = 0; rule < made.primary.rule_count; ++rule)
    EXPECT_TRUE(made.primary.gain(rule).isApprox(shipped.primary.gain(rule), 1e-6)) << rule;
}

TEST_F(DesignProgram, TakesWhatIsNotGivenFromTheCataloguesActuatorWithTheGear) {
  const std::string design = "gains --gear csf-17-50 --load-inertia_kgm2 0.095..0.1 --damping_Nms_rad 1 ";
  ASSERT_EQ(run(design + "--out " + file("t.json")), 0) << output_;
  EXPECT_NE(output_.find("--friction data/tables/rhs17-6006-friction.json, of rhs17-6006"), std::string::npos)
      << output_;
  EXPECT_NE(output_.find("--motor-inertia_kgm2 0.089, of rhs17-6006"), std::string::npos) << output_;
  EXPECT_NE(output_.find("--inertia_kgm2 0.189, motor and heaviest link"), std::string::npos) << output_;
  const GainTable taken = read_gain_table(file("t.json"));
  EXPECT_DOUBLE_EQ(taken.box.motor_inertia_kgm2.from, 0.95 * 0.089);
  EXPECT_DOUBLE_EQ(taken.box.motor_inertia_kgm2.to, 1.05 * 0.089);
  EXPECT_DOUBLE_EQ(taken.plant.inertia_kgm2, 0.189);

  const std::string friction = "--friction " + kData + "tables/rhs17-6006-friction.json ";
  ASSERT_EQ(
      run(design + friction + "--motor-inertia_kgm2 0.09..0.092 --inertia_kgm2 0.2 --out " + file("t.json")),
      0)
      << output_;
  EXPECT_EQ(output_.find("catalogue"), std::string::npos) << output_;
  const GainTable given = read_gain_table(file("t.json"));
  EXPECT_EQ(given.box.motor_inertia_kgm2.from, 0.09);
  EXPECT_EQ(given.box.motor_inertia_kgm2.to, 0.092);
  EXPECT_EQ(given.plant.inertia_kgm2, 0.2);
  EXPECT_EQ(taken.provenance.friction_sha256.view(), given.provenance.friction_sha256.view())
      << "the file that is compiled in";
  EXPECT_EQ(run("verify " + file("t.json") + " --load-inertia_kgm2 0.1 --damping_Nms_rad 1"), 0) << output_;
  EXPECT_NE(output_.find("--motor-inertia_kgm2 0.09..0.092, of the table's box"), std::string::npos)
      << output_;
  const std::string rigid = "verify " + kData + "tables/rhs17-6006.json --load-inertia_kgm2 0.1 ";
  EXPECT_EQ(run(rigid + "--gear csf-17-50"), 0) << output_;
  EXPECT_NE(output_.find("--motor-inertia_kgm2 0.089, of rhs17-6006"), std::string::npos) << output_;
}

TEST_F(DesignProgram, DesignsForAGearByItsNameTheRotorAndTheLoad) {
  ASSERT_EQ(run("gains --gear csf-25-100 --rotor-inertia_kgm2 3e-5 --load 3kg@0.4m --out " + file("t.json")),
            0)
      << output_;
  EXPECT_NE(output_.find("--friction an estimate from the catalogue of gears"), std::string::npos) << output_;
  EXPECT_NE(output_.find("--motor-inertia_kgm2 0.713, of the rotor and the wave generator's 4.13e-05"),
            std::string::npos)
      << output_;
  const GainTable made = read_gain_table(file("t.json"));
  EXPECT_EQ(made.plant.joint_model.view(), "csf-25-100");
  EXPECT_EQ(made.plant.gear_ratio, 100.0);
  EXPECT_EQ(made.provenance.note.view(), "friction: estimate from the catalogue");
  EXPECT_EQ(made.torque_limit_Nm, 157.0) << "the gear's repeated peak torque";
  EXPECT_TRUE(made.box.motor_inertia_kgm2.holds(1e4 * (3e-5 + 4.13e-5)));
  EXPECT_NEAR(made.box.link_inertia_kgm2.from, 3.0 * 0.4 * 0.4, 1e-9);
  EXPECT_EQ(made.box.link_inertia_kgm2.from, made.box.link_inertia_kgm2.to);
  EXPECT_EQ(run("verify " + file("t.json")), 0) << output_;
  EXPECT_EQ(run("show " + file("t.json")), 0) << output_;
  EXPECT_NE(output_.find("note: friction: estimate from the catalogue"), std::string::npos) << output_;
}

TEST_F(DesignProgram, GainsForALightJointMayBeSofter) {
  ASSERT_EQ(run("gains --gear csf-17-50 --motor-inertia_kgm2 0.0329 --load-inertia_kgm2 0.0828..0.1012 "
                "--stiffness_Nm_rad 7384..7685 --damping_Nms_rad 0.357..0.715 --delay 1..1 --friction " +
                kData + "tables/rhs17-6006-friction.json --joint-model light --out " + file("t.json")),
            0)
      << output_;
  EXPECT_GT(read_gain_table(file("t.json")).primary.weights.torque, 1e-5) << "the softest of a heavier joint";
}

TEST_F(DesignProgram, AsksForTheMotorWhichTheCatalogueOfGearsCannotKnow) {
  const auto refused = [&](const std::string& command, const std::vector<std::string>& mentions) {
    EXPECT_EQ(run(command + " --out " + file("t.json")), 2) << output_;
    for (const std::string& word : mentions)
      EXPECT_NE(output_.find(word), std::string::npos) << word << "\n" << output_;
  };
  const std::string friction = "--friction " + kData + "tables/rhs17-6006-friction.json ";
  refused("gains", {"give --friction,", "--gear", "csf-17-50"});
  refused("gains --gear csf-20-50",
          {"the motor of csf-20-50 is not known", "--rotor-inertia_kgm2", "1.93e-05"});
  refused("gains --gear csf-20-50 --load 1kg@0.3m", {"the motor of csf-20-50 is not known"});
  refused("gains --gear csf-17-50 --joint-model own --load 0.1 " + friction,
          {"the motor of csf-17-50 is not known"});
  for (const char* load : {"3kg@0.4", "3kg@0m", "0..3kg@0.4m", "3kg@-0.4m", "3g@0.4m", "3kg"})
    refused("gains --gear csf-20-50 --rotor-inertia_kgm2 1e-5 --load " + std::string(load),
            {load, "must be"});
  refused("gains --gear csf-20-50 --rotor-inertia_kgm2 -1e-5 --load 1kg@0.3m",
          {"--rotor-inertia_kgm2 = -1e-05", "must not be negative"});
  refused("gains --rotor-inertia_kgm2 1e-5 " + friction, {"--gear"});
  refused("gains --gear csf-17-50 --rotor-inertia_kgm2 1e-6 --motor-inertia_kgm2 0.07 --load 1kg@0.2m",
          {"--rotor-inertia_kgm2 excludes --motor-inertia_kgm2"});
  const std::string rigid = "verify " + kData + "tables/rhs17-6006.json --load-inertia_kgm2 0.1";
  EXPECT_EQ(run(rigid), 2);
  EXPECT_NE(output_.find("give --gear"), std::string::npos) << output_;
  EXPECT_EQ(run(rigid + " --gear csf-20-50"), 2);
  EXPECT_NE(output_.find("the motor of csf-20-50 is not known"), std::string::npos) << output_;
}

TEST_F(DesignProgram, GoesFromTheCatalogueToACertifiedTable) {
  ASSERT_EQ(run("fit " + kData + "no_load_torque.csv --non-increasing rules --out " + file("friction.json")),
            0)
      << output_;
  ASSERT_EQ(run("gains --friction " + file("friction.json") + " --out " + file("table.json")), 0) << output_;
  EXPECT_EQ(run("verify " + file("table.json")), 0) << output_;
  EXPECT_EQ(run("show " + file("table.json")), 0) << output_;
  const GainTable made = read_gain_table(file("table.json"));
  const GainTable shipped = read_gain_table(kData + "tables/rhs17-6006.json");
  ASSERT_EQ(made.primary.rule_count, shipped.primary.rule_count);
  for (int j = 0; j < made.primary.rule_count; ++j) {
    EXPECT_TRUE(made.primary.gain(j).isApprox(shipped.primary.gain(j), 1e-6)) << j;
  }
}

TEST_F(DesignProgram, FitNamesATemperatureThatSpoilsTheFitAndLeavesItOutWhenAsked) {
  std::string text = read_text_file(kData + "no_load_torque.csv");
  const std::string fit = " --model exponential --method least-squares --out " + file("friction.json");
  ASSERT_EQ(run("fit " + kData + "no_load_torque.csv" + fit), 0) << output_;
  EXPECT_EQ(output_.find("outlier"), std::string::npos) << output_;
  EXPECT_NE(output_.find("residuals: RMS"), std::string::npos) << output_;
  const double clean_C = decay_C();
  const std::string row = "10,3.8,5.7,8.9,12.4";
  const auto at = text.find(row);
  ASSERT_NE(at, std::string::npos);
  write_text_file(file("bad.csv"), text.replace(at, row.size(), "10,3.8,57.0,8.9,12.4"));
  ASSERT_EQ(run("fit " + file("bad.csv") + fit), 0) << output_;
  EXPECT_NE(output_.find("WARNING: 10 degC is an outlier"), std::string::npos) << output_;
  EXPECT_NE(output_.find("--outliers leave-out"), std::string::npos) << output_;
  EXPECT_GT(std::abs(decay_C() - clean_C), 0.1 * clean_C) << "the test would show nothing";
  ASSERT_EQ(run("fit " + file("bad.csv") + fit + " --outliers leave-out"), 0) << output_;
  EXPECT_NE(output_.find("left out"), std::string::npos) << output_;
  EXPECT_NEAR(decay_C(), clean_C, 0.02 * clean_C);
}

TEST_F(DesignProgram, FitNamesTwoTemperaturesThatHideEachOtherAndFrictionThatRises) {
  std::string text = read_text_file(kData + "no_load_torque.csv");
  const std::string fit = " --model exponential --method least-squares --out " + file("friction.json");
  const auto spoil = [&](const std::string& row, const std::string& spoilt) {
    const auto at = text.find(row);
    ASSERT_NE(at, std::string::npos) << row;
    text.replace(at, row.size(), spoilt);
  };
  spoil("-2.5,6.9,10.5,", "-2.5,6.9,105,");
  spoil("15,3.2,4.7,", "15,3.2,47,");
  write_text_file(file("two.csv"), text);
  ASSERT_EQ(run("fit " + file("two.csv") + fit), 0) << output_;
  for (const char* temperature : {"-2.5", "15"})
    EXPECT_NE(output_.find("WARNING: " + std::string(temperature) + " degC is an outlier"), std::string::npos)
        << output_;
  EXPECT_EQ(output_.find("WARNING: friction"), std::string::npos) << output_;
  write_text_file(file("rising.csv"),
                  "temperature_C,torque_500rpm_Ncm,torque_2000rpm_Ncm\n-10,2,4\n0,2.2,4.6\n10,2.8,6\n20,3.8,"
                  "9\n30,6,14\n");
  ASSERT_EQ(run("fit " + file("rising.csv") + fit), 0) << output_;
  EXPECT_NE(output_.find("WARNING: friction is"), std::string::npos) << output_;
}

TEST_F(DesignProgram, RulesOfFewTemperaturesFollowTheLaw) {
  for (const int count : {3, 5}) {
    // These data follow the exponential law exactly.
    std::string csv = "temperature_C,viscous_Ncm_per_rpm,coulomb_Ncm,static_Ncm\n";
    const auto law = [](double temperature_C) { return std::exp(-(temperature_C + 10.0) / 14.0); };
    for (int i = 0; i < count; ++i) {
      const double T = -10.0 + 50.0 * i / (count - 1);
      csv += std::to_string(T) + "," + std::to_string(0.001 + 0.009 * law(T)) + "," +
             std::to_string(1.4 + 4.0 * law(T)) + "," + std::to_string(3.0 + 4.0 * law(T)) + "\n";
    }
    write_text_file(file("few.csv"), csv);
    const auto worst = [&](const std::string& options) {
      EXPECT_EQ(run("fit " + file("few.csv") + options + " --out " + file("friction.json")), 0) << output_;
      const FuzzyFriction rules =
          friction_file_from_json(read_text_file(file("friction.json")), "made").fuzzy->friction;
      double share = 0.0;
      for (double T = -10.0; T <= 40.0; T += 0.5) {
        const double truth_Nm = joint_torque_Nm_from_motor_Ncm(1.4 + 4.0 * law(T), 50.0);
        share = std::max(share, std::abs(rules.blend(rules.weights(T)).coulomb_Nm / truth_Nm - 1.0));
      }
      return share;
    };
    EXPECT_LT(worst(""), 0.03) << count << "\n" << output_;
    EXPECT_NE(output_.find("follow the exponential law instead"), std::string::npos) << output_;
    EXPECT_GT(worst(" --rules-from data"), 0.1) << count << ": the test would show nothing";
  }
}

TEST_F(DesignProgram, FitFollowsTheShippedCatalogueByItsRules) {
  ASSERT_EQ(run("fit " + kData + "no_load_torque.csv --out " + file("friction.json")), 0) << output_;
  EXPECT_EQ(output_.find("WARNING"), std::string::npos) << output_;
  ASSERT_EQ(run("fit " + kData + "no_load_torque.csv --non-increasing rules --rules-from data --out " +
                file("friction.json")),
            0);
  EXPECT_NE(output_.find("WARNING: Coulomb friction rises by 3.8 % towards 6.2 degC"), std::string::npos)
      << output_;
}

TEST_F(DesignProgram, FitRefusesWhatIsNoCatalogue) {
  const std::string running = "temperature_C,torque_500rpm_Ncm,torque_2000rpm_Ncm,starting_torque_Ncm\n";
  const std::vector<std::pair<std::string, std::string>> cases{
      {"temperature_C,torque_500rpm_Ncm,torque_500.0rpm_Ncm\n-10,5,5\n0,4,4\n9,3,3\n", "torque_500.0rpm_Ncm"},
      {running + "-10,11,28,1e308\n15,3,7,3\n40,2,3,3\n", ":2: static friction"},
      {running + "-10,11,28,9\n15,3,7,-1\n40,2,3,3\n", ":3: static friction"},
      {running + "-300,11,28,9\n15,3,7,3\n40,2,3,3\n", ":2: temperature_C = -300"},
      {"temperature_C,viscous_Ncm_per_rpm,coulomb_Ncm,static_Ncm\n0,1e-3,5,4\n9,1e-3,2,3\n20,1e-3,2,3\n",
       ":2: static friction"},
      {running + "-10,11,28,9\n15,3,7,3\n15,2,3,3\n", ":4: temperatures must ascend"},
  };
  for (const auto& [csv, mentions] : cases) {
    write_text_file(file("bad.csv"), csv);
    EXPECT_EQ(run("fit " + file("bad.csv") + " --out " + file("friction.json")), 2) << csv << output_;
    EXPECT_NE(output_.find(mentions), std::string::npos) << mentions << "\n" << output_;
    EXPECT_FALSE(std::filesystem::exists(file("friction.json"))) << csv;
  }
  // A byte order mark is not part of the data.
  write_text_file(file("bom.csv"),
                  "\xEF\xBB\xBF" + running + "-10,11.5,28,7.6\n15,3.2,7.2,3.4\n40,1.8,3.2,3\n");
  EXPECT_EQ(run("fit " + file("bom.csv") + " --out " + file("friction.json")), 0) << output_;
}

TEST_F(DesignProgram, VerifyEndsWith1ForATamperedTable) {
  std::string text = read_text_file(kData + "tables/c4.json");
  GainTable table = gain_table_from_json(text, "test");
  for (double& gain : table.primary.F[2]) gain = -gain;
  write_text_file(file("table.json"), to_json(table));
  EXPECT_EQ(run("verify " + file("table.json")), 1);
  EXPECT_NE(output_.find("NOT CERTIFIED"), std::string::npos);
}

TEST_F(DesignProgram, ATableByForwardEulerIsForTheSourceOnly) {
  ASSERT_EQ(
      run("gains --sampling euler --friction " + kData + "fuzzy_rules_table5.csv --out " + file("t.json")), 0)
      << output_;
  EXPECT_NE(output_.find("reproducing Zhao (2006) only"), std::string::npos) << output_;
  EXPECT_EQ(output_.find("certified"), std::string::npos) << output_;
  EXPECT_EQ(run("verify " + file("t.json")), 1);
}

TEST_F(DesignProgram, AnInfeasibleRequestLeavesAMessageAndNoFile) {
  EXPECT_EQ(run("gains --friction " + kData + "fuzzy_rules_table5.csv --max-torque_Nm 0.001 --out " +
                file("table.json")),
            1);
  EXPECT_NE(output_.find("--max-torque_Nm"), std::string::npos) << output_;
  EXPECT_FALSE(std::filesystem::exists(file("table.json")));
}

TEST_F(DesignProgram, FrictionMeasuredAtOneTemperatureCorrectsTheCatalogueAtAll) {
  constexpr double kFactor = 1.5, kMeasured_C = 20.0;
  const FuzzyFriction catalogue = catalogue_friction(*find_gear("csf-25-100"), "csf-25-100").rules.friction;
  const auto torque_Nm = [](const FuzzyFriction& friction, double temperature_C, double speed_rad_s) {
    return stribeck_friction_Nm(friction.blend(friction.weights(temperature_C)), friction.velocity.stribeck(),
                                speed_rad_s);
  };
  CommissionRecord record;
  for (const double speed_rad_s : {0.1, 0.2, 0.4, 0.7})
    record.friction.push_back(
        {speed_rad_s, kMeasured_C, {kFactor * torque_Nm(catalogue, kMeasured_C, speed_rad_s), 0.05}});
  write_commission_record(folder_, record);
  ASSERT_EQ(
      run("fit --gear csf-25-100 --record " + file("commission.json") + " --out " + file("friction.json")), 0)
      << output_;
  const FuzzyFriction fitted = read_friction_rules(file("friction.json"), 100.0, GearSide::kJoint).friction;
  const auto factor = [&](double temperature_C, double speed_rad_s) {
    return torque_Nm(fitted, temperature_C, speed_rad_s) / torque_Nm(catalogue, temperature_C, speed_rad_s);
  };
  for (const double speed_rad_s : {0.15, 0.5}) {
    EXPECT_NEAR(factor(kMeasured_C, speed_rad_s), kFactor, 0.03 * kFactor) << speed_rad_s;
    for (const double temperature_C : {-10.0, 0.0, 40.0})
      EXPECT_NEAR(factor(temperature_C, speed_rad_s), kFactor, 0.1 * kFactor)
          << temperature_C << " degC, " << speed_rad_s << " rad/s";
  }
}

TEST_F(DesignProgram, FrictionOfARecordNeedsItsTemperatureAndAGear) {
  CommissionRecord record;
  record.friction = {{0.1, std::nan(""), {9.0, 0.1}}};
  write_commission_record(folder_, record);
  const std::string fit = "fit --record " + file("commission.json") + " --out " + file("friction.json");
  EXPECT_EQ(run(fit), 2);
  EXPECT_NE(output_.find("--gear"), std::string::npos) << output_;
  EXPECT_EQ(run(fit + " --gear csf-25-100"), 2);
  EXPECT_NE(output_.find("temperature is not known"), std::string::npos) << output_;
}

TEST_F(DesignProgram, AMeasuredStiffnessScalesTheSlopesOfTheBox) {
  ASSERT_EQ(
      run("gains --gear csf-17-50 --load-inertia_kgm2 0.095..0.1 --damping_Nms_rad 1 --stiffness_Nm_rad "
          "7290..7290 --out " +
          file("t.json")),
      0)
      << output_;
  const GainTable made = read_gain_table(file("t.json"));
  EXPECT_NEAR(made.box.stiffness_Nm_rad.from, 0.9 * 8100.0, 1e-6);
  EXPECT_NEAR(made.box.stiffness_Nm_rad.to, 0.9 * 13000.0, 1e-6);
}

TEST_F(DesignProgram, BadInputIsNamed) {
  EXPECT_EQ(run("gains --friction " + kData + "fuzzy_rules_table5.csv --period_s -1 --out " + file("t.json")),
            2);
  EXPECT_NE(output_.find("period_s"), std::string::npos) << output_;
  const std::string rules = "gains --gear csf-17-50 --period_s -1 --out t.json --friction " + kData;
  (void)run(rules + "fuzzy_rules_table5.csv");
  EXPECT_EQ(output_.find("WARNING"), std::string::npos) << output_;
  for (const char* wrong : {"fuzzy_rules_table4.csv", "fuzzy_rules_table5.csv --rules-side motor"}) {
    (void)run(rules + wrong);
    EXPECT_NE(output_.find("Coulomb friction at the joint"), std::string::npos) << wrong << ": " << output_;
  }
  EXPECT_EQ(run("gains --friction /nonexistent.json --out " + file("t.json")), 2);
  EXPECT_NE(output_.find("/nonexistent.json"), std::string::npos) << output_;
  EXPECT_EQ(run("fit " + kData + "rhs17_datasheet.csv --out " + file("f.json")), 2);
  EXPECT_NE(output_.find("rhs17_datasheet.csv"), std::string::npos) << output_;
  EXPECT_NE(run("gains --frobnicate"), 0);
  EXPECT_NE(run(""), 0);
}

TEST_F(DesignProgram, TheSameSeedGivesTheSameFile) {
  const std::string fit = "fit " + kData + "friction_parameters.csv --weighting source --seed 3 --out ";
  ASSERT_EQ(run(fit + file("a.json") + " --threads 1"), 0) << output_;
  ASSERT_EQ(run(fit + file("b.json") + " --threads 3"), 0) << output_;
  EXPECT_EQ(read_text_file(file("a.json")), read_text_file(file("b.json")));
}

TEST_F(DesignProgram, AllControllersAtOnce) {
  ASSERT_EQ(
      run("gains --controller all --friction " + kData + "fuzzy_rules_table5.csv --out " + folder_.string()),
      0)
      << output_;
  for (const char* const name : {"c1.json", "c2.json", "c3.json", "c4.json"})
    EXPECT_EQ(run("verify " + file(name)), 0) << output_;
}

}  // namespace
}  // namespace strainwave
