#include "daemon/admission/table_admission.h"

#include <gtest/gtest.h>

#include "control/gain_table_json.h"
#include "control/gear_catalogue.h"

namespace strainwave {
namespace {

class TableAdmission : public ::testing::Test {
 protected:
  GainTable table_ = read_gain_table(STRAINWAVE_SOURCE_DIR "/data/tables/rhs17-6006.json");
  PlantIdentity joint_ = table_.plant;
  double torque_limit_Nm_ = table_.torque_limit_Nm;

  Reason judge() const { return judge_table(table_, {joint_, torque_limit_Nm_, {}, 1}).reason; }
};

TEST_F(TableAdmission, AcceptsTheTableForItsOwnJoint) {
  EXPECT_EQ(judge(), Reason::kAccepted);
}

TEST_F(TableAdmission, RefusesOtherPeriodsInertiasRatiosModelsAndGears) {
  joint_.period_s *= 1.001;
  EXPECT_EQ(judge(), Reason::kTablePeriod);
  joint_ = table_.plant;
  joint_.inertia_kgm2 *= 1.001;
  EXPECT_EQ(judge(), Reason::kTableIdentity);
  joint_ = table_.plant;
  joint_.gear_ratio = 100.0;
  EXPECT_EQ(judge(), Reason::kTableIdentity);
  joint_ = table_.plant;
  joint_.joint_model = FixedString<32>("another");
  EXPECT_EQ(judge(), Reason::kTableIdentity);
  joint_ = table_.plant;
  joint_.gear = FixedString<32>("csf-17-50");
  EXPECT_EQ(judge(), Reason::kAccepted) << "the table names none";
  table_.plant.gear = FixedString<32>("csf-20-50");
  EXPECT_EQ(judge(), Reason::kTableIdentity);
}

TEST_F(TableAdmission, SaysWhichOfTwoTorqueLimitsHoldsAndWhereTheJointCannotMoveWithIt) {
  const auto text = [&](double torque_limit_Nm) {
    const TableVerdict verdict = judge_table(table_, {joint_, torque_limit_Nm, {}, 1});
    EXPECT_EQ(verdict.reason, Reason::kAccepted) << torque_limit_Nm;
    return verdict.text;
  };
  EXPECT_EQ(text(34.0).find("torque limit"), std::string::npos);
  EXPECT_NE(text(20.0).find("torque limit 20 N.m, joint.limits.torque_limit_Nm, below the table's 34"),
            std::string::npos)
      << text(20.0);
  EXPECT_EQ(text(20.0).find("will not move"), std::string::npos);
  EXPECT_NE(text(3.4).find("will not move there"), std::string::npos) << text(3.4);
  EXPECT_NE(text(50.0).find("torque limit 34 N.m, the table's, below joint.limits.torque_limit_Nm = 50"),
            std::string::npos)
      << text(50.0);
}

TEST_F(TableAdmission, RefusesEverySingleGainWhoseSignIsTurned) {
  const GainTable sound = table_;
  for (int rule = 0; rule < sound.primary.rule_count; ++rule) {
    table_ = sound;
    auto& gain = table_.primary.F[static_cast<std::size_t>(rule)];
    gain[1] = -gain[1];
    EXPECT_EQ(judge(), Reason::kTableNotCertified) << "rule " << rule;
  }
  table_ = sound;
  table_.fallback.F[0][2] = -table_.fallback.F[0][2];
  EXPECT_EQ(judge(), Reason::kTableNotCertified);
}

TEST_F(TableAdmission, RefusesTheSourcesTablesWhateverTheySayOfTheirSampling) {
  table_ = read_gain_table(STRAINWAVE_SOURCE_DIR "/data/tables/c4.json");
  EXPECT_EQ(judge(), Reason::kTableNotCertified);
  table_.provenance.sampling = Sampling::kZeroOrderHold;
  EXPECT_EQ(judge(), Reason::kTableNotCertified);
}

TEST_F(TableAdmission, RefusesFrictionThatTheMotorCouldNotOvercome) {
  for (TemperatureRule& rule : table_.friction.rules) {
    rule.friction.static_Nm *= 1000.0;
    rule.friction.coulomb_Nm *= 1000.0;
  }
  const TableVerdict verdict = judge_table(table_, {joint_, torque_limit_Nm_, {}, 1});
  EXPECT_EQ(verdict.reason, Reason::kTableDefect);
  EXPECT_NE(verdict.text.find("static_Nm"), std::string::npos) << verdict.text;
}

TEST_F(TableAdmission, TheDigestNamesTheContent) {
  const std::int64_t digest = table_digest(table_);
  EXPECT_NE(digest, 0);
  EXPECT_EQ(table_digest(table_), digest);
  table_.primary.F[3][0] *= 1.0 + 1e-15;
  EXPECT_NE(table_digest(table_), digest);
}

class TableAdmissionOnASpring : public ::testing::Test {
 protected:
  /// A table of the study on its joint with the gear csf-17-50.
  static TableVerdict judge(const std::string& total, double link_kgm2, int delay_periods) {
    const GainTable table = read_gain_table(STRAINWAVE_SOURCE_DIR "/data/tables/" + total + "/c4.json");
    const LinkModel link{
        table.plant.inertia_kgm2 - link_kgm2, link_kgm2, find_gear("csf-17-50")->spring, 0.0, {}};
    return judge_table(table, {table.plant, table.torque_limit_Nm, link, delay_periods});
  }
};

TEST_F(TableAdmissionOnASpring, AcceptsWhatDoesNotSwingTheLinkUpAndSaysThatNothingMoreIsProved) {
  for (const auto& [total, link] : {std::pair{"total-0.119", 0.03}, std::pair{"total-0.178", 0.089},
                                    std::pair{"total-0.356", 0.267}, std::pair{"total-1.089", 1.0}}) {
    const TableVerdict verdict = judge(total, link, 1);
    EXPECT_EQ(verdict.reason, Reason::kAccepted) << verdict.text;
    EXPECT_NE(verdict.text.find("verify says what is proved of the spring"), std::string::npos)
        << verdict.text;
  }
}

TEST_F(TableAdmissionOnASpring, RefusesGainsUnderWhichTheLinkSwingsUpWithTheConfiguredDelay) {
  for (const auto& [total, link] : {std::pair{"total-0.178", 0.089}, std::pair{"total-0.356", 0.267}}) {
    const TableVerdict verdict = judge(total, link, 2);
    EXPECT_EQ(verdict.reason, Reason::kTableNotCertified) << verdict.text;
    EXPECT_NE(verdict.text.find("eigenvalue 1.0"), std::string::npos) << verdict.text;
    EXPECT_NE(verdict.text.find("delay_periods = 2"), std::string::npos) << verdict.text;
    EXPECT_NE(verdict.text.find("stiffness 13000"), std::string::npos) << verdict.text;
  }
}

}  // namespace
}  // namespace strainwave
