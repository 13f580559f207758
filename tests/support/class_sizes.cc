// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/class_sizes.h"

#include <algorithm>
#include <fstream>
#include <regex>
#include <sstream>

#include "tests/support/include_rules.h"
#include "tests/support/type_names.h"

namespace strainwave::testing {

namespace {

// A class with at most this many methods is a record, and may have any number of members.
constexpr int kMethodsOfARecord = 1;

bool begins_with(const std::string& text, const char* pattern) {
  return std::regex_search(text, std::regex("^(?:" + std::string(pattern) + ")"));
}

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \n\t");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \n\t") + 1 - first);
}

/// `text` without template arguments: `std::function<void(int)>` is not a function.
std::string without_arguments(const std::string& text) {
  std::string outside;
  int depth = 0;
  for (const char c : text) {
    if (c == '<') ++depth;
    if (depth == 0) outside += c;
    if (c == '>' && depth > 0) --depth;
  }
  return outside;
}

/// Reads the declarations of one class, from behind its opening brace.
class ClassReader {
 public:
  ClassReader(const std::string& code, std::size_t& at, std::vector<ClassSize>& found)
      : code_(code), at_(at), found_(found) {}

  void read(const std::string& name) {
    ClassSize size{name};
    std::string declaration;
    for (; at_ < code_.size() && code_[at_] != '}'; ++at_) {
      if (code_[at_] == ';') {
        count(trimmed(declaration), size);
        declaration.clear();
      } else if (code_[at_] == '{') {
        take_block(declaration, size);
      } else {
        declaration += code_[at_];
      }
    }
    found_.push_back(size);
  }

 private:
  static std::string without_access(std::string declaration) {
    static const std::regex kAccess(R"(^\s*(public|private|protected)\s*:)");
    while (std::regex_search(declaration, kAccess))
      declaration = std::regex_replace(declaration, kAccess, "");
    return trimmed(declaration);
  }

  static void count(const std::string& text, ClassSize& size) {
    static const std::regex kNoMethod(R"(^[\w\s\[\]]*~|operator=\s*\()");
    const std::string declaration = without_access(text);
    if (declaration.empty() ||
        begins_with(
            declaration,
            R"(using\b|friend\b|static_assert\b|typedef\b|enum\b|(class|struct)\s+\w+$|template.*\bfriend\b)"))
      return;
    const std::string plain = without_arguments(declaration);
    const std::size_t bracket = plain.find('(');
    if (bracket != std::string::npos && plain.substr(0, bracket).find(" = ") == std::string::npos) {
      const bool constructs = std::regex_search(plain, std::regex("(^|\\s)" + size.name + R"(\s*\()"));
      if (!constructs && !std::regex_search(plain, kNoMethod)) ++size.methods;
    } else if (!begins_with(declaration, R"((inline\s+)?static\s+(constexpr|const)\b)")) {
      ++size.members;
    }
  }

  void skip_braces() {
    int depth = 0;
    for (; at_ < code_.size(); ++at_) {
      if (code_[at_] == '{') ++depth;
      if (code_[at_] == '}' && --depth == 0) return;
    }
  }

  // A nested type, a function's body, or the initial value of a member.
  void take_block(std::string& declaration, ClassSize& size) {
    static const std::regex kType(R"((?:^|\s)(class|struct|union)\s+(\w+)(\s+final)?\s*(:[^:][^(]*)?$)");
    const std::string head = without_access(declaration);
    std::smatch match;
    if (!begins_with(head, R"(enum\b)") && std::regex_search(head, match, kType)) {
      ++at_;
      read(match[2]);
      declaration = "using " + declaration;
      return;
    }
    skip_braces();
    const std::string plain = without_arguments(head);
    if (begins_with(head, R"(enum\b)") || plain.find('(') == std::string::npos) return;
    const std::size_t next = code_.find_first_not_of(" \n\t", at_ + 1);
    if (next != std::string::npos && (code_[next] == ',' || code_[next] == '{')) return;
    count(head, size);
    declaration.clear();
  }

  const std::string& code_;
  std::size_t& at_;
  std::vector<ClassSize>& found_;
};

}  // namespace

std::vector<ClassSize> class_sizes(const std::string& source) {
  static const std::regex kHead(R"((?:^|[\s>])(class|struct)\s+(\w+)(\s+final)?\s*(:[^:][^(;]*)?\s*$)");
  const std::string code = code_of(source);
  std::vector<ClassSize> found;
  std::string head;
  for (std::size_t at = 0; at < code.size(); ++at) {
    const char c = code[at];
    std::smatch match;
    if (c == '{' && std::regex_search(head, match, kHead)) {
      ++at;
      ClassReader(code, at, found).read(match[2]);
    }
    if (c == '{' || c == '}' || c == ';')
      head.clear();
    else
      head += c;
  }
  return found;
}

std::vector<std::string> find_large_classes(const std::filesystem::path& root, int most_members,
                                            int most_methods) {
  std::vector<std::string> defects;
  for (const std::filesystem::path& path : sources_under(root)) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    for (const ClassSize& size : class_sizes(text.str()))
      if ((size.members > most_members && size.methods > kMethodsOfARecord) || size.methods > most_methods)
        defects.push_back(size.name + " in " + path.lexically_relative(root).generic_string() + ": " +
                          std::to_string(size.members) + " members and " + std::to_string(size.methods) +
                          " methods");
  }
  std::sort(defects.begin(), defects.end());
  return defects;
}

}  // namespace strainwave::testing
