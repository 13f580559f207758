// SPDX-License-Identifier: BSD-3-Clause
// Sets keys of one joint in the text of a configuration, line by line: all other lines stay as they are, comments too. Not real-time.
#pragma once

#include <string>
#include <variant>
#include <vector>

namespace strainwave {

struct JointSetting {
  std::string key;  ///< relative to the joint's section: "motor_inertia_kgm2", "control.gravity_Nm"
  std::variant<double, std::string> value;
};

/// The same text in which each setting is a line of `joint`: its value in place of the old one, which becomes the line's comment, or a new line
/// at the end of its table. Throws InputError that names `source` and the setting where the file writes the joint's tables in another form than
/// [[joint]] and [joint.NAME], or has no such joint.
std::string with_settings(const std::string& text, const std::string& joint,
                          const std::vector<JointSetting>& settings, const std::string& source);

/// The same text for another folder: every relative path of a configuration's keys begins with `prefix`, which ends in '/'.
std::string with_moved_paths(const std::string& text, const std::string& prefix);

}  // namespace strainwave
