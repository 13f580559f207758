// SPDX-License-Identifier: BSD-3-Clause
#include "design/joint_defaults.h"

#include "base/input_error.h"
#include "design/catalogue_friction_json.h"

namespace strainwave {

namespace {

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " and ") + word;
  return text;
}

std::string known_gears() {
  std::vector<std::string> gears;
  for (const CatalogueJoint& joint : joint_catalogue()) gears.push_back(joint.gear);
  return listed(gears);
}

}  // namespace

const CatalogueJoint& require_catalogue_joint(const std::string& place, const std::string& gear,
                                              const std::string& joint_model,
                                              const std::vector<std::string>& missing) {
  const std::string give = "give " + listed(missing);
  if (gear.empty())
    throw InputError(place + ": " + give + ", or --gear " + known_gears() +
                     ", whose actuator the catalogue knows");
  const CatalogueJoint* const joint = find_catalogue_joint_with_gear(gear);
  if (joint == nullptr)
    throw InputError(place, "--gear", gear,
                     "the catalogue knows no actuator with it, only with " + known_gears() + ": " + give);
  if (joint->model != joint_model)
    throw InputError(place, "joint model", joint_model,
                     "the catalogue's actuator with " + gear + " is another, " + joint->model + ": " + give);
  return *joint;
}

FrictionRules catalogue_friction(double gear_ratio) {
  return friction_rules_from_json(kCatalogueFrictionJson, kCatalogueFrictionFile, gear_ratio);
}

std::string origin(const CatalogueJoint& joint) {
  return "of " + joint.model + ", the catalogue's actuator with " + joint.gear;
}

}  // namespace strainwave
