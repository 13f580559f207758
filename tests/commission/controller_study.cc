// SPDX-License-Identifier: BSD-3-Clause
// controller_study [JOINTS [FIRST]]: compares controllers from the results of commissioning with controllers from the true numbers, on random
// joints. Prints tables, and one line per joint on the standard error. Runs the strainwave-design in its folder, as `commission` does.
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <map>

#include "base/parallel.h"
#include "client/commands/commission_design.h"
#include "client/commands/sibling_program.h"
#include "commission/comparison.h"
#include "commission/identification.h"
#include "control/table/gain_table_json.h"
#include "sim/studies/flexible_study.h"
#include "sim/studies/statistics.h"
#include "sim/studies/text_table.h"
#include "tests/commission/random_joints.h"
#include "tests/support/temporary_folder.h"

namespace strainwave::testing {
namespace {

constexpr std::array kMoves_rad{0.01, 0.1, 1.0};
constexpr double kMove_s = 4.0;

/// The controller from the numbers of one record, and its results.
struct Outcome {
  std::optional<GainTable> table;
  JointPlantConfig model;               ///< the controller's model of the joint
  std::vector<FlexibleResult> results;  ///< one per move
};

struct Row {
  std::uint64_t seed = 0;
  bool measured = false;
  Outcome found, truth;
};

CommissionRecord record_of(const RandomJoint& joint, const JointEstimates& found) {
  ConfiguredNumbers nothing;
  nothing.delay_key = "delay_periods";
  nothing.period_s = joint.drive.plant.period_s;
  CommissionRecord record;
  record.values = compare_with(nothing, *found.motion);
  record.friction = found.friction;
  return record;
}

/// The record `found` with the true numbers in place of the measured ones.
CommissionRecord true_record(const RandomJoint& joint, const CommissionRecord& found,
                             const std::vector<Comparison>& compared) {
  const JointPlantConfig& plant = joint.drive.plant;
  CommissionRecord record = found;
  record.values.clear();
  std::map<std::string, double> truths;
  std::size_t speeds = 0;
  for (const Comparison& c : compared)
    if (c.quantity == "friction")
      record.friction[speeds++].torque_Nm.value = c.truth;
    else
      truths[c.quantity] = c.truth;
  const auto add = [&](const char* key, double value) {
    record.values.push_back({key, "", std::nullopt, {value, 0.0}, value});
  };
  add("motor_inertia_kgm2", truths.at("motor inertia"));
  add("load_inertia_kgm2", truths.at("link inertia"));
  add("stiffness_Nm_rad", truths.at("stiffness"));
  add("damping_Nms_rad", plant.effects.transmission->damping_Nms_rad);
  add("delay_periods", truths.at("delay") / plant.period_s);
  record.values.back().used = std::round(record.values.back().used);
  if (plant.effects.gravity.torque_Nm > 0.0) {
    add("control.gravity_Nm", plant.effects.gravity.torque_Nm);
    add("control.gravity_zero_rad", plant.effects.gravity.zero_rad);
  }
  return record;
}

/// The table that `commission` would make; nothing if no gains are certified.
std::optional<GainTable> design(const RandomJoint& joint, const CommissionRecord& record) {
  const TemporaryFolder folder;
  write_commission_record(folder.path(), record);
  const std::filesystem::path friction = folder.path() / "friction.json";
  const std::filesystem::path table = folder.path() / "table.json";
  const JointToDesign what{joint.gear, joint.gear, joint.drive.plant.period_s, false, 0.0};
  std::string printed;
  if (run_sibling("strainwave-design",
                  {"fit", "--record", (folder.path() / "commission.json").string(), "--gear", joint.gear,
                   "--joint-model", joint.gear, "--out", friction.string()},
                  &printed) == 0 &&
      run_sibling("strainwave-design", gains_arguments(record, what, friction, table), &printed) == 0)
    return read_gain_table(table);
  std::fputs(printed.c_str(), stderr);
  return std::nullopt;
}

/// The model of the joint according to the keys that `commission` sets in the configuration.
JointPlantConfig model_of(const RandomJoint& joint, const CommissionRecord& record) {
  JointPlantConfig model = joint.drive.plant;
  Transmission& gear = *model.effects.transmission;
  gear.damping_Nms_rad = 0.0;
  model.effects.gravity = {};
  const JointToDesign what{joint.gear, joint.gear, model.period_s, false, 0.0};
  for (const JointSetting& setting : measured_settings(record, what, "table.json")) {
    const double* const value = std::get_if<double>(&setting.value);
    if (value == nullptr) continue;
    if (setting.key == "motor_inertia_kgm2") model.joint.inertia_kgm2 = *value;
    if (setting.key == "load_inertia_kgm2") gear.link_inertia_kgm2 = *value;
    if (setting.key == "damping_Nms_rad") gear.damping_Nms_rad = *value;
    if (setting.key == "control.gravity_Nm") model.effects.gravity.torque_Nm = *value;
    if (setting.key == "control.gravity_zero_rad") model.effects.gravity.zero_rad = *value;
    if (setting.key == "stiffness_Nm_rad")
      gear.spring = joint.told.spring.scaled(*value / joint.told.spring.stiffness_1_Nm_rad);
  }
  model.delay.periods = find_value(record.values, "delay_periods")->used;
  return model;
}

Outcome try_out(const RandomJoint& joint, const CommissionRecord& record) {
  Outcome outcome{design(joint, record), model_of(joint, record), {}};
  if (!outcome.table) return outcome;
  const double start_rad = joint.excitation.start_rad;
  for (const double move_rad : kMoves_rad) {
    FlexibleCell cell;
    cell.temperature_C = joint.drive.ambient.at(0.0);
    cell.step_rad = move_rad;
    cell.nominal = outcome.model;
    cell.plant = joint.drive.plant;
    cell.duration_s = kMove_s;
    for (JointPlantConfig* const plant : {&cell.nominal, &cell.plant}) {
      plant->initial_position_rad = 0.0;  // moves of a cell begin there
      plant->effects.gravity.zero_rad -= start_rad;
    }
    outcome.results.push_back(run_without_limit(cell, extended_contender("daemon", *outcome.table)));
  }
  return outcome;
}

Row study(std::uint64_t seed) {
  const RandomJoint joint = random_joint(seed);
  const CommissionedJoint run = excite(joint);
  const JointEstimates found = identify(run.trace, joint.told);
  Row row{seed, false, {}, {}};
  const auto& motion = found.motion;
  row.measured = motion && motion->motor_inertia_kgm2 && motion->link_inertia_kgm2 &&
                 motion->stiffness_1_Nm_rad && !found.friction.empty();
  if (!row.measured) return row;
  const CommissionRecord record = record_of(joint, found);
  row.found = try_out(joint, record);
  row.truth = try_out(joint, true_record(joint, record, compare(joint, found)));
  return row;
}

double ratio_of(const Row& row, std::size_t move) {
  return row.found.results[move].link_counted_ratio / row.truth.results[move].link_counted_ratio;
}

void show(const Row& row) {
  std::fprintf(stderr, "%4lu %s", static_cast<unsigned long>(row.seed),
               row.measured ? "" : "not every number found");
  for (std::size_t i = 0; i < kMoves_rad.size() && row.found.table && row.truth.table; ++i)
    std::fprintf(stderr, " %g rad: %.1f, true %.1f, ratio %.3f%s%s;", kMoves_rad[i],
                 row.found.results[i].link_counted_ratio, row.truth.results[i].link_counted_ratio,
                 ratio_of(row, i), row.found.results[i].oscillates ? " oscillates" : "",
                 row.truth.results[i].oscillates ? " true oscillates" : "");
  std::fputc('\n', stderr);
}

std::string count(const std::vector<Row>& rows, const std::function<bool(const Row&)>& has) {
  return std::to_string(std::count_if(rows.begin(), rows.end(), has));
}

TextTable designs(const std::vector<Row>& rows) {
  return {"Tables",
          {"joints", "every number found", "table of the measured numbers", "table of the true numbers"},
          {{std::to_string(rows.size()), count(rows, [](const Row& r) { return r.measured; }),
            count(rows, [](const Row& r) { return r.found.table.has_value(); }),
            count(rows, [](const Row& r) { return r.truth.table.has_value(); })}}};
}

TextTable moves(const std::vector<Row>& rows) {
  TextTable table{"Moves",
                  {"move (rad)", "joints", "link's sum over that of the true numbers: median", "worst",
                   "oscillating", "of the true numbers"},
                  {}};
  for (std::size_t i = 0; i < kMoves_rad.size(); ++i) {
    std::vector<double> ratios;
    int found = 0, truth = 0;
    for (const Row& row : rows) {
      if (!row.found.table || !row.truth.table) continue;
      ratios.push_back(ratio_of(row, i));
      found += row.found.results[i].oscillates || row.found.results[i].switched_off ? 1 : 0;
      truth += row.truth.results[i].oscillates || row.truth.results[i].switched_off ? 1 : 0;
    }
    table.rows.push_back({number(kMoves_rad[i]), std::to_string(ratios.size()),
                          number(percentile(ratios, 0.5), 3), number(percentile(ratios, 1.0), 3),
                          std::to_string(found), std::to_string(truth)});
  }
  return table;
}

}  // namespace
}  // namespace strainwave::testing

int main(int argc, char** argv) {
  using namespace strainwave::testing;
  const int joints = argc > 1 ? std::atoi(argv[1]) : 4;
  const int first = argc > 2 ? std::atoi(argv[2]) : 1;
  std::vector<Row> rows(static_cast<std::size_t>(joints));
  strainwave::run_in_parallel(rows.size(), [&](std::size_t i) {
    rows[i] = study(static_cast<std::uint64_t>(first) + i);
    show(rows[i]);
  });
  std::cout << designs(rows).markdown() << '\n' << moves(rows).markdown();
}
