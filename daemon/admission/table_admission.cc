#include "daemon/admission/table_admission.h"

#include <sodium.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iomanip>
#include <sstream>

#include "control/certificate.h"
#include "control/spring_certificate.h"
#include "lcmtypes/gain_table_message.h"
#include "lcmtypes/wire.h"

namespace strainwave {

namespace {

constexpr double kTolerance = 1e-9;
// What the structure of any joint damps at least, of critical damping: without it nothing would be stable to the last digit.
constexpr double kStructuralDamping = 0.01;

TableVerdict judge_gains(const char* which, const FeedbackGains& gains, const PlantIdentity& plant,
                         const FuzzyFriction& friction) {
  const CertificateReport report = certify(gains, plant, friction);
  std::ostringstream text;
  text << which << " gains " << gains.controller.view() << ": margin " << describe(report.worst);
  if (report.certified) return {Reason::kAccepted, text.str()};
  text << ": stability is not proved for this joint; design the table for it with strainwave-design gains";
  return {Reason::kTableNotCertified, text.str()};
}

// Damping of the swing of motor and link against each other, which have (Jm Jl) / (Jm + Jl) together.
double least_damping_Nms_rad(const LinkModel& link, double stiffness_Nm_rad) {
  const double inertia_kgm2 =
      link.motor_inertia_kgm2 * link.link_inertia_kgm2 / (link.motor_inertia_kgm2 + link.link_inertia_kgm2);
  return std::max(link.damping_Nms_rad,
                  2.0 * kStructuralDamping * std::sqrt(stiffness_Nm_rad * inertia_kgm2));
}

struct LinkSwing {
  SpringPlant plant;
  double radius = 0.0;
};

// The largest eigenvalue of the loop over the slopes, the extremes of viscous friction, and every gain of both controllers.
LinkSwing worst_swing(const GainTable& table, const LinkModel& link, const SpringLoop& loop) {
  double most_viscous_Nms_rad = 0.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(table.friction.rule_count); ++i)
    most_viscous_Nms_rad = std::max(most_viscous_Nms_rad, table.friction.rules[i].friction.viscous_Nms_rad);
  LinkSwing worst;
  for (const double stiffness :
       {link.spring.stiffness_1_Nm_rad, link.spring.stiffness_2_Nm_rad, link.spring.stiffness_3_Nm_rad})
    for (const double viscous : {0.0, most_viscous_Nms_rad})
      for (const FeedbackGains* gains : {&table.primary, &table.fallback})
        for (int rule = 0; rule < gains->rule_count; ++rule) {
          const SpringPlant plant{link.motor_inertia_kgm2, link.link_inertia_kgm2, stiffness,
                                  least_damping_Nms_rad(link, stiffness), viscous};
          const double radius = spring_loop_radius(plant, gains->gain(rule), loop);
          if (!(radius <= worst.radius)) worst = {plant, radius};
        }
  return worst;
}

// On a joint that is told of its spring.
TableVerdict judge_on_spring(const GainTable& table, const ExpectedJoint& joint) {
  const LinkSwing worst = worst_swing(table, *joint.link, {joint.plant.period_s, joint.delay_periods, 1.0});
  if (worst.radius < 1.0)
    return {Reason::kAccepted,
            "; of a rigid joint: strainwave-design verify says what is proved of the spring"};
  std::ostringstream text;
  text << std::setprecision(5) << "the link swings up under these gains: eigenvalue " << worst.radius
       << " a period, below 1 is allowed, at " << describe(worst.plant)
       << ", delay_periods = " << joint.delay_periods
       << "; design softer ones with strainwave-design gains --gear " << joint.plant.gear.view()
       << " --motor-inertia_kgm2 " << worst.plant.motor_inertia_kgm2 << " --load-inertia_kgm2 "
       << worst.plant.link_inertia_kgm2 << " --delay " << joint.delay_periods;
  return {Reason::kTableNotCertified, text.str()};
}

// The smaller of the two holds. Certified is what happens below it, so that a smaller one takes no proof away; it may take the torque
// that the cold joint's friction needs.
std::string which_torque_limit_holds(const GainTable& table, double torque_limit_Nm) {
  if (std::abs(table.torque_limit_Nm - torque_limit_Nm) <= kTolerance * torque_limit_Nm) return "";
  const bool lowered = torque_limit_Nm < table.torque_limit_Nm;
  const double holds_Nm = lowered ? torque_limit_Nm : table.torque_limit_Nm;
  std::ostringstream text;
  text << "; torque limit " << holds_Nm << " N.m, "
       << (lowered ? "joint.limits.torque_limit_Nm, below the table's "
                   : "the table's, below joint.limits.torque_limit_Nm = ")
       << (lowered ? table.torque_limit_Nm : torque_limit_Nm);
  const TemperatureRule& coldest = table.friction.rules.front();
  if (coldest.friction.static_Nm >= holds_Nm)
    text << "; the joint at " << coldest.center_C << " degC withstands " << coldest.friction.static_Nm
         << " N.m and will not move there";
  return text.str();
}

}  // namespace

TableVerdict judge_table(const GainTable& table, const ExpectedJoint& joint) {
  const PlantIdentity& expected = joint.plant;
  if (const auto defect = find_defect(table)) return {Reason::kTableDefect, *defect};
  if (std::abs(table.plant.period_s - expected.period_s) > kTolerance * expected.period_s) {
    std::ostringstream text;
    text << "period_s = " << table.plant.period_s << " in the table, " << expected.period_s
         << " in this daemon: design the table with --period_s " << expected.period_s;
    return {Reason::kTablePeriod, text.str()};
  }
  if (const auto mismatch = find_identity_mismatch(table, expected))
    return {Reason::kTableIdentity, *mismatch};
  TableVerdict primary = judge_gains("primary", table.primary, expected, table.friction);
  if (primary.reason != Reason::kAccepted) return primary;
  TableVerdict fallback = judge_gains("fallback", table.fallback, expected, table.friction);
  if (fallback.reason != Reason::kAccepted) return fallback;
  if (joint.link) {
    TableVerdict spring = judge_on_spring(table, joint);
    if (spring.reason != Reason::kAccepted) return spring;
    primary.text += spring.text;
  }
  primary.text += which_torque_limit_holds(table, joint.torque_limit_Nm);
  return primary;
}

std::int64_t table_digest(const GainTable& table) {
  const auto bytes = encode(to_message(table));
  std::array<unsigned char, crypto_generichash_BYTES> hash{};
  crypto_generichash(hash.data(), hash.size(), bytes.data(), bytes.size(), nullptr, 0);
  std::int64_t digest = 0;
  std::memcpy(&digest, hash.data(), sizeof digest);
  return digest == 0 ? 1 : digest;
}

}  // namespace strainwave
