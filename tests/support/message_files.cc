// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/message_files.h"
#include "base/text_file.h"

#include <regex>
#include <sstream>

namespace strainwave {

std::vector<MessageField> read_message_fields(const std::filesystem::path& file, const std::string& name) {
  std::vector<MessageField> fields;
  std::istringstream text(read_text_file(file));
  bool inside = false;
  const std::regex declaration(R"(^\s*(\w+)\s+(\w+)((?:\[\d+\])*)\s*;.*$)");
  const std::regex size(R"(\[(\d+)\])");
  for (std::string line; std::getline(text, line);) {
    if (line == "struct " + name) inside = true;
    if (line.starts_with("}")) inside = false;
    std::smatch match;
    if (!inside || !std::regex_match(line, match, declaration)) continue;
    MessageField field{match[1], match[2], match[2].str() + match[3].str(), 1};
    const std::string sizes = match[3];
    for (std::sregex_iterator it(sizes.begin(), sizes.end(), size); it != std::sregex_iterator(); ++it) {
      field.count *= std::stoi((*it)[1]);
    }
    fields.push_back(field);
  }
  return fields;
}

}  // namespace strainwave
