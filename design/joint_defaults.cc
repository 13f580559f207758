// SPDX-License-Identifier: BSD-3-Clause
#include "design/joint_defaults.h"

#include "base/input_error.h"
#include "base/printable.h"
#include "control/joint/friction_estimate.h"
#include "control/joint/joint_catalogue.h"
#include "design/catalogue_friction_json.h"

namespace strainwave {

namespace {

constexpr const char* kFrictionFile = "data/tables/rhs17-6006-friction.json";

// Note of a table with estimated friction.
constexpr const char* kEstimatedFriction = "friction: estimate from the catalogue";

// Sizes 25 and 32 are certified at this weight; stiffer gains change little. The search for size 14 ends at 6e-6.
constexpr double kStiffWeight = 1e-9;

bool has_actuator(const Gear& gear) {
  return gear.name == catalogue_joint().gear;
}

bool is_actuator(const Gear& gear, const std::string& joint_model) {
  return has_actuator(gear) && joint_model == catalogue_joint().model;
}

std::string actuator_origin() {
  const CatalogueJoint& joint = catalogue_joint();
  return "of " + joint.model + ", the catalogue's actuator with " + joint.gear;
}

// The velocity memberships are speeds of the motor, so that they scale with the ratio.
void scale_to(const Gear& gear, double ratios, FuzzyFriction& rules) {
  for (TemperatureRule& rule : rules.rules) rule.friction = estimate_friction(gear, rule.friction);
  VelocityMemberships& velocity = rules.velocity;
  for (double* speed_rad_s : {&velocity.zero_center_rad_s, &velocity.zero_width_rad_s,
                              &velocity.high_center_rad_s, &velocity.high_width_rad_s})
    *speed_rad_s /= ratios;
}

}  // namespace

std::string usual_model(const Gear& gear) {
  return has_actuator(gear) ? catalogue_joint().model : gear.name;
}

CatalogueFriction catalogue_friction(const Gear& gear, const std::string& joint_model) {
  const double known_ratio = find_gear(catalogue_joint().gear)->ratio;
  CatalogueFriction friction{friction_rules_from_json(kCatalogueFrictionJson, kFrictionFile, known_ratio), "",
                             kFrictionFile};
  if (is_actuator(gear, joint_model)) {
    friction.origin += ", " + actuator_origin();
    return friction;
  }
  scale_to(gear, gear.ratio / known_ratio, friction.rules.friction);
  friction.note = kEstimatedFriction;
  friction.origin =
      "an estimate from the catalogue of gears, which may be half or twice the true friction; measure it "
      "with strainwavectl identify";
  return friction;
}

std::string friction_doubt(const FuzzyFriction& given, const Gear* gear) {
  if (gear == nullptr) return "";
  constexpr double kRoom_C = 20.0;
  constexpr double kMostFactor = 10.0;
  const auto coulomb_Nm = [](const FuzzyFriction& friction) {
    return friction.blend(friction.weights(kRoom_C)).coulomb_Nm;
  };
  const double found_Nm = coulomb_Nm(given);
  const double usual_Nm = coulomb_Nm(catalogue_friction(*gear, usual_model(*gear)).rules.friction);
  if (found_Nm <= kMostFactor * usual_Nm && found_Nm >= usual_Nm / kMostFactor) return "";
  return "WARNING: --friction has " + bound_text(found_Nm) +
         " N.m of Coulomb friction at the joint and 20 degC, but a " + gear->name + " has about " +
         bound_text(usual_Nm) + ": check its unit, and its side of the gear (--rules-side)\n";
}

double usual_torque_weight(const Gear& gear, double actuators) {
  return has_actuator(gear) ? actuators : kStiffWeight;
}

MotorInertia usual_motor_inertia(const std::string& place, const Gear* gear, const std::string& joint_model,
                                 const std::optional<double>& rotor_kgm2) {
  if (gear == nullptr)
    throw InputError(place + ": give --gear, the gear between motor and load: " + gear_names());
  const std::string wave_generator = "the wave generator's " + number_text(gear->wave_generator_inertia_kgm2);
  if (rotor_kgm2 && !(*rotor_kgm2 >= 0.0))
    throw InputError(place, "--rotor-inertia_kgm2", number_text(*rotor_kgm2), "must not be negative");
  if (rotor_kgm2)
    return {(*rotor_kgm2 + gear->wave_generator_inertia_kgm2) * gear->ratio * gear->ratio,
            "of the rotor and " + wave_generator + ", times " + number_text(gear->ratio) + " squared"};
  if (is_actuator(*gear, joint_model)) return {catalogue_joint().motor_inertia_kgm2, actuator_origin()};
  throw InputError(
      place + ": the motor of " + gear->name +
      " is not known: give the rotor's inertia of its data sheet with gains --rotor-inertia_kgm2, to which " +
      wave_generator + " is added, or the inertia of both at the joint with --motor-inertia_kgm2");
}

}  // namespace strainwave
