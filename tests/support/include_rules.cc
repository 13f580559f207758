#include "tests/support/include_rules.h"

#include <algorithm>
#include <fstream>
#include <regex>
#include <set>

namespace strainwave::testing {

namespace {

struct Folder {
  std::string_view name;
  std::vector<std::string_view> may_include;  ///< folders, or single files
};

/// The arrows. A folder may always include itself; nothing that is
/// shipped may include tests.
const std::vector<Folder> kFolders{
    {"base", {}},
    {"control", {"base"}},
    {"design", {"base", "control", "lcmtypes"}},
    {"sim", {"base", "control", "drivers/actuator.h"}},
    {"drivers", {"base", "control"}},
    {"lcmtypes", {"base", "control"}},
    {"daemon", {"base", "control", "drivers", "lcmtypes"}},
    {"client", {"base", "control", "lcmtypes", "drivers/injected_fault.h", "drivers/can/can_scan.h"}},
    {"bench", {"base", "control", "design", "sim", "drivers", "lcmtypes", "daemon", "client", "tests"}},
    {"tests", {"base", "control", "design", "sim", "drivers", "lcmtypes", "daemon", "client", "tests"}},
};

/// The adapter that puts the simulated plant behind the drivers' seam: the only driver that may see sim/.
constexpr std::string_view kSimulatedDriver = "drivers/simulated_";

struct Library {
  std::string_view header;              ///< how its headers begin
  std::vector<std::string_view> users;  ///< files (as they begin) that may include it
  bool in_headers = true;               ///< false: slow to compile, for .cc files only
};

/// Libraries that not everybody may use. lcm: a crafted datagram can crash whoever opens it, so never the
/// core.
const std::vector<Library> kLibraries{
    {"sdpa", {"design/"}},
    {"lcm/", {"daemon/gateway/", "client/", "tests/"}},
    {"strainwave/", {"lcmtypes/", "design/", "daemon/", "client/", "tests/", "bench/"}},
    {"toml++/", {"base/toml_section.cc", "tests/"}},
    {"seccomp", {"daemon/gateway/"}},
    {"gpiod", {"drivers/gpio/line_request_v"}},
    {"linux/gpio", {"drivers/gpio/edge_events.cc"}},
    {"curses.h", {"client/watch/terminal.cc"}},
    {"gtest/", {"tests/"}},
    {"benchmark/", {"bench/"}},
    {"nlohmann/json.hpp", {""}, false},
    {"CLI/", {"design/", "sim/", "daemon/", "client/", "base/manual/", "tests/support/"}, false},
};

/// Headers that control/ must not see: no threads, sockets or clocks there, and no library but Eigen (JSON
/// privately).
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

const Folder* find_folder(std::string_view name) {
  const auto found =
      std::find_if(kFolders.begin(), kFolders.end(), [&](const auto& f) { return f.name == name; });
  return found == kFolders.end() ? nullptr : &*found;
}

std::string check_our_header(std::string_view file, std::string_view header) {
  if (header.find('/') == std::string_view::npos || header.find("..") != std::string_view::npos) {
    return "includes are written from the root: \"" + std::string(header) + "\" is not";
  }
  const std::string_view from = top_folder(file);
  const std::string_view to = top_folder(header);
  const Folder* folder = find_folder(from);
  if (folder == nullptr) return "folder " + std::string(from) + " is not in the table of arrows";
  if (find_folder(to) == nullptr)
    return "\"" + std::string(header) + "\" is in no folder of the table of arrows";
  if (from == to) return "";
  for (const std::string_view allowed : folder->may_include) {
    if (allowed == to || allowed == header) return "";
  }
  if (to == "sim" && file.starts_with(kSimulatedDriver)) return "";
  return std::string(from) + " must not include " + std::string(header);
}

std::string check_library_header(std::string_view file, std::string_view header) {
  for (const Library& library : kLibraries) {
    if (!header.starts_with(library.header)) continue;
    if (!begins_with_any(file, library.users)) return "<" + std::string(header) + "> is not for this file";
    if (!library.in_headers && file.ends_with(".h"))
      return "<" + std::string(header) + "> belongs into .cc files only";
  }
  if (top_folder(file) != "control") return "";
  const bool json = header.starts_with("nlohmann/") && file.find("json") != std::string_view::npos;
  const bool system = header.find('/') == std::string_view::npos || header.starts_with("sys/");
  if (kForbiddenInControl.contains(header) || (!system && !json && !header.starts_with("Eigen/"))) {
    return "control has no threads, sockets, clocks or libraries beside Eigen: <" + std::string(header) + ">";
  }
  return "";
}

bool is_source(const std::filesystem::path& file) {
  static const std::set<std::string> kExtensions{".h", ".cc", ".hpp", ".cpp", ".hh", ".cxx", ".c", ".inl"};
  return kExtensions.contains(file.extension().string());
}

bool is_not_ours(const std::string& folder) {
  return folder.starts_with(".") || folder == "build";
}

void check_file(const std::filesystem::path& root, const std::filesystem::path& path,
                std::vector<std::string>& defects) {
  const std::string file = std::filesystem::relative(path, root).generic_string();
  if (find_folder(top_folder(file)) == nullptr) {
    defects.push_back(file + ":1: folder " + std::string(top_folder(file)) +
                      " is not in the table of arrows");
    return;
  }
  std::ifstream stream(path);
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    const std::string defect = find_include_defect(file, line);
    if (!defect.empty()) defects.push_back(file + ":" + std::to_string(number) + ": " + defect);
  }
}

}  // namespace

std::string find_include_defect(std::string_view file, std::string_view line) {
  static const std::regex kInclude(R"(^\s*#\s*(?:include|import)\s*(["<])([^">]+)[">].*$)");
  std::match_results<std::string_view::const_iterator> match;
  if (!std::regex_match(line.begin(), line.end(), match, kInclude)) return "";
  const std::string header = match[2];
  if (match[1] == "\"") return check_our_header(file, header);
  if (find_folder(top_folder(header)) != nullptr && header.find('/') != std::string::npos) {
    return "headers of ours stand in quotation marks: <" + header + ">";
  }
  return check_library_header(file, header);
}

std::vector<std::string> find_include_defects(const std::filesystem::path& root) {
  std::vector<std::string> defects;
  for (const auto& entry : std::filesystem::directory_iterator(root)) {
    if (entry.is_regular_file() && is_source(entry.path())) check_file(root, entry.path(), defects);
    if (!entry.is_directory() || is_not_ours(entry.path().filename().string())) continue;
    for (const auto& file : std::filesystem::recursive_directory_iterator(entry.path())) {
      if (file.is_regular_file() && is_source(file.path())) check_file(root, file.path(), defects);
    }
  }
  std::sort(defects.begin(), defects.end());
  return defects;
}

}  // namespace strainwave::testing
