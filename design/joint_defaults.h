// SPDX-License-Identifier: BSD-3-Clause
// Defaults of gains and verify for a joint whose actuator is in the catalogue (control/joint/joint_catalogue.h). Offline.
#pragma once

#include <string>
#include <vector>

#include "control/joint/joint_catalogue.h"
#include "design/friction_file.h"

namespace strainwave {

/// The catalogue's joint with `gear`, from which the options that are `missing` are taken. Throws InputError naming `place` and these
/// options where there is none, or where `joint_model` is another.
const CatalogueJoint& require_catalogue_joint(const std::string& place, const std::string& gear,
                                              const std::string& joint_model,
                                              const std::vector<std::string>& missing);

/// Rules of the fit to its friction, by its file, which is compiled in.
inline constexpr const char* kCatalogueFrictionFile = "data/tables/rhs17-6006-friction.json";
FrictionRules catalogue_friction(double gear_ratio);

/// "of rhs17-6006, the catalogue's actuator with csf-17-50".
std::string origin(const CatalogueJoint& joint);

}  // namespace strainwave
