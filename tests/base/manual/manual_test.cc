// SPDX-License-Identifier: BSD-3-Clause
// Man pages and completions as the programs print them.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>

#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

const std::string kBin = STRAINWAVE_BINARY_DIR "/bin/";

struct Result {
  int status = -1;
  std::string output;
};

Result shell(const std::string& command) {
  Result result;
  std::FILE* pipe = ::popen(("(" + command + ") 2>&1").c_str(), "r");
  if (pipe == nullptr) return result;
  std::array<char, 4096> bytes{};
  for (std::size_t count = 0; (count = std::fread(bytes.data(), 1, bytes.size(), pipe)) > 0;)
    result.output.append(bytes.data(), count);
  const int status = ::pclose(pipe);
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return result;
}

bool is_there(const char* program) {
  return shell(std::string("command -v ") + program).status == 0;
}

class Manual : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(kBin + GetParam())) GTEST_SKIP() << "not built, as under a sanitizer";
  }
  std::string print(const std::string& kind) const {
    const Result result = shell(kBin + GetParam() + " --manual " + kind);
    EXPECT_EQ(result.status, 0) << result.output;
    return result.output;
  }
};

TEST_P(Manual, ThePageNamesTheProgramAndFormatsWithoutComplaint) {
  const std::string page = print("man");
  EXPECT_TRUE(page.starts_with(".TH ")) << page;
  EXPECT_NE(page.find(".SH NAME"), std::string::npos);
  EXPECT_NE(page.find("\\-\\-help"), std::string::npos);
  EXPECT_EQ(page.find("manual"), std::string::npos) << "the option is hidden";
  for (const char* section : {"EXIT STATUS", "FILES", "EXAMPLES", "SEE ALSO"})
    EXPECT_NE(page.find(std::string("\n.SH ") + section + "\n"), std::string::npos) << section;
  if (!is_there("groff")) return;
  const Result formatted = shell(kBin + GetParam() + " --manual man | groff -man -Tascii -ww -z");
  EXPECT_EQ(formatted.status, 0);
  EXPECT_EQ(formatted.output, "");
}

TEST_P(Manual, ThePageHasADateAndTheSectionOfItsKind) {
  const std::string name = GetParam();
  const bool daemon = name == "strainwaved" || name == "strainwave-telemetry";
  const std::string page = print("man");
  const std::regex head("\\.TH [A-Z-]+ " + std::string(daemon ? "8" : "1") +
                        " \"[0-9]{1,2} [A-Z][a-z]{2} 20[0-9]{2}\" \"strainwave [0-9.]+\"");
  EXPECT_TRUE(std::regex_search(page.substr(0, page.find('\n')), head)) << page.substr(0, 100);
}

TEST_P(Manual, EveryOptionOfTheHelpIsOnThePageAndOfferedByTheShells) {
  const std::string help = shell(kBin + GetParam() + " --help").output;
  const std::string page = print("man");
  const std::string bash = print("bash");
  const std::string zsh = print("zsh");
  // Only at the beginning of a line, since a description may name an option of another program.
  const std::regex option("\n +(?:-[a-zA-Z],)?(--[a-z][a-zA-Z0-9_-]*)");
  for (auto it = std::sregex_iterator(help.begin(), help.end(), option); it != std::sregex_iterator(); ++it) {
    const std::string name = it->str(1);
    EXPECT_NE(std::regex_replace(page, std::regex("\\\\-"), "-").find(name), std::string::npos) << name;
    EXPECT_NE(bash.find(name), std::string::npos) << name;
    EXPECT_NE(zsh.find(name), std::string::npos) << name;
  }
}

TEST_P(Manual, EveryOptionIsWordsJoinedByDashesThenItsUnit) {
  const std::regex option("[ ']--[A-Za-z][A-Za-z0-9_-]*");
  const std::regex spelling(
      "--[A-Za-z][a-z0-9]*(-[a-z0-9]+)*(_(rad|rad_s|s|C|A|Nm|Ncm|kgm2|Nm_rad|Nms_rad))?");
  const std::string bash = print("bash");
  int count = 0;
  for (auto it = std::sregex_iterator(bash.begin(), bash.end(), option); it != std::sregex_iterator();
       ++it, ++count)
    EXPECT_TRUE(std::regex_match(it->str().substr(1), spelling)) << it->str();
  EXPECT_GE(count, 3);
}

TEST_P(Manual, TheShellsTakeTheirCompletions) {
  EXPECT_EQ(shell(kBin + GetParam() + " --manual bash | bash -n").output, "");
  EXPECT_TRUE(print("zsh").starts_with(std::string("#compdef ") + GetParam() + "\n"));
  if (!is_there("zsh")) return;
  EXPECT_EQ(shell(kBin + GetParam() + " --manual zsh | zsh -n /dev/stdin").output, "");
}

TEST_P(Manual, AnotherKindIsAnError) {
  EXPECT_NE(shell(kBin + GetParam() + " --manual html").status, 0);
}

INSTANTIATE_TEST_SUITE_P(Programs, Manual,
                         ::testing::Values("strainwaved", "strainwavectl", "strainwave-telemetry",
                                           "strainwave-sim", "strainwave-design", "strainwave-can-sim"),
                         [](const auto& program) {
                           std::string name = program.param;
                           std::erase(name, '-');
                           return name;
                         });

/// Completions that bash offers for the last of `words`. A strainwavectl in the folder `network` lists the joints.
std::string completions(const std::string& words, const std::string& network = "/nowhere") {
  const std::string program = words.substr(0, words.find(' '));
  std::string function = "_" + program;
  std::replace(function.begin(), function.end(), '-', '_');
  return shell("bash -c 'eval \"$(" + kBin + program + " --manual bash)\"; PATH=" + network +
               ":$PATH; COMP_WORDS=(" + words + "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); " + function +
               "; echo \"${COMPREPLY[@]}\"'")
      .output;
}

TEST(Page, ShowsWhatMayBeLeftOutInBrackets) {
  const std::string page = shell(kBin + "strainwavectl --manual man").output;
  EXPECT_NE(page.find("\\fBstatus\\fR [\\fIJOINT\\fR]\n"), std::string::npos);
  EXPECT_NE(page.find("\\fBwatch\\fR [\\fIJOINT\\fR ...]\n"), std::string::npos);
  EXPECT_NE(page.find("\\fBpause\\fR \\fIJOINT\\fR\n"), std::string::npos);
  EXPECT_NE(page.find("\\fBenable\\fR [\\fIJOINT\\fR ...]\n"), std::string::npos);
}

TEST(Page, OfTheViewerNamesTheOptionsOfItsLauncher) {
  const std::string page = STRAINWAVE_BINARY_DIR "/man/strainwave-spy.1";
  if (!std::filesystem::exists(page)) GTEST_SKIP() << "not built, as under a sanitizer";
  const std::string help = shell(kBin + "strainwave-spy --help").output;
  const std::regex option("--[a-z-]+");
  const std::string text = shell("sed 's/\\\\-/-/g' " + page).output;
  EXPECT_NE(help.find("--lcm-url"), std::string::npos) << help;
  for (auto it = std::sregex_iterator(help.begin(), help.end(), option); it != std::sregex_iterator(); ++it)
    EXPECT_NE(text.find(it->str()), std::string::npos) << it->str();
  if (!is_there("groff")) return;
  EXPECT_EQ(shell("groff -man -Tascii -ww -z " + page).output, "");
}

TEST(BashCompletion, OffersTheWordsThatAnOptionOrArgumentTakes) {
  EXPECT_EQ(completions("strainwavectl keygen --role \"\""), "operator engineer\n");
  EXPECT_EQ(completions("strainwavectl keygen --role e"), "engineer\n");
  EXPECT_EQ(completions("strainwavectl inject elbow sensor_na"), "sensor_nan\n");
  EXPECT_EQ(completions("strainwavectl --timeout_s 3 inject --for_s 1 elbow none"), "none\n")
      << "values of options are no arguments";
  if (std::filesystem::exists(kBin + "strainwave-design")) {
    EXPECT_EQ(completions("strainwave-design gains --controller C"), "C1 C2 C3 C4\n");
  }
}

TEST(BashCompletion, OffersTheJointsThatAreHeard) {
  const TemporaryFolder folder;
  const std::filesystem::path program = folder.path() / "strainwavectl";
  std::ofstream(program) << "#!/bin/sh\ntest \"$1 $2\" = 'status --json' &&\n"
                         << "echo '[{\"prefix\":\"SW\",\"joint\":\"elbow\"},{\"joint\": \"wrist\"}]'\n";
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  const std::string network = folder.path().string();
  EXPECT_EQ(completions("strainwavectl enable \"\"", network), "elbow wrist\n");
  EXPECT_EQ(completions("strainwavectl watch elbow w", network), "wrist\n");
  EXPECT_EQ(completions("strainwavectl move elbow \"\"", network), "\n") << "a position";
}

TEST(BashCompletion, OffersCommandsThenTheirOptions) {
  EXPECT_EQ(completions("strainwavectl st"), "status\n");
  EXPECT_NE(completions("strainwavectl \"\"").find("identify"), std::string::npos);
  EXPECT_EQ(completions("strainwavectl --pre"), "--prefix\n");
  EXPECT_EQ(completions("strainwavectl --key k identify elbow --ste"), "--steady_s\n");
  EXPECT_EQ(completions("strainwavectl move elbow --ste"), "\n") << "another command's option";
  EXPECT_EQ(completions("strainwavectl move --pre"), "--prefix\n")
      << "options for all commands may stand behind";
}

}  // namespace
}  // namespace strainwave
