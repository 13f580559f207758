// SPDX-License-Identifier: BSD-3-Clause
#include "design/exact/exact_certificate.h"

#include <stdexcept>

#include "design/exact/exact_spring.h"

namespace strainwave {

namespace {

/// Whether cells of this delay cover the rectangle: one holds it, or both parts of a cut at a cell's edge are covered.
bool is_covered(const CertifiedBox& box, int delay, const BoxRange& K, const BoxRange& Jl) {
  for (int i = 0; i < box.cell_count; ++i) {
    const BoxCell& cell = box.cells[static_cast<std::size_t>(i)];
    if (cell.delay_periods == delay && cell.stiffness_Nm_rad.holds(K) && cell.link_inertia_kgm2.holds(Jl))
      return true;
  }
  const auto inside = [](const BoxRange& range, double edge) { return edge > range.from && edge < range.to; };
  for (int i = 0; i < box.cell_count; ++i) {
    const BoxCell& cell = box.cells[static_cast<std::size_t>(i)];
    for (const double edge : {cell.stiffness_Nm_rad.from, cell.stiffness_Nm_rad.to})
      if (inside(K, edge))
        return is_covered(box, delay, {K.from, edge}, Jl) && is_covered(box, delay, {edge, K.to}, Jl);
    for (const double edge : {cell.link_inertia_kgm2.from, cell.link_inertia_kgm2.to})
      if (inside(Jl, edge))
        return is_covered(box, delay, K, {Jl.from, edge}) && is_covered(box, delay, K, {edge, Jl.to});
  }
  return false;
}

void prove_box(const GainTable& table, ExactReport& report) {
  const CertifiedBox& box = table.box;
  for (int delay = box.least_delay; delay <= box.most_delay; ++delay) {
    if (is_covered(box, delay, box.stiffness_Nm_rad, box.link_inertia_kgm2)) continue;
    report.certified = false;
    report.refusal = "no cell covers a part of the box with delay " + std::to_string(delay);
    return;
  }
  for (int i = 0; i < box.cell_count && report.certified; ++i)
    prove_cell(table, box.cells[static_cast<std::size_t>(i)], report);
}

}  // namespace

ExactReport certify_exactly(const GainTable& table) {
  ExactReport report{true, 0, {}};
  try {
    prove_box(table, report);
  } catch (const std::domain_error& error) {
    report.certified = false;
    report.refusal = error.what();
  }
  return report;
}

}  // namespace strainwave
