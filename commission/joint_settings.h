// SPDX-License-Identifier: BSD-3-Clause
// Sets keys of one joint in the text of a configuration, line by line. All other lines stay unchanged, comments included. Not real-time.
#pragma once

#include <string>
#include <variant>
#include <vector>

namespace strainwave {

struct JointSetting {
  std::string key;  ///< relative to the joint's section: "motor_inertia_kgm2", "control.gravity_Nm"
  std::variant<double, std::string> value;
};

/// The text with each setting as a line of `joint`. A new value replaces the old one, which becomes the line's comment, or is a new line at
/// the end of its table. Throws InputError that names `source` and the setting if there is no such joint, or if its tables are not
/// written as [[joint]] and [joint.NAME].
std::string with_settings(const std::string& text, const std::string& joint,
                          const std::vector<JointSetting>& settings, const std::string& source);

/// The text for another folder: puts `prefix`, which ends in '/', before every relative path in a configuration's keys.
std::string with_moved_paths(const std::string& text, const std::string& prefix);

}  // namespace strainwave
