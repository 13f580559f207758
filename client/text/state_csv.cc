// SPDX-License-Identifier: BSD-3-Clause
#include "client/text/state_csv.h"

#include <algorithm>
#include <string_view>

#include "base/csv.h"
#include "client/text/message_csv.h"
#include "lcmtypes/reading_doubt.h"
#include "strainwave/vocabulary.h"

namespace strainwave {

int weights_in_use(const state_v1& state) {
  return std::clamp<int>(state.rule_count, 0, 16);
}

std::string state_csv_columns(int weights) {
  std::string line;
  visit_state_fields(state_v1{}, [&](std::string_view name, const auto& value) {
    if constexpr (requires { value.size(); }) {
      for (int i = 0; i < weights; ++i) line += fmt::format(",{}_{}", name, i);
    } else {
      line += fmt::format(",{}", name);
      if (name == "mode" || name == "fault") line += fmt::format(",{}_text", name);
    }
  });
  return line;
}

std::string state_csv_values(const state_v1& state, int weights) {
  std::string line;
  const int used = weights_in_use(state);
  visit_state_fields(state, [&](std::string_view name, const auto& value) {
    if constexpr (requires { value.size(); }) {
      for (int i = 0; i < weights; ++i)
        line += i < used ? fmt::format(",{}", csv_number(value[static_cast<std::size_t>(i)])) : ",";
    } else {
      line += fmt::format(",{}", csv_number(value));
      if (name == "mode") line += fmt::format(",{}", to_text(static_cast<Mode>(state.mode)));
      if (name == "fault")
        line += fmt::format(",{}", fault_words(static_cast<Fault>(state.fault), state.drive_error));
    }
  });
  return line;
}

}  // namespace strainwave
