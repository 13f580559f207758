// SPDX-License-Identifier: BSD-3-Clause
#include "control/table/box_certificate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "base/input_error.h"
#include "control/joint/gear_catalogue.h"
#include "control/table/gain_table_json.h"
#include "tests/support/eigenvalues.h"
#include "tests/support/reference_joint.h"

namespace strainwave {
namespace {

using Matrix5 = Eigen::Matrix<double, 5, 5>;

LinkModel joint_with(double link_kgm2, double motor_kgm2 = 0.089) {
  return {motor_kgm2, link_kgm2, find_gear("csf-17-50")->spring, 0.0, {}};
}

TEST(BoxCertificate, ProvesLinksOf50To300GramsAtBothDelaysWhateverTheDamping) {
  const GainTable table = testing::shipped_table("csf-17-50-delays");
  EXPECT_EQ(table.box.least_delay, 1);
  EXPECT_EQ(table.box.most_delay, 2);
  EXPECT_LE(table.box.link_inertia_kgm2.from, 0.05);
  EXPECT_GE(table.box.link_inertia_kgm2.to, 0.3);
  EXPECT_EQ(table.box.damping_Nms_rad.from, 0.0);
  const BoxReport report = certify_box(table);
  EXPECT_TRUE(report.certified) << report.text;
  EXPECT_LE(report.inequalities, kMostBoxInequalities);
}

// The lead is part of what is proved.
TEST(BoxCertificate, RefusesATableWithAnotherLead) {
  for (const double lead_periods : {0.5, 1.0, 4.0}) {
    GainTable table = testing::shipped_table("csf-17-50-delays");
    table.box.lead_periods = lead_periods;
    EXPECT_EQ(find_defect(table), std::nullopt);
    EXPECT_FALSE(certify_box(table).certified) << lead_periods;
  }
  GainTable without = testing::shipped_table("csf-17-50-delays");
  without.box.lead_periods = 0.0;
  EXPECT_NE(find_defect(without).value_or("").find("must be 0"), std::string::npos);
  GainTable more = testing::shipped_table("csf-17-50-delays");
  more.box.lead_periods = 1.01 * kMaxLeadPeriods;
  EXPECT_NE(find_defect(more).value_or("").find("box.lead_periods"), std::string::npos);
  GainTable rigid = testing::shipped_table("csf-17-50-delays");
  rigid.box = {};
  rigid.box.lead_periods = 2.0;
  EXPECT_NE(find_defect(rigid).value_or("").find("rigid box"), std::string::npos);
}

// Not by the proof's own interpolation or matrices: the loop written down by hand, sampled in 100 steps, at any place of the box.
void expect_every_loop_inside_the_unit_circle(const GainTable& table) {
  const CertifiedBox& box = table.box;
  std::mt19937_64 random(21);
  const auto any = [&](const BoxRange& range) {
    return std::uniform_real_distribution<double>(range.from, range.to)(random);
  };
  const double h = table.plant.period_s;
  double largest = 0.0;
  for (int i = 0; i < 200; ++i) {
    const double K = any(box.stiffness_Nm_rad);
    const double Jl = any(box.link_inertia_kgm2);
    const double Jm = any(box.motor_inertia_kgm2);
    const double D = any(box.damping_Nms_rad);
    const double b = any({0.0, table.friction.largest_viscous_Nms_rad()});
    // Motor and link positions and velocities, and the torque: d/dt.
    Matrix5 M = Matrix5::Zero();
    M.row(0) << 0, 1, 0, 0, 0;
    M.row(1) << -K / Jm, -(D + b) / Jm, K / Jm, D / Jm, 1 / Jm;
    M.row(2) << 0, 0, 0, 1, 0;
    M.row(3) << K / Jl, D / Jl, -K / Jl, -D / Jl, 0;
    const Matrix5 step = M * (h / 128.0);
    Matrix5 sampled = Matrix5::Identity() + step + step * step / 2 + step * step * step / 6 +
                      step * step * step * step / 24;
    for (int k = 0; k < 7; ++k) sampled = (sampled * sampled).eval();
    for (const GainRow& gain : gains_of(table)) {
      for (int delay = box.least_delay; delay <= box.most_delay; ++delay) {
        // [integral, thm, wm, thl, wl, last thm, torques under way, last law]
        const int n = 7 + delay;
        Eigen::RowVectorXd u = Eigen::RowVectorXd::Zero(n);
        u(0) = gain(0);
        u(1) = gain(1) + gain(2) / h;
        u(5) = -gain(2) / h;
        Eigen::MatrixXd H = Eigen::MatrixXd::Zero(n, n);
        H.row(n - 1) = u;
        u *= 1.0 + box.lead_periods;
        u(n - 1) = -box.lead_periods;
        H(0, 0) = 1.0;
        H(0, 1) = h;
        H(5, 1) = 1.0;
        H.block<4, 4>(1, 1) = sampled.topLeftCorner<4, 4>();
        if (delay == 0) {
          H.middleRows<4>(1) += sampled.topRightCorner<4, 1>() * u;
        } else {
          H.block<4, 1>(1, n - 2) = sampled.topRightCorner<4, 1>();
          H.row(6) = u;
          for (int k = 1; k < delay; ++k) H(6 + k, 5 + k) = 1.0;
        }
        largest = std::max(largest, testing::spectral_radius(H));
      }
    }
  }
  EXPECT_LT(largest, 1.0);
  EXPECT_GT(largest, 0.9) << "a loop that forgets within ten periods is not this one";
}

TEST(BoxCertificate, EveryLoopAtRandomPlacesOfTheBoxIsInsideTheUnitCircle) {
  for (const GainTable& table :
       {testing::shipped_table("csf-17-50"), testing::shipped_table("csf-17-50-delays")}) {
    SCOPED_TRACE(table.box.lead_periods);
    expect_every_loop_inside_the_unit_circle(table);
  }
}

TEST(BoxCertificate, RefusesATableWithOneMatrixOrOneGainChanged) {
  const GainTable sound = testing::shipped_table("csf-17-50");
  for (const int i : {0, 1, 3}) {
    GainTable table = sound;
    table.box.cells[static_cast<std::size_t>(i)].P[0] *= -1.0;
    const BoxReport report = certify_box(table);
    EXPECT_FALSE(report.certified) << i;
  }
  GainTable table = sound;
  table.primary.F[2][1] *= -1.0;
  EXPECT_FALSE(certify_box(table).certified);
  table = sound;
  table.primary.F[0][2] *= 4.0;
  const BoxReport report = certify_box(table);
  EXPECT_FALSE(report.certified);
  EXPECT_NE(report.text.find("stiffness"), std::string::npos) << report.text;
  EXPECT_NE(report.text.find("delay"), std::string::npos) << report.text;
}

TEST(BoxCertificate, RefusesABoxThatIsOnePerCentWiderThanItsCells) {
  const auto text_with = [](const auto& change) {
    GainTable table = testing::shipped_table("csf-17-50");
    change(table.box);
    EXPECT_EQ(find_defect(table), std::nullopt);
    const BoxReport report = certify_box(table);
    EXPECT_FALSE(report.certified);
    return report.text;
  };
  const auto says = [](const std::string& text) {
    return text.find("no cell for a delay") != std::string::npos;
  };
  EXPECT_TRUE(says(text_with([](CertifiedBox& box) { box.link_inertia_kgm2.to *= 1.01; })));
  EXPECT_TRUE(says(text_with([](CertifiedBox& box) { box.link_inertia_kgm2.from *= 0.99; })));
  EXPECT_TRUE(says(text_with([](CertifiedBox& box) { box.stiffness_Nm_rad.to *= 1.01; })));
  EXPECT_TRUE(says(text_with([](CertifiedBox& box) { box.stiffness_Nm_rad.from *= 0.99; })));
  EXPECT_TRUE(says(text_with([](CertifiedBox& box) { box.least_delay = 0; })));
}

TEST(BoxCertificate, RefusesABoxWithAnyCellLeftOut) {
  for (const char* name : {"csf-17-50", "rhs17-6006"}) {
    const GainTable sound = testing::shipped_table(name);
    for (int i = 0; i < sound.box.cell_count; ++i) {
      GainTable table = sound;
      CertifiedBox& box = table.box;
      box.cells[static_cast<std::size_t>(i)] = box.cells[static_cast<std::size_t>(--box.cell_count)];
      box.cells[static_cast<std::size_t>(box.cell_count)] = {};
      ASSERT_EQ(find_defect(table), std::nullopt);
      EXPECT_NE(certify_box(table).text.find("no cell for a delay of"), std::string::npos) << name << i;
    }
  }
}

// Within a few per cent of their design the motors of the shipped tables are proved; one of half the inertia is not.
TEST(BoxCertificate, AMotorOfHalfTheInertiaIsNotProved) {
  for (const char* name : {"csf-17-50", "csf-17-50-delays", "csf-17-50-link"}) {
    GainTable table = testing::shipped_table(name);
    EXPECT_LT(table.box.motor_inertia_kgm2.from, 0.089) << name;
    EXPECT_GT(table.box.motor_inertia_kgm2.to, 0.089) << name;
    table.box.motor_inertia_kgm2.from *= 0.5;
    EXPECT_EQ(find_defect(table), std::nullopt);
    const BoxReport report = certify_box(table);
    EXPECT_FALSE(report.certified) << name;
    EXPECT_NE(report.text.find("motor"), std::string::npos) << report.text;
  }
}

// With the links that `strainwave-design show` names there is one P for every stiffness: it may be another in every period.
TEST(BoxCertificate, TheStiffnessMayChangeAtAnyInstantWhereTheTableSaysSo) {
  const CertifiedBox box = testing::shipped_table("csf-17-50-delays").box;
  for (const double link_kgm2 : {0.08, 0.19, box.link_inertia_kgm2.to})
    EXPECT_TRUE(std::ranges::any_of(box.cells, [&](const BoxCell& any) {
      return any.link_inertia_kgm2.holds(link_kgm2) && any.stiffness_Nm_rad.holds(box.stiffness_Nm_rad);
    })) << link_kgm2;
}

// A table whose statement is made to hold all slopes at any instant, and which is not.
TEST(BoxCertificate, RefusesACellWhoseStiffnessIsMadeThatOfTheWholeBox) {
  const GainTable sound = testing::shipped_table("csf-17-50-link");
  for (int i = 0; i < sound.box.cell_count; ++i) {
    GainTable table = sound;
    table.box.cells[static_cast<std::size_t>(i)].stiffness_Nm_rad = table.box.stiffness_Nm_rad;
    EXPECT_FALSE(certify_box(table).certified) << i;
  }
}

TEST(BoxCertificate, HoldsJointsUpToItsEdgesAndNamesWhatIsOutside) {
  const GainTable table = testing::shipped_table("csf-17-50");
  const BoxRange& link = table.box.link_inertia_kgm2;
  const int delay = table.box.most_delay;
  EXPECT_EQ(find_outside_box(table, joint_with(link.from), delay), std::nullopt);
  EXPECT_EQ(find_outside_box(table, joint_with(link.to), delay), std::nullopt);
  const auto names = [&](const LinkModel& joint, int delay_periods, const char* quantity) {
    const std::string text = find_outside_box(table, joint, delay_periods).value_or("");
    EXPECT_NE(text.find(quantity), std::string::npos) << text;
    EXPECT_NE(text.find("certified for"), std::string::npos) << text;
  };
  names(joint_with(1.01 * link.to), delay, "load_inertia_kgm2");
  names(joint_with(0.99 * link.from), delay, "load_inertia_kgm2");
  const BoxRange& motor = table.box.motor_inertia_kgm2;
  EXPECT_EQ(find_outside_box(table, joint_with(link.to, motor.from), delay), std::nullopt);
  EXPECT_EQ(find_outside_box(table, joint_with(link.to, motor.to), delay), std::nullopt);
  names(joint_with(link.to, 0.99 * motor.from), delay, "joint.motor_inertia_kgm2");
  names(joint_with(link.to, 1.01 * motor.to), delay, "joint.motor_inertia_kgm2");
  names(joint_with(link.to), kMaxBoxDelay + 1, "delay_periods");
  LinkModel stiff = joint_with(link.to);
  stiff.spring = stiff.spring.scaled(1.01);
  names(stiff, delay, "stiffness");
  LinkModel damped = joint_with(link.to);
  for (const double within : {table.box.damping_Nms_rad.from, table.box.damping_Nms_rad.to}) {
    damped.damping_Nms_rad = within;
    EXPECT_EQ(find_outside_box(table, damped, delay), std::nullopt) << within;
  }
  for (const double without :
       {0.99 * table.box.damping_Nms_rad.from, 1.01 * table.box.damping_Nms_rad.to, 1e-6}) {
    damped.damping_Nms_rad = without;
    names(damped, delay, "joint.damping_Nms_rad");
  }
  GainTable rigid = table;
  rigid.box = {};
  EXPECT_NE(find_outside_box(rigid, joint_with(link.to), delay).value_or("").find("rigid joint"),
            std::string::npos);
}

TEST(BoxCertificate, GainsForTheMotorsEncoderAreNotProvedForTheLinksNorTheOtherWayRound) {
  for (const char* name : {"csf-17-50", "csf-17-50-link"}) {
    GainTable table = testing::shipped_table(name);
    const BoxReport report = certify_box(table);
    EXPECT_TRUE(report.certified) << name << ": " << report.text;
    EXPECT_NE(report.text.find("margin"), std::string::npos) << report.text;
    EXPECT_LE(report.inequalities, kMostBoxInequalities);
    const bool link = table.box.encoder_side == EncoderSide::kLink;
    table.box.encoder_side = link ? EncoderSide::kMotor : EncoderSide::kLink;
    EXPECT_EQ(find_defect(table), std::nullopt);
    EXPECT_FALSE(certify_box(table).certified) << name;
  }
}

}  // namespace
}  // namespace strainwave
