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

// What a table says of such friction.
constexpr const char* kEstimatedFriction = "friction: estimate from the catalogue";

// Where it is certified at once, for sizes 25 and 32, stiffer gains change little; size 14 ends at 6e-6.
constexpr double kStiffWeight = 1e-9;

const CatalogueJoint* find_actuator(const Gear& gear, const std::string& joint_model) {
  const CatalogueJoint* const joint = find_catalogue_joint_with_gear(gear.name);
  return joint != nullptr && joint->model == joint_model ? joint : nullptr;
}

std::string origin(const CatalogueJoint& joint) {
  return "of " + joint.model + ", the catalogue's actuator with " + joint.gear;
}

}  // namespace

std::string usual_model(const Gear& gear) {
  const CatalogueJoint* const joint = find_catalogue_joint_with_gear(gear.name);
  return joint != nullptr ? joint->model : gear.name;
}

CatalogueFriction catalogue_friction(const Gear& gear, const std::string& joint_model) {
  const double known_ratio = find_gear(joint_catalogue().front().gear)->ratio;
  CatalogueFriction friction{friction_rules_from_json(kCatalogueFrictionJson, kFrictionFile, known_ratio), "",
                             kFrictionFile};
  if (const CatalogueJoint* const joint = find_actuator(gear, joint_model)) {
    friction.origin += ", " + origin(*joint);
    return friction;
  }
  friction.rules.friction = estimate_friction(gear, friction.rules.friction);
  friction.note = kEstimatedFriction;
  friction.origin =
      "an estimate from the catalogue of gears, expect half to twice; measure it with strainwavectl identify";
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
         " N.m of Coulomb friction at the joint and 20 degC, where a " + gear->name + " has about " +
         bound_text(usual_Nm) + ": check its unit, and its side of the gear (--rules-side)\n";
}

double usual_torque_weight(const Gear& gear, double actuators) {
  return find_catalogue_joint_with_gear(gear.name) != nullptr ? actuators : kStiffWeight;
}

MotorInertia usual_motor_inertia(const std::string& place, const Gear* gear, const std::string& joint_model,
                                 const std::optional<double>& rotor_kgm2) {
  if (gear == nullptr)
    throw InputError(place + ": give --gear, whose spring is before the load: " + gear_names());
  const std::string wave_generator = "the wave generator's " + number_text(gear->wave_generator_inertia_kgm2);
  if (rotor_kgm2 && !(*rotor_kgm2 >= 0.0))
    throw InputError(place, "--rotor-inertia_kgm2", number_text(*rotor_kgm2), "must not be negative");
  if (rotor_kgm2)
    return {(*rotor_kgm2 + gear->wave_generator_inertia_kgm2) * gear->ratio * gear->ratio,
            "of the rotor and " + wave_generator + ", times " + number_text(gear->ratio) + " squared"};
  if (const CatalogueJoint* const joint = find_actuator(*gear, joint_model))
    return {joint->motor_inertia_kgm2, origin(*joint)};
  throw InputError(place + ": which motor drives " + gear->name +
                   "? Give its rotor's inertia from its data sheet, gains --rotor-inertia_kgm2, to which " +
                   wave_generator + " is added; or give --motor-inertia_kgm2, of both at the joint");
}

}  // namespace strainwave
