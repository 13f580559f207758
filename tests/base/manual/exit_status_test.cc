// SPDX-License-Identifier: BSD-3-Clause
// Exit statuses: all programs use the numbers of one table, which their help and docs/troubleshooting.md contain.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

const std::string kPrograms = STRAINWAVE_BINARY_DIR "/bin/";

struct Ending {
  int status = -1;
  std::string said;
};

Ending ending_of(const std::string& command) {
  Ending ending;
  std::FILE* pipe = ::popen(("(" + command + ") 2>&1").c_str(), "r");
  if (pipe == nullptr) return ending;
  std::array<char, 4096> part{};
  for (std::size_t size = 0; (size = std::fread(part.data(), 1, part.size(), pipe)) > 0;)
    ending.said.append(part.data(), size);
  const int status = ::pclose(pipe);
  ending.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return ending;
}

/// Meanings by number.
using Statuses = std::map<std::string, std::string>;

Statuses matches(const std::string& text, const std::regex& row) {
  Statuses statuses;
  for (std::sregex_iterator match(text.begin(), text.end(), row), end; match != end; ++match)
    statuses[(*match)[1]] = (*match)[2];
  return statuses;
}

Statuses of_the_page() {
  std::ostringstream text;
  text << std::ifstream(STRAINWAVE_SOURCE_DIR "/docs/troubleshooting.md").rdbuf();
  const std::string page = text.str();
  const std::size_t begin = page.find("## Exit statuses");
  return matches(page.substr(begin, page.find("\n## ", begin) - begin),
                 std::regex(R"(\| (\d+) \| ([^|]*) \|)"));
}

TEST(ExitStatus, IsListedAlikeByEveryProgramAndThePage) {
  const Statuses page = of_the_page();
  EXPECT_EQ(page.size(), 5U);
  for (const char* program : {"strainwavectl", "strainwaved", "strainwave-telemetry", "strainwave-sim",
                              "strainwave-design", "strainwave-can-sim"}) {
    if (!std::filesystem::exists(kPrograms + program)) continue;  // a build without strainwave-design
    const Ending help = ending_of(kPrograms + program + " --help");
    EXPECT_EQ(help.status, 0);
    const std::size_t begin = help.said.find("Exit status:");
    ASSERT_NE(begin, std::string::npos) << program;
    EXPECT_EQ(matches(help.said.substr(begin), std::regex(R"(\n +(\d+)  ([^\n]*))")), page) << program;
  }
}

struct EndingCase {
  const char* command;
  int status;
};

TEST(ExitStatus, IsTheSameForTheSameCauseInEveryProgram) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "nonsense") << "nonsense\n";
  for (const EndingCase& expected :
       std::vector<EndingCase>{// Success.
                               {"strainwavectl --version", 0},
                               {"strainwavectl keygen --out key", 0},
                               {"strainwaved --version", 0},
                               {"strainwave-telemetry --version", 0},
                               {"strainwave-sim --version", 0},
                               {"strainwave-design --version", 0},
                               {"strainwave-spy --help", 0},
                               {"strainwave-can-sim --version", 0},
                               // A wrong command line.
                               {"strainwavectl", 2},
                               {"strainwavectl --nonsense", 2},
                               {"strainwaved", 2},
                               {"strainwaved --nonsense", 2},
                               {"strainwave-telemetry --nonsense", 2},
                               {"strainwave-sim --nonsense", 2},
                               {"strainwave-design --nonsense", 2},
                               {"strainwave-spy --nonsense", 2},
                               {"strainwave-can-sim", 2},
                               {"strainwave-can-sim none0", 2},
                               // A file that does not exist, or has the wrong content.
                               {"strainwavectl export none.lcm --out out.csv", 2},
                               {"strainwavectl load-table elbow none.json", 2},
                               {"strainwavectl load-table elbow nonsense", 2},
                               {"strainwavectl plot-record none.flight.csv", 2},
                               {"strainwavectl plot-record nonsense", 2},
                               {"strainwavectl keygen --out key", 2},
                               {"strainwaved --config none.toml", 2},
                               {"strainwaved --config nonsense --check", 2},
                               {"strainwave-telemetry --token-file none", 2},
                               {"strainwave-sim run --table none.json", 2},
                               {"strainwave-sim run --table nonsense", 2},
                               {"strainwave-design show none.json", 2},
                               {"strainwave-design verify nonsense", 2},
                               {"strainwave-design fit none.csv --out out.json", 2},
                               // No daemon answers.
                               {"strainwavectl --lcm-url memq:// --timeout_s 0.1 status", 3},
                               {"strainwavectl --lcm-url memq:// --timeout_s 0.1 enable elbow wrist", 3},
                               {"strainwavectl --lcm-url memq:// --timeout_s 0.1 disable --all", 3}}) {
    const std::string command = expected.command;
    if (!std::filesystem::exists(kPrograms + command.substr(0, command.find(' ')))) continue;
    const Ending ending = ending_of("cd " + folder.path().string() + " && " + kPrograms + command);
    EXPECT_EQ(ending.status, expected.status) << command << "\n" << ending.said;
  }
}

}  // namespace
}  // namespace strainwave
