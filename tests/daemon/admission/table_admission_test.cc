// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/admission/table_admission.h"

#include <gtest/gtest.h>

#include <utility>

#include "control/joint/gear_catalogue.h"
#include "control/table/gain_table_json.h"

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

TEST_F(TableAdmission, SaysTheTablesNoteOnce) {
  const auto text = [&] { return judge_table(table_, {joint_, torque_limit_Nm_, {}, 1}).text; };
  EXPECT_EQ(text().find("estimate"), std::string::npos);
  table_.provenance.note = FixedString<64>("friction: estimate from the catalogue");
  const std::size_t place = text().find("friction: estimate from the catalogue");
  ASSERT_NE(place, std::string::npos) << text();
  EXPECT_EQ(text().find("estimate", place + 20), std::string::npos) << text();
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
  EXPECT_NE(text(20.0).find("torque limit 20 N.m, from joint.limits.torque_limit_Nm, below the table's 34"),
            std::string::npos)
      << text(20.0);
  EXPECT_EQ(text(20.0).find("will not move"), std::string::npos);
  EXPECT_NE(text(3.4).find("the joint will not move"), std::string::npos) << text(3.4);
  EXPECT_NE(text(50.0).find("torque limit 34 N.m, from the table, below joint.limits.torque_limit_Nm = 50"),
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
  table_.primary.F[0][2] = -table_.primary.F[0][2];
  EXPECT_EQ(judge(), Reason::kTableNotCertified);
}

// The box is proved. But the Lyapunov function that separates the integral's slow part would rise.
TEST_F(TableAdmission, RefusesAMatrixOfRuleZeroThatDoesNotFall) {
  StateMatrix P = table_.primary.lyapunov(0);
  P(0, 1) = P(1, 0) = 0.0;
  P(0, 2) = P(2, 0) = 0.0;
  table_.primary.set(0, table_.primary.gain(0), P);
  ASSERT_EQ(find_defect(table_), std::nullopt);
  const TableVerdict verdict = judge_table(table_, {joint_, torque_limit_Nm_, {}, 1});
  EXPECT_EQ(verdict.reason, Reason::kTableNotCertified);
  EXPECT_NE(verdict.text.find("anti-windup"), std::string::npos) << verdict.text;
}

TEST_F(TableAdmission, RefusesTheSourcesTablesWhateverTheySayOfTheirSampling) {
  table_ = read_gain_table(STRAINWAVE_SOURCE_DIR "/data/tables/c4.json");
  EXPECT_EQ(judge(), Reason::kTableNotCertified);
  table_.provenance.sampling = Sampling::kZeroOrderHold;
  EXPECT_EQ(judge(), Reason::kTableNotCertified);
}

// Gains of `gains --weights 0.1,1,1e-4,1e-9`: their eigenvalue at one period of delay is 1.105. With another table's proof or none.
TEST_F(TableAdmission, RefusesGainsThatAreStableWithoutDelayAlone) {
  const GainTable stiff =
      read_gain_table(STRAINWAVE_SOURCE_DIR "/tests/daemon/admission/stiff_without_delay.json");
  ASSERT_EQ(find_defect(stiff), std::nullopt);
  const CertifiedBox box = table_.box;
  table_ = stiff;
  EXPECT_EQ(judge(), Reason::kTableNotCertified);
  table_.box = box;
  EXPECT_EQ(judge(), Reason::kTableNotCertified);
}

TEST_F(TableAdmission, RefusesADelayBeyondTheTablesStatement) {
  for (const int delay_periods : {0, 1, 2, 3}) {
    const TableVerdict verdict = judge_table(table_, {joint_, torque_limit_Nm_, {}, delay_periods});
    EXPECT_EQ(verdict.reason, delay_periods <= 2 ? Reason::kAccepted : Reason::kTableIdentity)
        << verdict.text;
  }
  table_.box.most_delay = 1;  // its third cell is then outside of its box
  EXPECT_EQ(judge(), Reason::kTableDefect);
  table_.box.cells[0] = table_.box.cells[2];
  table_.box.cells[2] = {};
  table_.box.cell_count = 2;
  EXPECT_EQ(judge(), Reason::kAccepted);
  const TableVerdict verdict = judge_table(table_, {joint_, torque_limit_Nm_, {}, 2});
  EXPECT_EQ(verdict.reason, Reason::kTableIdentity);
  EXPECT_NE(verdict.text.find("delay_periods = 2: the table is certified for 0..1 period"), std::string::npos)
      << verdict.text;
}

TEST_F(TableAdmission, ARigidJointTakesNoTableOfAFlexibleOne) {
  table_ = read_gain_table(STRAINWAVE_SOURCE_DIR "/data/tables/csf-17-50.json");
  joint_ = table_.plant;
  EXPECT_EQ(judge(), Reason::kTableIdentity);
}

TEST_F(TableAdmission, ProvesNothingOfGainsThatDoNotActAndStillWantsTheJointsOwnFriction) {
  const auto judge_without_law = [&] {
    return judge_table(table_, {joint_, torque_limit_Nm_, {}, 1, EncoderSide::kMotor, false});
  };
  const TableVerdict verdict = judge_without_law();
  EXPECT_EQ(verdict.reason, Reason::kAccepted);
  EXPECT_NE(verdict.text.find("stability is not proved"), std::string::npos) << verdict.text;
  EXPECT_EQ(verdict.text.find("margin"), std::string::npos) << verdict.text;
  const GainTable stiff =
      read_gain_table(STRAINWAVE_SOURCE_DIR "/tests/daemon/admission/stiff_without_delay.json");
  const GainTable own = std::exchange(table_, stiff);
  EXPECT_EQ(judge_without_law().reason, Reason::kAccepted) << "its limit cycle is the law's";
  table_ = own;
  joint_.joint_model = FixedString<32>("another");
  EXPECT_EQ(judge_without_law().reason, Reason::kTableIdentity);
}

// Friction in N.cm instead of N.m.
TEST_F(TableAdmission, RefusesFrictionThatTheMotorCouldNotOvercome) {
  for (TemperatureRule& rule : table_.friction.rules) {
    rule.friction.static_Nm *= 100.0;
    rule.friction.coulomb_Nm *= 100.0;
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

TEST_F(TableAdmission, RefusesATableForTheOtherSideOfTheEncoder) {
  const auto verdict = [&](EncoderSide of_the_joint) {
    return judge_table(table_, {joint_, torque_limit_Nm_, {}, 1, of_the_joint});
  };
  EXPECT_EQ(verdict(EncoderSide::kMotor).reason, Reason::kAccepted);
  EXPECT_EQ(verdict(EncoderSide::kLink).reason, Reason::kTableIdentity);
  EXPECT_NE(verdict(EncoderSide::kLink).text.find("--encoder-side link"), std::string::npos);
  table_.box.encoder_side = EncoderSide::kLink;
  EXPECT_EQ(verdict(EncoderSide::kLink).reason, Reason::kTableNotCertified) << "its velocity is another";
  EXPECT_EQ(verdict(EncoderSide::kMotor).reason, Reason::kTableIdentity);
}

class TableAdmissionOnASpring : public ::testing::Test {
 protected:
  GainTable table_ = read_gain_table(STRAINWAVE_SOURCE_DIR "/data/tables/csf-17-50.json");

  /// On a joint with a link whose gear is configured as csf-17-50.
  ExpectedJoint joint_of(double link_kgm2, int delay_periods, double motor_kgm2 = 0.089,
                         EncoderSide side = EncoderSide::kMotor) const {
    PlantIdentity plant = table_.plant;
    plant.inertia_kgm2 = motor_kgm2 + link_kgm2;
    const LinkModel link{motor_kgm2, link_kgm2, find_gear("csf-17-50")->spring, 0.0, {}};
    return {plant, table_.torque_limit_Nm, link, delay_periods, side};
  }
  TableVerdict judge(double link_kgm2, int delay_periods, double motor_kgm2 = 0.089,
                     EncoderSide side = EncoderSide::kMotor) const {
    return judge_table(table_, joint_of(link_kgm2, delay_periods, motor_kgm2, side));
  }
  TableVerdict judge_damped(double damping_Nms_rad, double link_kgm2, int delay_periods) const {
    ExpectedJoint joint = joint_of(link_kgm2, delay_periods);
    joint.link->damping_Nms_rad = damping_Nms_rad;
    return judge_table_but_box(table_, joint);
  }
  void expect_outside(const TableVerdict& verdict, const char* quantity) const {
    EXPECT_EQ(verdict.reason, Reason::kTableIdentity) << verdict.text;
    EXPECT_NE(verdict.text.find(quantity), std::string::npos) << verdict.text;
    EXPECT_NE(verdict.text.find("certified for"), std::string::npos) << verdict.text;
  }
};

TEST_F(TableAdmissionOnASpring, TakesOnlyATableForTheSideOfItsEncoder) {
  EXPECT_EQ(judge(0.1, 1).reason, Reason::kAccepted);
  EXPECT_EQ(judge(0.1, 1, 0.089, EncoderSide::kLink).reason, Reason::kTableIdentity);
  table_ = read_gain_table(STRAINWAVE_SOURCE_DIR "/data/tables/csf-17-50-link.json");
  const TableVerdict proved = judge(0.1, 1, 0.089, EncoderSide::kLink);
  EXPECT_EQ(proved.reason, Reason::kAccepted) << proved.text;
  EXPECT_NE(proved.text.find("encoder on the link"), std::string::npos) << proved.text;
  const TableVerdict refused = judge(0.1, 1);
  EXPECT_EQ(refused.reason, Reason::kTableIdentity);
  EXPECT_NE(refused.text.find("--encoder-side motor"), std::string::npos) << refused.text;
}

TEST_F(TableAdmissionOnASpring, AcceptsEveryLinkOfTheBoxAndSaysWhatIsProved) {
  for (const double link_kgm2 : {0.05, 0.3}) {
    const TableVerdict verdict = judge(link_kgm2, 1);
    EXPECT_EQ(verdict.reason, Reason::kAccepted) << verdict.text;
    EXPECT_NE(verdict.text.find("certified for motor 0.08455..0.09345 kg m2, link 0.05..0.3 kg m2"),
              std::string::npos)
        << verdict.text;
  }
}

TEST_F(TableAdmissionOnASpring, AcceptsAMotorThatIsFivePerCentOffItsDataSheet) {
  for (const double motor_kgm2 : {0.0846, 0.0934})
    EXPECT_EQ(judge(0.1, 1, motor_kgm2).reason, Reason::kAccepted) << motor_kgm2;
}

TEST_F(TableAdmissionOnASpring, AcceptsBothDelaysWithATableThatHasALead) {
  table_ = read_gain_table(STRAINWAVE_SOURCE_DIR "/data/tables/csf-17-50-delays.json");
  for (const int delay_periods : {1, 2}) {
    const TableVerdict verdict = judge(0.05, delay_periods);
    EXPECT_EQ(verdict.reason, Reason::kAccepted) << verdict.text;
    EXPECT_NE(verdict.text.find("lead 2 periods"), std::string::npos) << verdict.text;
  }
  table_.box.lead_periods = 1.0;
  EXPECT_EQ(judge(0.05, 2).reason, Reason::kTableNotCertified);
}

TEST_F(TableAdmissionOnASpring, RefusesAJointOnePerCentOutsideTheBoxWithQuantityValueAndRange) {
  expect_outside(judge(0.303, 1), "load_inertia_kgm2 = 0.303: the table is certified for 0.05..0.3 kg m2");
  expect_outside(judge(0.0495, 1), "load_inertia_kgm2 = 0.0495");
  expect_outside(judge(0.1, 1, 0.0944),
                 "joint.motor_inertia_kgm2 = 0.0944: the table is certified for 0.08455..0.09345 kg m2");
  expect_outside(judge(0.1, 1, 0.0837), "joint.motor_inertia_kgm2 = 0.0837");
  expect_outside(judge(0.1, table_.box.most_delay + 1), "delay_periods");
}

TEST_F(TableAdmissionOnASpring, RefusesAJointThatIsToldOfADampingOutsideTheBox) {
  for (const double allowed_Nms_rad : {0.0, 0.8, 1.2})
    EXPECT_EQ(judge_damped(allowed_Nms_rad, 0.1, 1).reason, Reason::kAccepted) << allowed_Nms_rad;
  expect_outside(judge_damped(0.5, 0.1, 1),
                 "joint.damping_Nms_rad = 0.5: the table is certified for 0.8..1.2 N m s/rad");
  expect_outside(judge_damped(1.21, 0.1, 1), "joint.damping_Nms_rad = 1.21");
}

// With half of its lead, the table excites the oscillation of a light link with little damping.
TEST_F(TableAdmissionOnASpring, ReckonsWithTheDampingThatTheJointIsToldOf) {
  table_ = read_gain_table(STRAINWAVE_SOURCE_DIR "/data/tables/csf-17-50-delays.json");
  table_.box.lead_periods = 1.0;
  EXPECT_EQ(judge_damped(0.0, 0.05, 2).reason, Reason::kAccepted) << "1 % of critical: 0.3 N m s/rad";
  EXPECT_EQ(judge_damped(2.0, 0.05, 2).reason, Reason::kAccepted);
  const TableVerdict swings = judge_damped(0.1, 0.05, 2);
  EXPECT_EQ(swings.reason, Reason::kTableNotCertified);
  EXPECT_NE(swings.text.find("damping 0.1"), std::string::npos) << swings.text;
  EXPECT_NE(swings.text.find("--damping_Nms_rad 0.1"), std::string::npos) << swings.text;
}

TEST_F(TableAdmissionOnASpring, RefusesATableOfARigidJoint) {
  table_.box = {};
  table_.plant.inertia_kgm2 = 0.189;
  EXPECT_EQ(judge(0.1, 1).reason, Reason::kTableIdentity);
}

TEST_F(TableAdmissionOnASpring, RefusesATableWhoseBoxItCannotProve) {
  table_.box.cells[0].P[0] *= -1.0;
  const TableVerdict verdict = judge(0.1, 1);
  EXPECT_EQ(verdict.reason, Reason::kTableNotCertified) << verdict.text;
  EXPECT_NE(verdict.text.find("box: "), std::string::npos) << verdict.text;
}

}  // namespace
}  // namespace strainwave
