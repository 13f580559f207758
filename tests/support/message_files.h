// SPDX-License-Identifier: BSD-3-Clause
// Reads the fields of .lcm files, so that tests can compare code and documents with them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace strainwave {

/// One field of a message as its .lcm file declares it. `count` is 1 for a scalar, else the product of an
/// array's sizes.
struct MessageField {
  std::string type;
  std::string name;
  std::string declaration;  ///< as written, e.g. "temperature_weights[16]"
  int count = 1;
};

/// Fields of struct `name` in the file, in order. Empty if there is no such struct.
std::vector<MessageField> read_message_fields(const std::filesystem::path& file, const std::string& name);

}  // namespace strainwave
