// Man pages and completions as the programs print them.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <string>

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
    if (!std::filesystem::exists(kBin + GetParam())) GTEST_SKIP() << "not built";
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
  if (!is_there("groff")) return;
  const Result formatted = shell(kBin + GetParam() + " --manual man | groff -man -Tascii -ww -z");
  EXPECT_EQ(formatted.status, 0);
  EXPECT_EQ(formatted.output, "");
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
                                           "strainwave-sim", "strainwave-design"),
                         [](const auto& program) {
                           std::string name = program.param;
                           std::erase(name, '-');
                           return name;
                         });

/// What bash offers for the last of `words`.
std::string completions(const std::string& words) {
  return shell("bash -c 'eval \"$(" + kBin + "strainwavectl --manual bash)\"; COMP_WORDS=(" + words +
               "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _strainwavectl; echo \"${COMPREPLY[@]}\"'")
      .output;
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
