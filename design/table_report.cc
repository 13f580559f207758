// SPDX-License-Identifier: BSD-3-Clause
#include "design/table_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>

#include "control/table/box_certificate.h"

namespace strainwave {

namespace {

[[gnu::format(printf, 1, 2)]] std::string format(const char* pattern, ...) {
  std::array<char, 512> text{};
  va_list arguments;
  va_start(arguments, pattern);
  std::vsnprintf(text.data(), text.size(), pattern, arguments);
  va_end(arguments);
  return text.data();
}

template <std::size_t N>
std::string str(const FixedString<N>& text) {
  return std::string(text.view());
}

// Links whose spring may have any stiffness of the box at every instant. For every delay, their cells hold
// the whole range of stiffness. A range that begins at the heaviest link or above is empty.
BoxRange links_with_any_stiffness(const CertifiedBox& box) {
  BoxRange links = box.link_inertia_kgm2;
  for (std::size_t i = 0; i < static_cast<std::size_t>(box.cell_count); ++i) {
    if (!box.cells[i].stiffness_Nm_rad.holds(box.stiffness_Nm_rad))
      links.from = std::max(links.from, box.cells[i].link_inertia_kgm2.to);
  }
  return links;
}

std::string gains_text(const FeedbackGains& gains) {
  std::string text =
      format("gains: %s, %s, %s\n", str(gains.controller).c_str(),
             gains.has_integrator ? "with integrator" : "without integrator",
             gains.scheduled() ? "scheduled by temperature and velocity" : "one gain, no temperature");
  text += format(
      "  cost weights: integral %g, position %g, velocity %g, torque %g; decay rate %g; cost bound %.6g\n",
      gains.weights.integral, gains.weights.position, gains.weights.velocity, gains.weights.torque,
      gains.decay_rate, gains.cost_bound);
  text += "  rule                    integral        error     velocity\n";
  text += "                      [Nm/(rad s)]     [Nm/rad]   [Nm s/rad]\n";
  for (int j = 0; j < gains.rule_count; ++j) {
    const GainRow F = gains.gain(j);
    const std::string rule = !gains.scheduled() ? "every"
                             : j == 0           ? "zero velocity"
                                                : "high velocity, T" + std::to_string(j);
    text += format("  %-18s %13.4f %12.4f %12.5f\n", rule.c_str(), F(0), F(1), F(2));
  }
  return text;
}

}  // namespace

std::string stiffness_text(const CertifiedBox& box) {
  if (box.rigid()) return "";
  const BoxRange links = links_with_any_stiffness(box);
  if (!(links.from < links.to)) return "  the stiffness may change within a cell only, whatever the link\n";
  const double from_kgm2 = 1e-4 * std::ceil(1e4 * links.from);
  std::string text =
      format("  the stiffness may change at any instant with links of %.4g..%.4g kg m2", from_kgm2, links.to);
  if (links.from > box.link_inertia_kgm2.from) text += ", with lighter ones within a cell only";
  return text + "\n";
}

std::string description(const GainTable& table) {
  const PlantIdentity& plant = table.plant;
  std::string text = format("Gain table \"%s\" (format %d)\n", str(table.name).c_str(), table.format);
  text += format("  for joint %s: inertia %g kg m^2 at the joint, ratio %g, period %g s\n",
                 str(plant.joint_model).c_str(), plant.inertia_kgm2, plant.gear_ratio, plant.period_s);
  if (!plant.gear.view().empty()) text += "  gear " + str(plant.gear) + "\n";
  text += "  certified for: " + describe(table.box) + "\n";
  text += format(
      "  (%d cells; for the state feedback, not for observer, planned motion or friction feed-forward)\n",
      table.box.cell_count);
  text += stiffness_text(table.box);
  text += format("  torque limit %g Nm; temperature %g to %g degC\n", table.torque_limit_Nm,
                 table.friction.temperature_min_C, table.friction.temperature_max_C);
  text += "\nfriction rules (joint side)\n";
  text += "  rule  center [degC]  width [degC]  static [Nm]  Coulomb [Nm]  viscous [Nm s/rad]\n";
  for (std::size_t i = 0; i < static_cast<std::size_t>(table.friction.rule_count); ++i) {
    const TemperatureRule& rule = table.friction.rules[i];
    text += format("  T%-3zu %14.4f %13.4f %12.5f %13.5f %19.6f\n", i + 1, rule.center_C, rule.width_C,
                   rule.friction.static_Nm, rule.friction.coulomb_Nm, rule.friction.viscous_Nms_rad);
  }
  text += "\n" + gains_text(table.primary);
  text += format("\ncreated %s by %s, %s\nfriction file sha256 %s\n",
                 str(table.provenance.created_utc).c_str(), str(table.provenance.tool).c_str(),
                 table.provenance.sampling == Sampling::kForwardEuler ? "forward Euler" : "zero-order hold",
                 str(table.provenance.friction_sha256).c_str());
  if (!table.provenance.note.view().empty()) text += "note: " + str(table.provenance.note) + "\n";
  return text;
}

}  // namespace strainwave
