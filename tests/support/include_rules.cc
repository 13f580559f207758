// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/include_rules.h"

#include <algorithm>
#include <fstream>
#include <optional>
#include <regex>
#include <set>

namespace strainwave::testing {

namespace {

struct Library {
  std::string_view header;              ///< beginning of its headers' names
  std::vector<std::string_view> users;  ///< beginnings of the files that may include it
  bool in_headers = true;               ///< false: slow to compile, for .cc files only
  std::string_view but = "";            ///< and for this header of templates
};

/// Libraries that only some files may use. lcm/ only sends and writes logs; transport/ receives. The core never uses it.
const std::vector<Library> kLibraries{
    {"sdpa", {"design/"}},
    {"Clp_", {"sim/studies/linear_program.cc"}},
    {"lcm/", {"daemon/gateway/", "client/protocol/", "tests/"}},
    {"strainwave/",
     {"strainwave/", "lcmtypes/", "design/", "daemon/", "doctor/", "client/", "telemetry/", "tests/"}},
    {"boost/", {"telemetry/server/", "design/friction/student.cc"}},
    {"toml++/", {"base/toml_section.cc"}},
    {"seccomp", {"daemon/gateway/"}},
    {"gpiod", {"drivers/gpio/line_request_v"}},
    {"linux/gpio", {"drivers/gpio/edge_events.cc"}},
    {"curses.h", {"client/watch/terminal.cc"}},
    {"gtest/", {"tests/"}},
    {"benchmark/", {"bench/"}},
    {"nlohmann/json.hpp", {""}, false, "base/json_fields.h"},
    {"CLI/",
     {"design/", "sim/", "daemon/", "client/", "telemetry/", "base/manual/", "tests/support/"},
     false},
};

/// Headers that control/ must not include: it has no threads, sockets or clocks, and no library except Eigen.
const std::set<std::string_view> kForbiddenInControl{
    "thread",  "mutex",     "shared_mutex", "condition_variable",
    "future",  "semaphore", "barrier",      "latch",
    "chrono",  "ctime",     "time.h",       "sys/time.h",
    "atomic",  "csignal",   "signal.h",     "pthread.h",
    "sched.h", "netdb.h",   "sys/socket.h", "sys/mman.h"};

bool begins_with_any(std::string_view text, const std::vector<std::string_view>& beginnings) {
  return std::any_of(beginnings.begin(), beginnings.end(),
                     [&](auto beginning) { return text.starts_with(beginning); });
}

std::string_view top_folder(std::string_view path) {
  return path.substr(0, path.find('/'));
}

/// Whether the table's `name` covers `file`: "folder/" covers all below, "folder/begin*" files there, others themselves.
bool fits(std::string_view name, std::string_view file) {
  if (name.ends_with('/')) return file.starts_with(name);
  if (!name.ends_with('*')) return file == name;
  name.remove_suffix(1);
  return file.starts_with(name) && file.find('/', name.size()) == std::string_view::npos;
}

/// The names in `...` in one cell.
std::vector<std::string> names_in(const std::string& cell) {
  static const std::regex kName("`([^`]+)`");
  std::vector<std::string> names;
  for (auto it = std::sregex_iterator(cell.begin(), cell.end(), kName); it != std::sregex_iterator(); ++it)
    names.push_back((*it)[1]);
  return names;
}

std::string check_library_header(std::string_view file, std::string_view header) {
  for (const Library& library : kLibraries) {
    if (!header.starts_with(library.header)) continue;
    if (!begins_with_any(file, library.users)) return "<" + std::string(header) + "> is not for this file";
    if (!library.in_headers && file.ends_with(".h") && file != library.but)
      return "<" + std::string(header) + "> belongs into .cc files only";
  }
  if (top_folder(file) != "control") return "";
  const bool system = header.find('/') == std::string_view::npos || header.starts_with("sys/");
  if (kForbiddenInControl.contains(header) || (!system && !header.starts_with("Eigen/"))) {
    return "control has no threads, sockets, clocks or libraries beside Eigen: <" + std::string(header) + ">";
  }
  return "";
}

struct Include {
  std::string header;
  bool quoted = false;
};

std::optional<Include> include_in(std::string_view line) {
  static const std::regex kInclude(R"(^\s*#\s*(?:include|import)\s*(["<])([^">]+)[">].*$)");
  std::match_results<std::string_view::const_iterator> match;
  if (!std::regex_match(line.begin(), line.end(), match, kInclude)) return std::nullopt;
  return Include{match[2], match[1] == "\""};
}

std::string library_sentence(std::string_view user, const Library& library) {
  return std::string(user) + " includes nothing of <" + std::string(library.header) + "...>";
}

bool is_source(const std::filesystem::path& file) {
  static const std::set<std::string> kExtensions{".h", ".cc", ".hpp", ".cpp", ".hh", ".cxx", ".c", ".inl"};
  return kExtensions.contains(file.extension().string());
}

bool is_not_ours(const std::string& folder) {
  return folder.starts_with(".") || folder == "build";
}

}  // namespace

IncludeRules::IncludeRules(const std::filesystem::path& page) {
  std::ifstream stream(page);
  bool in_table = false;
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with("| folder |") && line.ends_with("| may include |")) in_table = true;
    if (!line.starts_with('|')) in_table = false;
    static const std::regex kRow(R"(\|([^|]*)\|[^|]*\|([^|]*)\|)");
    std::smatch cells;
    if (!in_table || !std::regex_match(line, cells, kRow)) continue;
    // A folder without sources has an empty cell.
    if (cells[2].str().find_first_not_of(' ') == std::string::npos) continue;
    for (const std::string& name : names_in(cells[1])) rows_.push_back({name, names_in(cells[2])});
  }
}

const IncludeRules::Row* IncludeRules::row_of(std::string_view file) const {
  const Row* longest = nullptr;
  for (const Row& row : rows_)
    if (fits(row.name, file) && (longest == nullptr || row.name.size() > longest->name.size()))
      longest = &row;
  return longest;
}

std::string IncludeRules::check_our_header(std::string_view file, std::string_view header) const {
  if (header.find('/') == std::string_view::npos || header.find("..") != std::string_view::npos)
    return "includes are written from the root: \"" + std::string(header) + "\" is not";
  const Row* row = row_of(file);
  if (row == nullptr) return std::string(file) + " is in no row of the table of arrows";
  if (row_of(header) == nullptr) return "\"" + std::string(header) + "\" is in no row of the table of arrows";
  const auto allows = [&](const std::string& name) { return fits(name, header); };
  if (allows(row->name) || std::any_of(row->may_include.begin(), row->may_include.end(), allows)) return "";
  return row->name + " must not include " + std::string(header);
}

std::string IncludeRules::find_defect(std::string_view file, std::string_view line) const {
  const std::optional<Include> include = include_in(line);
  if (!include) return "";
  const std::string& header = include->header;
  if (include->quoted) return check_our_header(file, header);
  // Tests of the installed library, and headers of lcm-gen, use the form with <...>.
  const bool installed =
      header.starts_with("strainwave/") && (header.ends_with(".hpp") || file.starts_with("tests/"));
  if (!installed && row_of(header) != nullptr)
    return "headers of ours stand in quotation marks: <" + header + ">";
  return check_library_header(file, header);
}

std::vector<std::string> IncludeRules::find_unused(const std::filesystem::path& root) const {
  std::set<std::string> unused;
  for (const Row& row : rows_)
    for (const std::string& name : row.may_include) unused.insert(row.name + " includes nothing of " + name);
  for (const Library& library : kLibraries)
    for (const std::string_view user : library.users) unused.insert(library_sentence(user, library));
  for (const std::filesystem::path& path : sources_under(root)) {
    const std::string file = std::filesystem::relative(path, root).generic_string();
    const Row* row = row_of(file);
    std::ifstream stream(path);
    for (std::string line; row != nullptr && std::getline(stream, line);) {
      const std::optional<Include> include = include_in(line);
      if (!include) continue;
      for (const std::string& name : row->may_include)
        if (fits(name, include->header)) unused.erase(row->name + " includes nothing of " + name);
      for (const Library& library : kLibraries)
        for (const std::string_view user : library.users)
          if (!include->quoted && file.starts_with(user) && include->header.starts_with(library.header))
            unused.erase(library_sentence(user, library));
    }
  }
  return {unused.begin(), unused.end()};
}

void IncludeRules::check_file(const std::filesystem::path& root, const std::filesystem::path& path,
                              std::vector<std::string>& defects) const {
  const std::string file = std::filesystem::relative(path, root).generic_string();
  if (row_of(file) == nullptr) {
    defects.push_back(file + ":1: is in no row of the table of arrows");
    return;
  }
  std::ifstream stream(path);
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    const std::string defect = find_defect(file, line);
    if (!defect.empty()) defects.push_back(file + ":" + std::to_string(number) + ": " + defect);
  }
}

std::vector<std::string> IncludeRules::find_defects(const std::filesystem::path& root) const {
  std::vector<std::string> defects;
  for (const std::filesystem::path& source : sources_under(root)) check_file(root, source, defects);
  return defects;
}

std::vector<std::filesystem::path> sources_under(const std::filesystem::path& root) {
  std::vector<std::filesystem::path> sources;
  for (const auto& entry : std::filesystem::directory_iterator(root)) {
    if (entry.is_regular_file() && is_source(entry.path())) sources.push_back(entry.path());
    if (!entry.is_directory() || is_not_ours(entry.path().filename().string())) continue;
    for (const auto& file : std::filesystem::recursive_directory_iterator(entry.path()))
      if (file.is_regular_file() && is_source(file.path())) sources.push_back(file.path());
  }
  std::sort(sources.begin(), sources.end());
  return sources;
}

}  // namespace strainwave::testing
