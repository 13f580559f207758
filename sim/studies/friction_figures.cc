// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>

#include "base/csv.h"
#include "base/units.h"
#include "sim/joint/reference_plant.h"
#include "sim/studies/chapter6_figures.h"
#include "sim/studies/text_table.h"

namespace strainwave {

namespace {

constexpr std::array kSpeeds_rpm = {500.0, 1000.0, 2000.0, 3500.0};

struct Catalogue {
  CsvTable torque;      ///< temperature, torque at kSpeeds_rpm (motor side)
  CsvTable parameters;  ///< temperature, viscous, Coulomb, static (motor side)
};

Catalogue read_catalogue(const std::filesystem::path& data) {
  Catalogue catalogue{read_csv(data / "no_load_torque.csv"), read_csv(data / "friction_parameters.csv")};
  catalogue.torque.require_columns({"temperature_C", "torque_500rpm_Ncm", "torque_1000rpm_Ncm",
                                    "torque_2000rpm_Ncm", "torque_3500rpm_Ncm"});
  catalogue.parameters.require_columns({"temperature_C", "viscous_Ncm_per_rpm", "coulomb_Ncm", "static_Ncm"});
  return catalogue;
}

template <typename Function>
Points sampled(double from, double to, const Function& f, int count = 300) {
  Points points;
  for (int i = 0; i <= count; ++i) {
    const double x = from + (to - from) * i / count;
    points.emplace_back(x, f(x));
  }
  return points;
}

Points column(const CsvTable& table, std::size_t index) {
  Points points;
  for (const std::vector<double>& row : table.rows) points.emplace_back(row[0], row[index]);
  return points;
}

double motor_Ncm(double joint_Nm) {
  return joint_Nm / joint_torque_Nm_from_motor_Ncm(1.0, kReferenceGearRatio);
}
double motor_viscous(double joint_Nms_rad) {
  return joint_Nms_rad / joint_viscous_Nms_rad_from_motor_Ncm_per_rpm(1.0, kReferenceGearRatio);
}

Figure torque_figure(const Catalogue& catalogue) {
  Panel panel{"No-load torque of the motor",
              "motor speed (rpm)",
              "torque (N·cm)",
              "",
              {},
              false,
              {0, 3600},
              {},
              true};
  int colour = 0;
  for (std::size_t i = 0; i < catalogue.torque.rows.size(); i += 4) {
    const std::vector<double>& row = catalogue.torque.rows[i];
    const std::vector<double>& fit = catalogue.parameters.rows[i];
    Points points;
    for (std::size_t s = 0; s < kSpeeds_rpm.size(); ++s) points.emplace_back(kSpeeds_rpm[s], row[s + 1]);
    const FrictionParameters law = reference_joint().friction.at(row[0]);
    panel.series.push_back({number(row[0]) + " °C", points, Mark::kPoints, colour, false});
    panel.series.push_back({"",
                            sampled(
                                0, 3600, [&](double rpm) { return fit[2] + fit[1] * rpm; }, 2),
                            Mark::kLine, colour, false});
    panel.series.push_back(
        {"",
         sampled(
             0, 3600,
             [&](double rpm) { return motor_Ncm(law.coulomb_Nm) + motor_viscous(law.viscous_Nms_rad) * rpm; },
             2),
         Mark::kDashed, colour, false});
    ++colour;
  }
  return {"catalogue_torque",
          "Catalogue torque (points), the straight line fitted at each temperature (solid) and the "
          "exponential law over "
          "temperature, Table 3 with its correction (dashed).",
          1,
          {panel}};
}

Figure parameter_figure(const Catalogue& catalogue, const FuzzyFriction& friction) {
  const auto panel = [&](const std::string& title, const std::string& unit, std::size_t index, auto&& value) {
    return Panel{title,
                 "temperature (°C)",
                 unit,
                 "",
                 {{"catalogue", column(catalogue.parameters, index), Mark::kPoints, 0, false},
                  {"exponential law",
                   sampled(-12, 46, [&](double t) { return value(reference_joint().friction.at(t)); }),
                   Mark::kDashed, 4, false},
                  {"fuzzy rules",
                   sampled(-12, 46, [&](double t) { return value(friction.blend(friction.weights(t))); }),
                   Mark::kLine, 5, false}},
                 false,
                 {},
                 {},
                 true};
  };
  return {
      "friction_parameters",
      "Friction parameters over temperature at the motor side: catalogue, the plant's law and the "
      "controller's rules.",
      3,
      {panel("static", "Fs (N·cm)", 3, [](const FrictionParameters& f) { return motor_Ncm(f.static_Nm); }),
       panel("Coulomb", "Fc (N·cm)", 2, [](const FrictionParameters& f) { return motor_Ncm(f.coulomb_Nm); }),
       panel("viscous", "Fv (N·cm/rpm)", 1,
             [](const FrictionParameters& f) { return motor_viscous(f.viscous_Nms_rad); })}};
}

Figure membership_figure(const FuzzyFriction& friction) {
  Panel temperature{
      "Layer 1: temperature", "temperature (°C)", "membership", "", {}, false, {}, {0, 1.05}, true};
  Panel weight{
      "Layer 1: normalised weights", "temperature (°C)", "weight", "", {}, false, {}, {0, 1.05}, false};
  for (int i = 0; i < friction.rule_count; ++i) {
    const TemperatureRule& rule = friction.rules[static_cast<std::size_t>(i)];
    const auto bell = [&](double t) { return std::exp(-std::pow((t - rule.center_C) / rule.width_C, 2)); };
    const auto share = [&](double t) { return friction.weights(t).weight[static_cast<std::size_t>(i)]; };
    temperature.series.push_back(
        {"rule " + std::to_string(i + 1), sampled(-15, 45, bell), Mark::kLine, i, false});
    weight.series.push_back({"", sampled(-15, 45, share), Mark::kLine, i, false});
  }
  const auto zero = [&](double rpm) {
    return friction.velocity.zero_weight(joint_velocity_rad_s_from_motor_rpm(rpm, kReferenceGearRatio));
  };
  const Panel velocity{
      "Layer 2: velocity",
      "motor speed (rpm)",
      "weight",
      "",
      {{"zero", sampled(-150, 150, zero), Mark::kLine, 4, false},
       {"high", sampled(-150, 150, [&](double rpm) { return 1.0 - zero(rpm); }), Mark::kLine, 5, false}},
      false,
      {},
      {0, 1.05},
      true};
  return {"memberships", "Memberships of the fuzzy friction model.", 3, {temperature, weight, velocity}};
}

Figure velocity_figure(const FuzzyFriction& friction) {
  const auto panel = [&](double to_rpm) {
    Panel result{
        "Friction torque at the joint", "motor speed (rpm)", "friction (N·m)", "", {}, false, {}, {}, true};
    int colour = 0;
    for (const double temperature_C : {-10.0, 5.0, 20.0, 40.0}) {
      const JointParameters joint = reference_joint();
      const auto speed = [](double rpm) {
        return joint_velocity_rad_s_from_motor_rpm(rpm, kReferenceGearRatio);
      };
      const auto plant = [&](double rpm) {
        return stribeck_friction_Nm(joint.friction.at(temperature_C), joint.stribeck, speed(rpm));
      };
      const auto model = [&](double rpm) {
        const FrictionParameters blended = friction.blend(friction.weights(temperature_C));
        const double zero_weight = friction.velocity.zero_weight(speed(rpm));
        return zero_weight * blended.static_Nm +
               (1.0 - zero_weight) * (blended.coulomb_Nm + blended.viscous_Nms_rad * speed(rpm));
      };
      const double from_rpm = 1e-6;
      result.series.push_back(
          {number(temperature_C) + " °C", sampled(from_rpm, to_rpm, plant), Mark::kLine, colour, false});
      result.series.push_back({"", sampled(from_rpm, to_rpm, model), Mark::kDashed, colour, false});
      ++colour;
    }
    return result;
  };
  return {
      "friction_over_velocity",
      "The plant's Stribeck curve (solid) and the controller's fuzzy model (dashed): they are not the same.",
      2,
      {panel(150), panel(3500)}};
}

}  // namespace

std::vector<Figure> friction_figures(const std::filesystem::path& data, const FuzzyFriction& friction) {
  const Catalogue catalogue = read_catalogue(data);
  return {torque_figure(catalogue), parameter_figure(catalogue, friction), membership_figure(friction),
          velocity_figure(friction)};
}

}  // namespace strainwave
