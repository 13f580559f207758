// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/friction_file.h"

#include "base/json_fields.h"
#include "base/printable.h"

namespace strainwave {

namespace {

/// Possible temperatures of a joint: from absolute zero to where no lubricant works.
constexpr double kColdest_C = -273.15;
constexpr double kHottest_C = 1000.0;

}  // namespace

template <typename Json>
void fields(Json& json, KeptFriction& kept) {
  const auto in_range = [&](const std::string& key, double value, double least, double most) {
    json.require(value >= least && value <= most, key,
                 "from " + number_text(least) + " to " + number_text(most));
  };
  json("joint", kept.joint);
  json("friction_rules_id", kept.friction_rules_id);
  json("friction_scales", kept.scale);
  for (const double scale : kept.scale) in_range("friction_scales", scale, kLeastScale, kMostScale);
  json("friction_learned_C", kept.learned_C);
  in_range("friction_learned_C", kept.learned_C, kColdest_C, kHottest_C);
  json("friction_learned_utime", kept.learned_utime);
  json.require(kept.learned_utime >= 0, "friction_learned_utime", "0 or more");
}

std::string to_json(const KeptFriction& kept) {
  return json_text(kept);
}

KeptFriction parse_kept_friction(std::string_view text, const std::string& source) {
  return from_json_text<KeptFriction>(text, source);
}

std::filesystem::path friction_file(const std::filesystem::path& directory, const std::string& joint) {
  return directory / ("friction-" + joint + ".json");
}

}  // namespace strainwave
