// SPDX-License-Identifier: BSD-3-Clause
#include "design/gains/spring_verdict.h"

#include <cstddef>
#include <vector>

#include "control/joint/gear_catalogue.h"
#include "control/table/box_certificate.h"

namespace strainwave {

namespace {

constexpr int kMostCells = 300;

void add_cells(CertifiedBox& box, const SpringProof& proof, const SpringLoop& loop) {
  const Eigen::Index left_out = loop.has_integrator ? 0 : 1;  // the integral's entries stay 0
  for (const ProvedCell& proved : proof.cells) {
    BoxCell& cell = box.cells.at(static_cast<std::size_t>(box.cell_count++));
    cell = {loop.delay_periods, proved.box.stiffness_Nm_rad, proved.box.link_inertia_kgm2, {}};
    const Eigen::Index n = proved.P.rows() + left_out;
    std::size_t entry = 0;
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = i; j < n; ++j, ++entry)
        if (i >= left_out) cell.P.at(entry) = proved.P(i - left_out, j - left_out);
  }
}

CertifiedBox requested_box(const GainTable& table, const std::string& gear, const SpringRequest& request) {
  SpringBox box = spring_box(table.friction, gear, request.motor_inertia_kgm2, request.link_inertia_kgm2);
  if (request.stiffness_1_Nm_rad) {
    const double catalogue = find_gear(gear)->spring.stiffness_1_Nm_rad;
    box.stiffness_Nm_rad.from *= request.stiffness_1_Nm_rad->from / catalogue;
    box.stiffness_Nm_rad.to *= request.stiffness_1_Nm_rad->to / catalogue;
  }
  return {table.box.encoder_side,
          box.motor_inertia_kgm2,
          box.link_inertia_kgm2,
          box.stiffness_Nm_rad,
          request.damping_Nms_rad,
          request.least_delay,
          request.most_delay,
          table.box.lead_periods,
          0,
          {}};
}

// `table` has its box without the cells. Begins with the longest delay, which is the hardest.
SpringVerdict judge(const GainTable& table, bool for_a_table) {
  const std::vector<GainRow> gains = gains_of(table);
  const char* const joint = table.box.rigid() ? "rigid, delay " : "with the spring, delay ";
  SpringVerdict verdict;
  verdict.box = table.box;
  for (int delay = table.box.most_delay; delay >= table.box.least_delay; --delay) {
    const int room = for_a_table ? kMaxBoxCells - verdict.box.cell_count : kMostCells;
    const SpringLoop loop = loop_of(table, delay);
    const BoxCell whole{delay, table.box.stiffness_Nm_rad, table.box.link_inertia_kgm2, {}};
    const SpringProof proof = prove_spring_box(gains, spring_box(table, whole), loop, room);
    verdict.certified = verdict.certified && proof.outcome == SpringOutcome::kCertified;
    verdict.text += joint + std::to_string(delay) + ": " + describe(proof) + "\n";
    if (for_a_table && !verdict.certified) break;
    if (for_a_table) add_cells(verdict.box, proof, loop);
  }
  return verdict;
}

}  // namespace

SpringVerdict judge_on_spring(const GainTable& table, const std::string& gear, const SpringRequest& request) {
  GainTable other = table;
  other.box = requested_box(table, gear, request);
  return judge(other, false);
}

SpringVerdict box_on_spring(const GainTable& table, const std::string& gear, const SpringRequest& request) {
  GainTable other = table;
  other.box = requested_box(table, gear, request);
  return judge(other, true);
}

SpringVerdict box_of_rigid(const GainTable& table) {
  GainTable other = table;
  other.box = {};
  other.box.encoder_side = table.box.encoder_side;
  other.box.most_delay = kMaxBoxDelay;
  return judge(other, true);
}

}  // namespace strainwave
