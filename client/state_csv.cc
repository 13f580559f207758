#include "client/state_csv.h"

#include <fmt/format.h>

#include "client/state_fields.h"

namespace strainwave {

std::string csv_header() {
  std::string line = "joint";
  visit_state_fields(state_v1{}, [&](const char* name, const auto& value) {
    if constexpr (requires { value.size(); }) {
      for (std::size_t i = 0; i < value.size(); ++i) line += fmt::format(",{}_{}", name, i);
    } else {
      line += fmt::format(",{}", name);
    }
  });
  return line;
}

std::string csv_row(const std::string& joint, const state_v1& state) {
  std::string line = joint;
  visit_state_fields(state, [&](const char*, const auto& value) {
    if constexpr (requires { value.size(); }) {
      for (const double entry : value) line += fmt::format(",{}", entry);
    } else {
      line += fmt::format(",{}", value);
    }
  });
  return line;
}

}  // namespace strainwave
