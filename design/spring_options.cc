// SPDX-License-Identifier: BSD-3-Clause
#include "design/spring_options.h"

#include <CLI/CLI.hpp>

#include "base/csv.h"
#include "base/input_error.h"
#include "base/printable.h"
#include "control/table/box_certificate.h"

namespace strainwave {

namespace {

constexpr double kLeastInertia_kgm2 = 1e-6;

BoxRange parse_range(const std::string& place, const std::string& key, const std::string& text,
                     double least) {
  const std::size_t dots = text.find("..");
  const double from = parse_number(text.substr(0, dots), place, key);
  const double to = dots == std::string::npos ? from : parse_number(text.substr(dots + 2), place, key);
  if (!(from >= least && from <= to))
    throw InputError(place, key, text, "must be FROM..TO, ascending, from " + number_text(least));
  return {from, to};
}

// "2..3kg@0.4m": masses of a point at this distance from the joint's axis; or inertias.
BoxRange parse_load(const std::string& place, const std::string& key, const std::string& text) {
  if (text.find_first_of("kg@") == std::string::npos)
    return parse_range(place, key, text, kLeastInertia_kgm2);
  const std::size_t at = text.find("kg@");
  if (at == std::string::npos || !text.ends_with("m"))
    throw InputError(place, key, text, "must be MASSkg@RADIUSm, such as 3kg@0.4m");
  const BoxRange mass_kg = parse_range(place, key, text.substr(0, at), 0.0);
  const double radius_m = parse_number(text.substr(at + 3, text.size() - at - 4), place, key);
  const BoxRange load{mass_kg.from * radius_m * radius_m, mass_kg.to * radius_m * radius_m};
  if (!(load.from >= kLeastInertia_kgm2 && radius_m > 0.0))
    throw InputError(place, key, text, "must be of a mass and a radius above 0");
  return load;
}

}  // namespace

void add_spring_options(CLI::App& command, SpringOptions& options) {
  CLI::Option* const load = command.add_option("--load-inertia_kgm2,--load", options.load_inertia_kgm2,
                                               "also for a flexible joint, with a link inertia of FROM..TO, "
                                               "or of a mass at a radius, such as 3kg@0.4m");
  command
      .add_option(
          "--motor-inertia_kgm2", options.motor_inertia_kgm2,
          "its inertia before the spring, at the joint (default: of the catalogue's actuator with the gear)")
      ->needs(load);
  command
      .add_option("--damping_Nms_rad", options.damping_Nms_rad,
                  "the spring's damping, FROM..TO or one number")
      ->needs(load)
      ->capture_default_str();
  command
      .add_option("--delay", options.delay_periods,
                  "periods between a torque's computation and its effect, FROM..TO or one number")
      ->needs(load)
      ->capture_default_str();
}

SpringRequest spring_request(const SpringOptions& options, const std::string& place,
                             double motor_inertia_kgm2) {
  SpringRequest request;
  request.motor_inertia_kgm2 = motor_inertia_kgm2;
  if (!(request.motor_inertia_kgm2 >= kLeastInertia_kgm2))
    throw InputError(place, "--motor-inertia_kgm2", number_text(request.motor_inertia_kgm2),
                     "must be the inertia on the motor's side of the spring, at the joint");
  request.link_inertia_kgm2 = parse_load(place, "--load-inertia_kgm2", options.load_inertia_kgm2);
  request.damping_Nms_rad = parse_range(place, "--damping_Nms_rad", options.damping_Nms_rad, 0.0);
  const BoxRange delays = parse_range(place, "--delay", options.delay_periods, 0.0);
  request.least_delay = static_cast<int>(delays.from);
  request.most_delay = static_cast<int>(delays.to);
  if (delays.to > kMaxSpringDelay || delays.from != request.least_delay || delays.to != request.most_delay)
    throw InputError(place, "--delay", options.delay_periods,
                     "must be whole periods, at most " + std::to_string(kMaxSpringDelay));
  return request;
}

namespace {

constexpr int kMostCells = 300;

void add_cells(CertifiedBox& box, const SpringProof& proof, const SpringLoop& loop) {
  const Eigen::Index left_out = loop.has_integrator ? 0 : 1;  // zeros
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
  const SpringBox box =
      spring_box(table.friction, gear, request.motor_inertia_kgm2, request.link_inertia_kgm2);
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

// `table` with its box, but for the cells. The longest delay first: it is the hardest.
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
