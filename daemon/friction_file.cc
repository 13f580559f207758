// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/friction_file.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/input_error.h"
#include "base/strict_json.h"

namespace strainwave {

namespace {

/// Of a joint: absolute zero to where no lubricant is one.
constexpr double kColdest_C = -273.15;
constexpr double kHottest_C = 1000.0;

void require_range(const StrictObject& object, const std::string& key, double value, double min, double max) {
  if (value >= min && value <= max) return;
  throw InputError(object.where(key) + " = " + std::to_string(value) + ": from " + std::to_string(min) +
                   " to " + std::to_string(max) + " is allowed");
}

}  // namespace

std::string to_json(const KeptFriction& kept) {
  nlohmann::ordered_json json;
  json["joint"] = kept.joint;
  json["friction_rules_id"] = kept.friction_rules_id;
  json["friction_scales"] = kept.scale;
  json["friction_learned_C"] = kept.learned_C;
  json["friction_learned_utime"] = kept.learned_utime;
  return json.dump(2) + "\n";
}

KeptFriction parse_kept_friction(std::string_view text, const std::string& source) {
  const nlohmann::ordered_json json = parse_strict_json(text, source);
  StrictObject object(json, source);
  KeptFriction kept;
  kept.joint = object.text("joint", kMaxTextBytes);
  kept.friction_rules_id = object.integer("friction_rules_id");
  const std::vector<double> scale = object.numbers("friction_scales", kept.scale.size());
  for (const double value : scale) require_range(object, "friction_scales", value, kLeastScale, kMostScale);
  std::copy(scale.begin(), scale.end(), kept.scale.begin());
  kept.learned_C = object.number("friction_learned_C");
  require_range(object, "friction_learned_C", kept.learned_C, kColdest_C, kHottest_C);
  kept.learned_utime = object.integer("friction_learned_utime");
  if (kept.learned_utime < 0)
    throw InputError(object.where("friction_learned_utime") + " = " + std::to_string(kept.learned_utime) +
                     ": from 0 is allowed");
  object.finish();
  return kept;
}

std::filesystem::path friction_file(const std::filesystem::path& directory, const std::string& joint) {
  return directory / ("friction-" + joint + ".json");
}

}  // namespace strainwave
