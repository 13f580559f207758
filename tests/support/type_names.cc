// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/type_names.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>

#include "tests/support/include_rules.h"

namespace strainwave::testing {

namespace {

std::size_t end_of_literal(const std::string& text, std::size_t at) {
  const char quote = text[at];
  for (++at; at < text.size() && text[at] != quote; ++at)
    if (text[at] == '\\') ++at;
  return at;
}

std::size_t end_of_raw_string(const std::string& text, std::size_t quote) {
  const std::size_t bracket = text.find('(', quote);
  const std::string end = ")" + text.substr(quote + 1, bracket - quote - 1) + "\"";
  const std::size_t found = text.find(end, bracket);
  return found == std::string::npos ? text.size() : found + end.size() - 1;
}

bool separates_digits(const std::string& text, std::size_t at) {
  return text[at] == '\'' && at > 0 && std::isxdigit(static_cast<unsigned char>(text[at - 1])) != 0;
}

}  // namespace

std::string code_of(const std::string& text) {
  std::string code;
  bool line_begins = true;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (line_begins && c == '#') {
      while (i < text.size() && (text[i] != '\n' || text[i - 1] == '\\')) ++i;
    } else if (text.compare(i, 2, "//") == 0) {
      i = std::min(text.find('\n', i), text.size());
    } else if (text.compare(i, 2, "/*") == 0) {
      i = std::min(text.find("*/", i), text.size() - 2) + 1;
    } else if (c == '"' && i > 0 && text[i - 1] == 'R') {
      i = end_of_raw_string(text, i);
    } else if (c == '"' || (c == '\'' && !separates_digits(text, i))) {
      i = end_of_literal(text, i);
    } else {
      code += c;
    }
    if (i < text.size() && text[i] == '\n')
      line_begins = true;
    else if (std::isspace(static_cast<unsigned char>(c)) == 0)
      line_begins = false;
  }
  return code;
}

std::vector<std::string> types_defined_in(const std::string& source) {
  static const std::regex kHead(
      R"((?:^|[\s>])(namespace|struct|class|union|enum(?:\s+(?:class|struct))?)(?:\s+([\w:]+))?(?:\s+final)?\s*(?::[^:][^(]*)?$)");
  std::vector<std::string> types;
  std::vector<std::string> scopes;  // "" for every scope that is not a named namespace
  std::string head;
  for (const char c : code_of(source)) {
    if (c == '{') {
      std::smatch match;
      while (!head.empty() && std::isspace(static_cast<unsigned char>(head.back())) != 0) head.pop_back();
      const bool declares = std::regex_search(head, match, kHead);
      const std::string name = declares ? match[2].str() : "";
      const bool is_namespace = declares && match[1] == "namespace";
      std::string qualified;
      bool named = true;
      for (const std::string& scope : scopes) {
        qualified += scope + "::";
        named = named && !scope.empty();
      }
      // Types defined outside of their class are members. Two of them are alternatives, of which one is built.
      const bool is_member = name.find("::") != std::string::npos;
      if (named && !name.empty() && !is_namespace && !is_member) types.push_back(qualified + name);
      scopes.push_back(is_namespace ? name : "");
    } else if (c == '}' && !scopes.empty()) {
      scopes.pop_back();
    }
    if (c == '{' || c == '}' || c == ';')
      head.clear();
    else
      head += c;
  }
  return types;
}

std::vector<std::string> find_repeated_types(const std::filesystem::path& root) {
  std::map<std::string, std::string> first;
  std::vector<std::string> defects;
  for (const std::filesystem::path& path : sources_under(root)) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    const std::string file = std::filesystem::relative(path, root).generic_string();
    for (const std::string& type : types_defined_in(text.str())) {
      const auto [found, is_new] = first.emplace(type, file);
      if (!is_new && found->second != file)
        defects.push_back(type + " is defined in " + found->second + " and in " + file);
    }
  }
  return defects;
}

}  // namespace strainwave::testing
