// SPDX-License-Identifier: BSD-3-Clause
#include "design/spring_design.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "base/input_error.h"
#include "base/printable.h"
#include "control/table/box_certificate.h"

namespace strainwave {

namespace {

constexpr int kQuarters = 4;  // steps in a decade of the torque's weight
// The weight of data/tables/csf-17-50-delays.json, the softest shipped gains; softer ones do not damp the link's oscillation. Motor
// and heaviest link of that table have kSoftestInertia_kgm2. The limit of a lighter joint is higher by the square of the inertias' ratio.
constexpr double kSoftestWeight = 1e-5;
constexpr double kSoftestInertia_kgm2 = 0.389;
constexpr int kNarrowings = 2;
// Widths of the range around one motor inertia. Data sheets and identification are mostly within the first.
constexpr std::array kMotorShares{0.05, 0.02};
constexpr int kSofterSteps = 8;  // of half a decade each
// With a torque that acts two periods late, the velocity of two readings is 2.5 periods old. For links of 0.05 to 0.3
// kg m2 behind a size 17 gear, 1.5 periods are too few without damping. There, 2.5 are too many for the stiffer gains.
constexpr double kLeadPeriods = 2.0;

std::string range_text(const BoxRange& range) {
  return number_text(range.from) + ".." + number_text(range.to);
}

SpringDesign search(Controller controller, TableRequest request, const std::string& gear,
                    const SpringRequest& spring, const DesignProgress& progress) {
  const double first = request.design.weights.torque;
  const double lighter = std::max(1.0, kSoftestInertia_kgm2 / request.design.plant.inertia_kgm2);
  const double softest = kSoftestWeight * lighter * lighter;
  SpringVerdict verdict;
  const auto try_weight = [&](int quarters) {
    request.design.weights.torque = first * std::pow(10.0, static_cast<double>(quarters) / kQuarters);
    progress("link " + range_text(spring.link_inertia_kgm2) + " kg m2, motor " +
             bound_text(spring.motor_inertia_kgm2.from) + ".." + bound_text(spring.motor_inertia_kgm2.to) +
             " kg m2, torque weight " + bound_text(request.design.weights.torque));
    GainTable table = design_table(controller, request);
    verdict = box_on_spring(table, gear, spring);
    if (!verdict.certified && request.encoder_side == EncoderSide::kMotor) {
      table.box.lead_periods = kLeadPeriods;
      const SpringVerdict with_lead = box_on_spring(table, gear, spring);
      if (with_lead.certified) verdict = with_lead;
    }
    if (verdict.certified) table.box = verdict.box;
    return table;
  };
  SpringDesign best{try_weight(0), {}};
  int refused = 0;
  int certified = 0;
  while (!verdict.certified) {
    refused = certified;
    certified += kQuarters;
    if (request.design.weights.torque > 0.999 * softest)
      throw NotAchieved("gains: no gains are certified for links of " + range_text(spring.link_inertia_kgm2) +
                        " kg m2, with torque weights of " + number_text(first) + " to " +
                        number_text(request.design.weights.torque) +
                        ". Narrow --load-inertia_kgm2 or --motor-inertia_kgm2, or " +
                        (spring.damping_Nms_rad.from > 0.0 ? "take a drive with less --delay. "
                                                           : "give a --damping_Nms_rad above 0. ") +
                        verdict.text);
    best.table = try_weight(certified);
  }
  best.text = verdict.text;
  while (certified - refused > 1) {
    const int middle = (certified + refused) / 2;
    const GainTable table = try_weight(middle);
    (verdict.certified ? certified : refused) = middle;
    if (verdict.certified) best = {table, verdict.text};
  }
  const BoxReport report = certify_box(best.table);
  if (!report.certified) throw NotAchieved("gains: the cells of the box are not certified: " + report.text);
  std::ostringstream text;
  text << "torque weight " << best.table.primary.weights.torque << "\n"
       << best.text << "the table's box: " << describe(best.table.box) << "\n";
  best.text = text.str();
  return best;
}

}  // namespace

GainTable design_rigid(Controller controller, const TableRequest& request) {
  GainTable table = design_table(controller, request);
  if (request.design.sampling != Sampling::kZeroOrderHold) return table;
  const SpringVerdict verdict = box_of_rigid(table);
  if (verdict.certified) {
    table.box = verdict.box;
    return table;
  }
  std::string text = "gains: the loop of these gains is not certified. " + verdict.text;
  TableRequest softer = request;
  for (int i = 0; i < kSofterSteps; ++i) {
    CostWeights& weights = softer.design.weights;
    weights.torque *= std::sqrt(10.0);
    if (!box_of_rigid(design_table(controller, softer)).certified) continue;
    std::ostringstream wanted;
    wanted << "Softer gains are certified: --weights " << weights.integral << "," << weights.position << ","
           << weights.velocity << "," << weights.torque;
    throw NotAchieved(text + wanted.str());
  }
  throw NotAchieved(text + "Gains with torque weights of up to " + number_text(softer.design.weights.torque) +
                    " are not certified either.");
}

namespace {

// The given range, or ranges around one number, the widest first.
std::vector<BoxRange> motors_to_try(const BoxRange& given) {
  if (given.from != given.to) return {given};
  std::vector<BoxRange> motors;
  motors.reserve(kMotorShares.size());
  for (const double share : kMotorShares)
    motors.push_back({(1.0 - share) * given.from, (1.0 + share) * given.to});
  return motors;
}

}  // namespace

SpringDesign design_on_spring(Controller controller, const TableRequest& request, const std::string& gear,
                              const SpringRequest& spring, const DesignProgress& progress) {
  SpringRequest tried = spring;
  std::string refusal;
  for (const BoxRange& motor : motors_to_try(spring.motor_inertia_kgm2)) {
    tried.motor_inertia_kgm2 = motor;
    try {
      SpringDesign found = search(controller, request, gear, tried, progress);
      if (!refusal.empty()) found.text += "with a wider range of motor inertias no gains are certified\n";
      return found;
    } catch (const NotAchieved& none) {
      refusal = none.what();
    }
  }
  // The lightest links are the hardest, so that the range is narrowed from their side.
  BoxRange& link = tried.link_inertia_kgm2;
  for (int i = 0; i < kNarrowings; ++i) {
    link.from = std::sqrt(link.from * link.to);
    try {
      search(controller, request, gear, tried, progress);
    } catch (const NotAchieved&) {
      continue;
    }
    throw NotAchieved(refusal + "\nA table is certified with --load-inertia_kgm2 " + range_text(link) +
                      " in place of --load or --load-inertia_kgm2.");
  }
  if (spring.motor_inertia_kgm2.from == spring.motor_inertia_kgm2.to)
    refusal +=
        "\nThe design tried ranges of 5 and 2 % around the motor inertia: give a narrower "
        "--motor-inertia_kgm2 FROM..TO.";
  throw NotAchieved(refusal);
}

}  // namespace strainwave
