// SPDX-License-Identifier: BSD-3-Clause
#include "client/text/output.h"

#include <nlohmann/json.hpp>

namespace strainwave {

void say(const Output& output, const std::string& text, const std::vector<ResultField>& fields) {
  if (!output.json) {
    output.stream << text << std::endl;
    return;
  }
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const auto& [name, value] : fields)
    std::visit([&, key = name](const auto& held) { json[key] = held; }, value);
  // Names come from the network. Invalid UTF-8 must not end the program.
  output.stream << json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) << std::endl;
}

}  // namespace strainwave
