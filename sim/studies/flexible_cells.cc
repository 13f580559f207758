// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/flexible_cells.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "control/joint/gear_catalogue.h"
#include "sim/joint/reference_plant.h"

namespace strainwave {

namespace {

const std::vector<double> kLinkInertias_kgm2 = {0.03, 0.089, 0.267, 1.0};
const std::vector<double> kTemperatures_C = {-10.0, 0.0, 20.0, 45.0};
const std::vector<double> kSteps_rad = {0.001, 0.01, 0.1, 1.0};

FlexibleCell cell_of(double link_inertia_kgm2, const TorsionSpring& spring, double scale,
                     double damping_ratio, double temperature_C, double step_rad) {
  FlexibleCell cell{link_inertia_kgm2, scale,  damping_ratio,     temperature_C,
                    step_rad,          "none", realistic_plant(), {}};
  Transmission gear;
  gear.link_inertia_kgm2 = link_inertia_kgm2;
  gear.spring = spring.scaled(scale);
  gear.damping_Nms_rad = structural_damping_Nms_rad(cell.nominal.joint.inertia_kgm2, link_inertia_kgm2,
                                                    gear.spring.stiffness_1_Nm_rad, damping_ratio);
  cell.nominal.effects.transmission = gear;
  cell.plant = cell.nominal;
  return cell;
}

/// An effect. `share` in [0, 1] scales the size that the catalogue and practice name.
struct Effect {
  std::string name;
  std::function<void(JointPlantConfig&, double share)> add;
};

void scale_friction(JointPlantConfig& plant, double factor) {
  for (FrictionParameters* part : {&plant.joint.friction.asymptote, &plant.joint.friction.amplitude}) {
    part->static_Nm *= factor;
    part->coulomb_Nm *= factor;
    part->viscous_Nms_rad *= factor;
  }
}

const std::vector<Effect>& effects() {
  static const std::vector<Effect> list = {
      {"kinematic error 0.44 mrad",
       [](JointPlantConfig& p, double s) {
         p.effects.transmission->kinematic_error = {{0.22e-3 * s, 0.22e-3 * s}, {0.0, 1.0}};
       }},
      {"lost motion 2'",
       [](JointPlantConfig& p, double s) { p.effects.transmission->lost_motion.width_rad = 5.82e-4 * s; }},
      {"friction by torque 6 %",
       [](JointPlantConfig& p, double s) { p.effects.friction.transmitted_share = 0.06 * s; }},
      {"presliding 0.1 mrad",
       [](JointPlantConfig& p, double s) { p.effects.friction.presliding_rad = 1e-4 * std::max(s, 0.1); }},
      {"current loop 0.5 ms",
       [](JointPlantConfig& p, double s) { p.effects.drive.current_loop_s = 5e-4 * s; }},
      {"torque ripple 2 %", [](JointPlantConfig& p, double s) { p.effects.drive.ripple_share = 0.02 * s; }},
      {"jitter 0.3 ms", [](JointPlantConfig& p, double s) { p.delay.jitter_periods = 0.3 * s; }},
      {"link friction 0.5 N.m",
       [](JointPlantConfig& p, double s) { p.effects.transmission->link_coulomb_Nm = 0.5 * s; }},
      {"gravity 3 N.m",
       [](JointPlantConfig& p, double s) {
         p.effects.gravity = {3.0 * s, -0.5};
       }},
      {"friction +30 %", [](JointPlantConfig& p, double s) { scale_friction(p, 1.0 + 0.3 * s); }},
      {"friction -30 %", [](JointPlantConfig& p, double s) { scale_friction(p, 1.0 - 0.3 * s); }}};
  return list;
}

/// One or several quantities that are wrong in the configuration of a joint.
struct Wrong {
  std::string name;
  double load = 1.0;       ///< configured over true
  double stiffness = 1.0;  ///< configured over true
  double friction = 1.0;   ///< true over configured
  double more_delay_periods = 0.0;
  double jitter_periods = 0.0;
};

const std::vector<Wrong>& wrongs() {
  static const std::vector<Wrong> list = {
      {"load in the model 30 % too heavy", 1.3},
      {"load in the model 30 % too light", 0.7},
      {"stiffness in the model 25 % too high", 1.0, 1.25},
      {"stiffness in the model 25 % too low", 1.0, 0.75},
      {"friction +30 %", 1.0, 1.0, 1.3},
      {"friction -30 %", 1.0, 1.0, 0.7},
      {kOneMorePeriod, 1.0, 1.0, 1.0, 1.0},
      {"one period of delay less", 1.0, 1.0, 1.0, -1.0},
      {"jitter 0.3 ms", 1.0, 1.0, 1.0, 0.0, 0.3},
      {"model too slow, friction -30 %, jitter", 1.3, 0.75, 0.7, 0.0, 0.3},
      {"model too fast, friction +30 %, jitter", 0.7, 1.25, 1.3, 0.0, 0.3}};
  return list;
}

FlexibleCell wrongly_configured(FlexibleCell cell, const Wrong& wrong) {
  cell.effect = wrong.name;
  Transmission& configured = *cell.nominal.effects.transmission;
  configured.link_inertia_kgm2 *= wrong.load;
  configured.spring = configured.spring.scaled(wrong.stiffness);
  scale_friction(cell.plant, wrong.friction);
  cell.plant.delay.periods += wrong.more_delay_periods;
  cell.plant.delay.jitter_periods += wrong.jitter_periods;
  return cell;
}

/// Uniform in a range. The results of standard distributions depend on the library; this formula gives the same draw everywhere.
double draw(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * std::ldexp(static_cast<double>(random() >> 11U), -53);
}

void add_misconfigurations(const FlexibleCell& cell, std::vector<FlexibleCell>& cells) {
  FlexibleCell late = cell;
  late.effect = "one more period of delay than configured";
  late.plant.delay.periods += 1.0;
  cells.push_back(late);
  FlexibleCell link = cell;
  link.effect = "encoder on the link";
  link.plant.link_encoder.counts_per_joint_revolution = link.plant.encoder.counts_per_joint_revolution;
  link.plant.feedback = EncoderSide::kLink;
  cells.push_back(link);
}

}  // namespace

std::vector<FlexibleCell> flexible_grid() {
  const TorsionSpring spring = find_gear("csf-17-50")->spring;
  std::vector<FlexibleCell> cells;
  for (const double link : kLinkInertias_kgm2)
    for (const double scale : {0.8, 1.0, 1.6})
      for (const double damping : {0.01, 0.03, 0.10})
        for (const double temperature : kTemperatures_C)
          for (const double step : kSteps_rad)
            cells.push_back(cell_of(link, spring, scale, damping, temperature, step));
  return cells;
}

std::vector<FlexibleCell> effect_grid() {
  const TorsionSpring spring = find_gear("csf-17-50")->spring;
  std::vector<FlexibleCell> cells;
  for (const double link : kLinkInertias_kgm2)
    for (const double temperature : kTemperatures_C)
      for (const double step : kSteps_rad) {
        const FlexibleCell plain = cell_of(link, spring, 1.0, 0.03, temperature, step);
        cells.push_back(plain);
        FlexibleCell everything = plain;
        everything.effect = "all together";
        for (const Effect& effect : effects()) {
          FlexibleCell cell = plain;
          cell.effect = effect.name;
          effect.add(cell.plant, 1.0);
          cells.push_back(cell);
          if (effect.name != "friction -30 %") effect.add(everything.plant, 1.0);
        }
        cells.push_back(everything);
        add_misconfigurations(plain, cells);
      }
  return cells;
}

std::vector<FlexibleCell> wrongly_configured_grid() {
  std::vector<FlexibleCell> cells;
  for (const FlexibleCell& cell : flexible_grid()) {
    if (cell.link_inertia_kgm2 > 0.3) continue;
    cells.push_back(cell);
    for (const Wrong& wrong : wrongs()) cells.push_back(wrongly_configured(cell, wrong));
    FlexibleCell everything = cell;
    everything.effect = "every effect of the study at once";
    for (const Effect& effect : effects())
      if (effect.name != "friction -30 %") effect.add(everything.plant, 1.0);
    everything.nominal.effects.gravity = everything.plant.effects.gravity;
    cells.push_back(everything);
  }
  return cells;
}

std::vector<FlexibleCell> late_grid() {
  std::vector<FlexibleCell> cells;
  for (const FlexibleCell& cell : wrongly_configured_grid())
    if (cell.link_inertia_kgm2 > 0.05 && (cell.effect == "none" || cell.effect == kOneMorePeriod))
      cells.push_back(cell);
  return cells;
}

std::vector<FlexibleCell> wrongly_configured_joints(int count, std::uint64_t seed) {
  std::vector<FlexibleCell> cells;
  std::mt19937_64 random(seed);
  for (FlexibleCell& cell : random_joints(count, seed)) {
    cell.nominal.effects.gravity = cell.plant.effects.gravity;
    cell.effect = "none";
    cells.push_back(cell);
    cells.push_back(wrongly_configured(cell, {"random joints, wrong model", draw(random, 0.7, 1.3),
                                              draw(random, 0.75, 1.25), draw(random, 0.7, 1.3)}));
  }
  return cells;
}

std::vector<FlexibleCell> first_grid() {
  std::vector<FlexibleCell> cells;
  for (const double ratio : {0.3, 1.0, 3.0})
    for (const double stiffness : {8100.0, 13000.0})
      for (const double temperature : kTemperatures_C)
        for (const double step : kSteps_rad)
          cells.push_back(cell_of(ratio * kReferenceInertia_kgm2, TorsionSpring::linear(stiffness), 1.0, 0.02,
                                  temperature, step));
  return cells;
}

std::vector<FlexibleCell> random_joints(int count, std::uint64_t seed) {
  std::vector<FlexibleCell> cells;
  for (int i = 0; i < count; ++i) {
    std::seed_seq sequence{seed, static_cast<std::uint64_t>(i)};
    std::mt19937_64 random(sequence);
    const auto uniform = [&](double low, double high) { return draw(random, low, high); };
    const auto logarithmic = [&](double low, double high) {
      return std::exp(uniform(std::log(low), std::log(high)));
    };
    const double link = logarithmic(0.03, 1.0);
    const double scale = logarithmic(0.8, 1.6);
    const double damping = logarithmic(0.01, 0.1);
    const double temperature = uniform(-10.0, 45.0);
    FlexibleCell cell =
        cell_of(link, find_gear("csf-17-50")->spring, scale, damping, temperature, logarithmic(1e-3, 1.0));
    cell.effect = "random";
    for (const Effect& effect : effects()) {
      const double share = uniform(-1.0, 1.0);  // half of the joints have the effect
      if (share > 0.0) effect.add(cell.plant, share);
    }
    cells.push_back(cell);
  }
  return cells;
}

}  // namespace strainwave
