// SPDX-License-Identifier: BSD-3-Clause
#include "control/table/box_certificate.h"

#include <algorithm>
#include <iomanip>
#include <limits>
#include <span>
#include <sstream>
#include <vector>

#include "control/table/positive_definite.h"

namespace strainwave {

namespace {

std::string text_of(const BoxRange& range) {
  std::ostringstream text;
  text << std::setprecision(10) << range.from;
  if (range.to != range.from) text << ".." << range.to;
  return text.str();
}

std::string periods_text(const BoxRange& range) {
  return text_of(range) + (range.to == 1.0 ? " period" : " periods");
}

std::span<const BoxCell> cells_of(const CertifiedBox& box) {
  return std::span(box.cells).first(static_cast<std::size_t>(box.cell_count));
}

// Where cells begin or end within `whole`, sorted, with the ends of `whole` as first and last. Equal edges may repeat: a cell beside
// them covers the empty interval between them.
std::vector<double> edges(const BoxRange& whole, std::span<const BoxCell> cells, BoxRange BoxCell::*range) {
  std::vector<double> all{whole.from, whole.to};
  for (const BoxCell& cell : cells)
    for (const double edge : {(cell.*range).from, (cell.*range).to})
      if (whole.holds(edge)) all.push_back(edge);
  std::ranges::sort(all);
  return all;
}

// The first rectangle between edges that no cell of this delay covers.
std::optional<std::string> find_gap(const CertifiedBox& box, int delay_periods) {
  const std::span<const BoxCell> cells = cells_of(box);
  const std::vector<double> K = edges(box.stiffness_Nm_rad, cells, &BoxCell::stiffness_Nm_rad);
  const std::vector<double> J = edges(box.link_inertia_kgm2, cells, &BoxCell::link_inertia_kgm2);
  for (std::size_t k = 1; k < K.size(); ++k) {
    for (std::size_t j = 1; j < J.size(); ++j) {
      const BoxRange stiffness{K[k - 1], K[k]};
      const BoxRange inertia{J[j - 1], J[j]};
      const bool covered = std::ranges::any_of(cells, [&](const BoxCell& cell) {
        return cell.delay_periods == delay_periods && cell.stiffness_Nm_rad.holds(stiffness) &&
               cell.link_inertia_kgm2.holds(inertia);
      });
      if (covered) continue;
      const std::string text = "no cell for a delay of " + std::to_string(delay_periods);
      if (box.rigid()) return text;
      return text + ", stiffness " + text_of(stiffness) + " N m/rad, link " + text_of(inertia) + " kg m2";
    }
  }
  return std::nullopt;
}

std::string outside(const char* quantity, const std::string& value, const std::string& allowed) {
  return std::string(quantity) + " = " + value + ": the table is certified for " + allowed;
}

}  // namespace

SpringLoop loop_of(const GainTable& table, int delay_periods) {
  const CertifiedBox& box = table.box;
  return {table.plant.period_s, delay_periods,      box.encoder_side,
          box.lead_periods,     box.plant_states(), table.primary.has_integrator != 0};
}

ProofMatrix lyapunov_of(const GainTable& table, const BoxCell& cell) {
  const int n = loop_states(table.box.plant_states(), cell.delay_periods, table.box.lead_periods);
  ProofMatrix P(n, n);
  std::size_t entry = 0;
  for (int i = 0; i < n; ++i)
    for (int j = i; j < n; ++j) P(i, j) = P(j, i) = cell.P[entry++];
  const int states = loop_of(table, cell.delay_periods).states();
  return P.bottomRightCorner(states, states);
}

SpringBox spring_box(const GainTable& table, const BoxCell& cell) {
  const double whole_kgm2 = table.plant.inertia_kgm2;
  return {table.box.rigid() ? BoxRange{whole_kgm2, whole_kgm2} : table.box.motor_inertia_kgm2,
          cell.link_inertia_kgm2,
          cell.stiffness_Nm_rad,
          table.box.damping_Nms_rad,
          {0.0, table.friction.largest_viscous_Nms_rad()}};
}

// Rule 0 has no friction: A = [1 h 0; 0 1 h; 0 0 1], B = [0, h^2 / 2 J, h / J].
bool proves_slow_part(const FeedbackGains& gains, const PlantIdentity& plant) {
  const Bounded h = plant.period_s;
  BoundedMatrix A(ProofMatrix::Identity(kMaxStates, kMaxStates));
  A.set(0, 1, h);
  A.set(1, 2, h);
  BoundedMatrix B(kMaxStates, 1);
  B.set(1, 0, Bounded(0.5) * h * h / plant.inertia_kgm2);
  B.set(2, 0, h / plant.inertia_kgm2);
  const BoundedMatrix P(gains.lyapunov(0));
  const BoundedMatrix H = A + B * BoundedMatrix(ProofMatrix(gains.gain(0)));
  const BoundedMatrix fall = P - H.transpose() * (P * H);
  return test_positive_definite(P.value, P.error, kMaxStates).certain &&
         test_positive_definite(fall.value, fall.error, kMaxStates).certain;
}

BoxReport certify_box(const GainTable& table) {
  BoxReport report;
  const CertifiedBox& box = table.box;
  for (int delay = box.least_delay; delay <= box.most_delay; ++delay) {
    if (const auto gap = find_gap(box, delay)) return {false, 0, *gap};
  }
  const std::vector<GainRow> gains = gains_of(table);
  double margin = std::numeric_limits<double>::infinity();
  for (const BoxCell& cell : cells_of(box)) {
    const SpringReport proof = certify(gains, spring_box(table, cell), loop_of(table, cell.delay_periods),
                                       lyapunov_of(table, cell), kMostBoxInequalities - report.inequalities);
    report.inequalities += proof.inequalities;
    if (proof.certified && proof.margin >= margin) continue;
    margin = proof.margin;
    report.text = "margin " + describe(proof) + ", delay " + std::to_string(cell.delay_periods);
    if (!proof.certified) return report;
  }
  report.certified = true;
  return report;
}

namespace {

std::optional<std::string> find_spring_outside(const CertifiedBox& box, const LinkModel& link) {
  const TorsionSpring& spring = link.spring;
  const auto [least, most] =
      std::minmax({spring.stiffness_1_Nm_rad, spring.stiffness_2_Nm_rad, spring.stiffness_3_Nm_rad});
  if (!box.motor_inertia_kgm2.holds(link.motor_inertia_kgm2))
    return outside("joint.motor_inertia_kgm2", text_of({link.motor_inertia_kgm2, link.motor_inertia_kgm2}),
                   text_of(box.motor_inertia_kgm2) + " kg m2");
  if (!box.link_inertia_kgm2.holds(link.link_inertia_kgm2))
    return outside("joint.load_inertia_kgm2", text_of({link.link_inertia_kgm2, link.link_inertia_kgm2}),
                   text_of(box.link_inertia_kgm2) + " kg m2");
  if (!box.stiffness_Nm_rad.holds(BoxRange{least, most}))
    return outside("the stiffness of joint.gear", text_of({least, most}),
                   text_of(box.stiffness_Nm_rad) + " N m/rad");
  if (link.damping_Nms_rad > 0.0 && !box.damping_Nms_rad.holds(link.damping_Nms_rad))
    return outside("joint.damping_Nms_rad", text_of({link.damping_Nms_rad, link.damping_Nms_rad}),
                   text_of(box.damping_Nms_rad) + " N m s/rad");
  return std::nullopt;
}

}  // namespace

std::optional<std::string> find_outside_box(const GainTable& table, const std::optional<LinkModel>& link,
                                            int delay_periods) {
  const CertifiedBox& box = table.box;
  if (box.rigid() && link)
    return "the table is for a rigid joint: a flexible joint needs a table of strainwave-design gains "
           "--gear --motor-inertia_kgm2 --load-inertia_kgm2 --delay";
  if (!box.rigid() && !link)
    return "the table is for a flexible joint: a rigid joint needs a table of strainwave-design gains "
           "--inertia_kgm2 without --load-inertia_kgm2";
  if (link)
    if (auto outside_spring = find_spring_outside(box, *link)) return outside_spring;
  const bool proves_nothing = box.cell_count == 0;  // certify_box() reports it
  if (!proves_nothing && (delay_periods < box.least_delay || delay_periods > box.most_delay))
    return outside("delay_periods", std::to_string(delay_periods),
                   periods_text({static_cast<double>(box.least_delay), static_cast<double>(box.most_delay)}));
  return std::nullopt;
}

std::string describe(const CertifiedBox& box) {
  const std::string delays =
      "delay " + periods_text({static_cast<double>(box.least_delay), static_cast<double>(box.most_delay)}) +
      ", encoder on the " + to_text(box.encoder_side);
  if (box.cell_count == 0) return std::string("nothing; encoder on the ") + to_text(box.encoder_side);
  if (box.rigid()) return "a rigid joint: one inertia, no spring, " + delays;
  return "motor " + text_of(box.motor_inertia_kgm2) + " kg m2, link " + text_of(box.link_inertia_kgm2) +
         " kg m2, stiffness " + text_of(box.stiffness_Nm_rad) + " N m/rad, damping " +
         text_of(box.damping_Nms_rad) + " N m s/rad, " + delays +
         (box.lead_periods == 0.0 ? "" : ", lead " + periods_text({box.lead_periods, box.lead_periods}));
}

}  // namespace strainwave
