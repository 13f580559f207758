// SPDX-License-Identifier: BSD-3-Clause
#include "control/friction/friction_json.h"

#include <cmath>

#include "base/printable.h"
#include "base/text_file.h"

namespace strainwave {

FrictionLaw read_friction_law(const std::filesystem::path& path, double gear_ratio) {
  const std::string source = path.string();
  const nlohmann::ordered_json document = parse_strict_json(read_text_file(path), source);
  StrictObject object(document, source);
  const double ratio = object.number("gear_ratio");
  if (!(std::abs(ratio - gear_ratio) <= 1e-9 * gear_ratio))
    throw InputError(source, "gear_ratio", number_text(ratio),
                     "must be the joint's, " + number_text(gear_ratio) + ": fit with --gear-ratio " +
                         number_text(gear_ratio));
  if (!object.has("exponential"))
    throw InputError(source + ": has no friction law: fit with strainwave-design fit --model both");
  JsonReader reader(object.object("exponential"));
  FrictionLaw law;
  fields(reader, law);
  return law;
}

}  // namespace strainwave
