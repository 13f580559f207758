// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/admission/table_admission.h"

#include <sodium.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <iomanip>
#include <span>
#include <sstream>
#include <vector>

#include "control/table/box_certificate.h"
#include "control/table/gain_table_json.h"
#include "control/table/spring_certificate.h"
#include "lcmtypes/gain_table_message.h"
#include "lcmtypes/wire.h"

namespace strainwave {

namespace {

std::int64_t digest_of(std::span<const std::uint8_t> bytes) {
  std::array<unsigned char, crypto_generichash_BYTES> hash{};
  crypto_generichash(hash.data(), hash.size(), bytes.data(), bytes.size(), nullptr, 0);
  std::int64_t digest = 0;
  std::memcpy(&digest, hash.data(), sizeof digest);
  return digest == 0 ? 1 : digest;
}

constexpr double kTolerance = 1e-9;
// Assumed share of critical damping for a joint whose damping is unknown: the least that a structure has. Without damping no loop
// would be strictly stable.
constexpr double kStructuralDamping = 0.01;

// Checks what anti-windup assumes of these gains; the proof of the box's cells does not cover it.
TableVerdict judge_antiwindup(const FeedbackGains& gains, const PlantIdentity& plant) {
  if (gains.has_integrator == 0 || proves_slow_part(gains, plant)) return {};
  return {
      Reason::kTableNotCertified,
      "gains " + std::string(gains.controller.view()) +
          ": anti-windup is not proved on this joint, since P of rule 0 does not decrease; design the table "
          "for it with strainwave-design gains"};
}

// The worst corner of the spring's stiffnesses, the extremes of viscous friction, and all gains.
WorstCorner worst_on_spring(const GainTable& table, const LinkModel& link, const SpringLoop& loop) {
  const std::vector<GainRow> gains = gains_of(table);
  const double most_viscous_Nms_rad = table.friction.largest_viscous_Nms_rad();
  WorstCorner worst;
  for (const double stiffness :
       {link.spring.stiffness_1_Nm_rad, link.spring.stiffness_2_Nm_rad, link.spring.stiffness_3_Nm_rad}) {
    const double damping = link.damping_Nms_rad > 0.0
                               ? link.damping_Nms_rad
                               : structural_damping_Nms_rad(link.motor_inertia_kgm2, link.link_inertia_kgm2,
                                                            stiffness, kStructuralDamping);
    const SpringBox box{{link.motor_inertia_kgm2, link.motor_inertia_kgm2},
                        {link.link_inertia_kgm2, link.link_inertia_kgm2},
                        {stiffness, stiffness},
                        {damping, damping},
                        {0.0, most_viscous_Nms_rad}};
    const WorstCorner here = worst_corner(gains, box, loop);
    if (!(here.radius <= worst.radius)) worst = here;
  }
  return worst;
}

// Refuses gains that are unstable on this flexible joint.
TableVerdict judge_on_spring(const GainTable& table, const ExpectedJoint& joint) {
  const WorstCorner worst = worst_on_spring(table, *joint.link, loop_of(table, joint.delay_periods));
  if (worst.radius < 1.0) return {};
  std::ostringstream text;
  text << std::setprecision(5) << "these gains are unstable on this joint's spring: eigenvalue "
       << worst.radius << " a period, below 1 is allowed, at " << describe(worst.plant)
       << ", delay_periods = " << joint.delay_periods
       << "; design softer gains with strainwave-design gains --gear "
       << (joint.plant.gear.view().empty() ? "NAME" : joint.plant.gear.view()) << " --motor-inertia_kgm2 "
       << worst.plant.motor_inertia_kgm2 << " --load-inertia_kgm2 " << worst.plant.link_inertia_kgm2
       << " --delay " << joint.delay_periods;
  if (joint.link->damping_Nms_rad > 0.0) text << " --damping_Nms_rad " << joint.link->damping_Nms_rad;
  return {Reason::kTableNotCertified, text.str()};
}

// Checks that the table is designed for a joint like this.
TableVerdict judge_identity(const GainTable& table, const ExpectedJoint& joint) {
  if (const auto mismatch = find_identity_mismatch(
          table, joint.plant,
          joint.link && !table.box.rigid() ? InertiaCheck::kOfTheBox : InertiaCheck::kSame))
    return {Reason::kTableIdentity, *mismatch};
  if (table.box.encoder_side != joint.encoder_side)
    return {Reason::kTableIdentity, std::string("box.encoder_side = ") + to_text(table.box.encoder_side) +
                                        ": this joint's encoder is on the " + to_text(joint.encoder_side) +
                                        ": design the table with --encoder-side " +
                                        to_text(joint.encoder_side)};
  // A drive that closes its own loop needs no proof of the daemon's loop.
  if (!joint.law_acts) return {};
  if (const auto outside = find_outside_box(table, joint.link, joint.delay_periods))
    return {Reason::kTableIdentity, *outside};
  return {};
}

// The smaller of the two limits applies. The certificate holds for torque below the limit, so a smaller limit keeps it valid. It may,
// however, be below the torque that the cold joint's friction needs.
std::string which_torque_limit_holds(const GainTable& table, double torque_limit_Nm) {
  if (std::abs(table.torque_limit_Nm - torque_limit_Nm) <= kTolerance * torque_limit_Nm) return "";
  const bool lowered = torque_limit_Nm < table.torque_limit_Nm;
  const double holds_Nm = lowered ? torque_limit_Nm : table.torque_limit_Nm;
  std::ostringstream text;
  text << "; torque limit " << holds_Nm << " N.m, "
       << (lowered ? "from joint.limits.torque_limit_Nm, below the table's "
                   : "from the table, below joint.limits.torque_limit_Nm = ")
       << (lowered ? table.torque_limit_Nm : torque_limit_Nm);
  const TemperatureRule& coldest = table.friction.rules.front();
  if (coldest.friction.static_Nm >= holds_Nm)
    text << "; at " << coldest.center_C << " degC static friction is " << coldest.friction.static_Nm
         << " N.m, and the joint will not move";
  return text.str();
}

// For example, that its friction is an estimate.
std::string note_of(const GainTable& table) {
  const std::string_view note = table.provenance.note.view();
  return note.empty() ? "" : "; " + std::string(note);
}

}  // namespace

TableVerdict judge_box(const GainTable& table) {
  const BoxReport report = certify_box(table);
  if (report.certified)
    return {Reason::kAccepted, "; certified for " + describe(table.box) + ": " + report.text};
  return {Reason::kTableNotCertified, "box: " + report.text + ": stability is not proved (" +
                                          describe(table.box) +
                                          "); design the table again with strainwave-design gains"};
}

TableVerdict judge_table(const GainTable& table, const ExpectedJoint& joint) {
  TableVerdict verdict = judge_table_but_box(table, joint);
  if (verdict.reason != Reason::kAccepted || !joint.law_acts) return verdict;
  TableVerdict box = judge_box(table);
  if (box.reason != Reason::kAccepted) return box;
  verdict.text += box.text;
  return verdict;
}

TableVerdict judge_table_but_box(const GainTable& table, const ExpectedJoint& joint) {
  const PlantIdentity& expected = joint.plant;
  if (const auto defect = find_defect(table)) return {Reason::kTableDefect, *defect};
  if (std::abs(table.plant.period_s - expected.period_s) > kTolerance * expected.period_s) {
    std::ostringstream text;
    text << "period_s = " << table.plant.period_s << " in the table, " << expected.period_s
         << " in this daemon: design the table with --period_s " << expected.period_s;
    return {Reason::kTablePeriod, text.str()};
  }
  TableVerdict identity = judge_identity(table, joint);
  if (identity.reason != Reason::kAccepted) return identity;
  if (!joint.law_acts)
    return {
        Reason::kAccepted,
        "its friction and inertia are used; the drive closes its own loop, whose stability is not proved" +
            note_of(table)};
  // A rigid joint is judged with its own inertia. A flexible joint lies in a box of inertias; the table's design inertia counts then.
  const PlantIdentity& plant = joint.link ? table.plant : expected;
  TableVerdict verdict = judge_antiwindup(table.primary, plant);
  if (verdict.reason != Reason::kAccepted) return verdict;
  if (joint.link) verdict = judge_on_spring(table, joint);
  if (verdict.reason != Reason::kAccepted) return verdict;
  verdict.text = std::string(table.primary.controller.view()) +
                 which_torque_limit_holds(table, joint.torque_limit_Nm) + note_of(table);
  return verdict;
}

std::int64_t table_digest(const GainTable& table) {
  return digest_of(encode(to_message(table)));
}

std::int64_t friction_rules_digest(const FuzzyFriction& friction) {
  std::vector<std::uint8_t> bytes;
  const auto add = [&bytes](double value) {
    const auto raw = std::bit_cast<std::array<std::uint8_t, sizeof value>>(value);
    bytes.insert(bytes.end(), raw.begin(), raw.end());
  };
  for (std::size_t i = 0; i < static_cast<std::size_t>(friction.rule_count); ++i) {
    const TemperatureRule& rule = friction.rules[i];
    add(rule.center_C);
    add(rule.width_C);
    add(rule.friction.static_Nm);
    add(rule.friction.coulomb_Nm);
    add(rule.friction.viscous_Nms_rad);
  }
  return digest_of(bytes);
}

}  // namespace strainwave
