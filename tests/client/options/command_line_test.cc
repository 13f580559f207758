// SPDX-License-Identifier: BSD-3-Clause
#include "client/options/command_line.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

struct Result {
  ExitStatus status;
  std::string out;
  std::string err;
};

using Arguments = std::vector<const char*>;

Result run(const Arguments& given) {
  Arguments arguments{"strainwavectl"};
  arguments.insert(arguments.end(), given.begin(), given.end());
  std::ostringstream out;
  std::ostringstream err;
  const ExitStatus status =
      run_command_line(static_cast<int>(arguments.size()), arguments.data(), out, err, false);
  return {status, out.str(), err.str()};
}

// Every wait is short and within the process. There is no daemon.
Result run_alone(const Arguments& given) {
  Arguments arguments{"--lcm-url", "memq://", "--timeout_s", "0.1"};
  arguments.insert(arguments.end(), given.begin(), given.end());
  return run(arguments);
}

TEST(CommandLine, HelpNamesEveryExitStatusAndCommand) {
  const Result result = run({"--help"});
  EXPECT_EQ(result.status, ExitStatus::kDone);
  for (const char* part :
       {"\n  0 ", "\n  1 ", "\n  2 ", "\n  3 ", "\n  130 ", "status", "timing", "watch", "enable", "disable",
        "move", "hold", "clear-fault", "load-table", "revert-table", "inject", "record"}) {
    EXPECT_NE(result.out.find(part), std::string::npos) << part;
  }
}

TEST(CommandLine, ThatMakesNoSenseIsAUsageError) {
  for (const std::vector<const char*>& arguments :
       std::vector<std::vector<const char*>>{{},
                                             {"statsu"},
                                             {"move", "elbow"},
                                             {"move", "elbow", "90deg"},
                                             {"move", "elbow", "nan"},
                                             {"move", "el.bow", "1"},
                                             {"inject", "elbow", "gremlins"},
                                             {"inject", "elbow", "sensor_nan", "--amount", "1"},
                                             {"inject", "elbow", "sensor_noisy"},
                                             {"inject", "elbow", "slow_read", "--amount", "2"},
                                             {"enable"},
                                             {"enable", "elbow", "--all"},
                                             {"pause", "elbow", "wrist"},
                                             {"--prefix", "a.b", "status"},
                                             {"--timeout_s", "0", "status"},
                                             {"--timeout_s", "inf", "status"},
                                             {"watch", "--interval_s", "-1"},
                                             {"record", "elbow"},
                                             {"load-table"},
                                             {"load-table", "a.b", "file"},
                                             {"load-table", "a", "b", "c"}}) {
    const Result result = run(arguments);
    EXPECT_EQ(result.status, ExitStatus::kUsage) << ::testing::PrintToString(arguments);
    EXPECT_TRUE(result.err.starts_with("strainwavectl: ")) << result.err;
  }
}

TEST(CommandLine, NamesACommandThatDoesNotExist) {
  EXPECT_NE(run({"statsu"}).err.find("'statsu' is not a command"), std::string::npos);
}

TEST(CommandLine, NamesTheNearestRightWord) {
  EXPECT_NE(run({"statsu"}).err.find("did you mean status?"), std::string::npos);
  EXPECT_NE(
      run({"--tiemout_s", "1", "status"}).err.find("--tiemout_s is not an option; did you mean --timeout_s?"),
      std::string::npos);
  EXPECT_NE(run({"watch", "--interval", "1"}).err.find("did you mean --interval_s?"), std::string::npos);
}

TEST(CommandLine, NamesUnexpectedWordsAsTheyWereTyped) {
  EXPECT_NE(run({"pause", "elbow", "wrist", "hip"}).err.find("unexpected: 'wrist' 'hip'"), std::string::npos)
      << run({"pause", "elbow", "wrist", "hip"}).err;
}

TEST(CommandLine, RefusesAValueWhereNoneIsTakenAndNamesTheOptionsThatTakeOne) {
  const auto error_of = [](const std::vector<const char*>& words) {
    const Result result = run(words);
    EXPECT_EQ(result.status, ExitStatus::kUsage);
    return result.err;
  };
  EXPECT_EQ(error_of({"move", "elbow", "0.1", "--wait=3"}),
            "strainwavectl: --wait takes no value: '3' was given; --speed-limit_rad_s, --tolerance_rad take "
            "one; see "
            "strainwavectl --help\n");
  EXPECT_TRUE(error_of({"enable", "--all=yes"})
                  .starts_with("strainwavectl: --all takes no value: 'yes' was given; see "));
  EXPECT_TRUE(error_of({"--json=2", "status"})
                  .starts_with("strainwavectl: --json takes no value: '2' was given; see "));
}

TEST(CommandLine, RefusesATimeOutTooShortToHearAnything) {
  const Result result = run({"--timeout_s", "0.01", "status"});
  EXPECT_EQ(result.status, ExitStatus::kUsage);
  EXPECT_NE(result.err.find("'0.01' is not a time-out: 0.1 to 3600 seconds"), std::string::npos)
      << result.err;
}

TEST(CommandLine, OrdersOneJointSeveralOrAll) {
  for (const char* order : {"enable", "disable", "hold", "clear-fault", "home", "release"}) {
    EXPECT_EQ(run_alone({order}).status, ExitStatus::kUsage) << order;
    EXPECT_NE(run_alone({order}).err.find("--all"), std::string::npos) << run_alone({order}).err;
    EXPECT_EQ(run_alone({order, "elbow", "--all"}).status, ExitStatus::kUsage) << order;
    EXPECT_EQ(run_alone({order, "--all"}).status, ExitStatus::kNoAnswer) << order;
  }
  const Result two = run_alone({"enable", "elbow", "wrist"});
  EXPECT_EQ(two.status, ExitStatus::kNoAnswer);
  EXPECT_EQ(std::count(two.err.begin(), two.err.end(), '\n'), 2) << two.err;
}

TEST(CommandLine, TakesANegativePositionForANumber) {
  for (const char* position : {"-0.5", "-.5", "-1e-3", "-7"}) {
    EXPECT_EQ(run_alone({"move", "elbow", position}).status, ExitStatus::kNoAnswer) << position;
  }
}

TEST(CommandLine, CallsANumberThatIsNotFiniteNoOption) {
  for (const char* position : {"-inf", "-nan", "-infinity"}) {
    const Result result = run_alone({"move", "elbow", position});
    EXPECT_EQ(result.status, ExitStatus::kUsage);
    EXPECT_NE(result.err.find("'" + std::string(position) + "' is not a finite number"), std::string::npos)
        << result.err;
  }
}

TEST(CommandLine, WithoutADaemonIsNoAnswer) {
  for (const std::vector<const char*>& arguments :
       std::vector<std::vector<const char*>>{{"status"},
                                             {"status", "elbow"},
                                             {"timing"},
                                             {"watch"},
                                             {"enable", "elbow"},
                                             {"hold", "elbow"},
                                             {"clear-fault", "elbow"},
                                             {"move", "elbow", "0.1"}}) {
    const Result result = run_alone(arguments);
    EXPECT_EQ(result.status, ExitStatus::kNoAnswer) << ::testing::PrintToString(arguments);
    EXPECT_EQ(result.out, "");
    if (std::string_view(arguments[0]) == "hold") {
      EXPECT_NE(result.err.find("elbow: the stop was sent 8 times, and no answer came"), std::string::npos)
          << result.err;
    }
  }
}

TEST(CommandLine, ReportsAFileThatIsNotThere) {
  const Result result = run_alone({"load-table", "elbow", "/nonexistent/table.json"});
  EXPECT_EQ(result.status, ExitStatus::kUsage);
  EXPECT_NE(result.err.find("/nonexistent/table.json"), std::string::npos) << result.err;
}

TEST(CommandLine, ReportsAnLcmUrlThatCannotWork) {
  for (const char* url : {"udpm://10.0.0.1:7667", "carrier-pigeon://", "nonsense"}) {
    const Result result = run({"--lcm-url", url, "status"});
    EXPECT_EQ(result.status, ExitStatus::kNoAnswer) << url;
    EXPECT_NE(result.err.find(url), std::string::npos) << result.err;
  }
}

// One failing command of each family, and each kind of failure that needs no daemon.
TEST(CommandLine, AnswersEveryFailureAsOneJsonObjectWithJson) {
  const TemporaryFolder folder;
  const std::string taken = (folder.path() / "taken").string();
  std::ofstream(taken) << "no log\n";
  for (const Arguments& words : std::vector<Arguments>{{"status", "elbow"},
                                                       {"timing"},
                                                       {"watch"},
                                                       {"enable", "elbow"},
                                                       {"hold", "--all"},
                                                       {"move", "elbow", "0.1"},
                                                       {"move", "elbow", "0.1", "wrist", "nowhere"},
                                                       {"path", "/nonexistent/path.csv"},
                                                       {"pause", "elbow"},
                                                       {"load-table", "elbow", "/nonexistent/table.json"},
                                                       {"inject", "elbow", "gremlins"},
                                                       {"identify", "elbow", "--out", taken.c_str()},
                                                       {"record", "--out", taken.c_str()},
                                                       {"export", taken.c_str(), "--out", taken.c_str()},
                                                       {"play", taken.c_str(), "--joint", "elbow"},
                                                       {"plot-record", taken.c_str()},
                                                       {"keygen", "--out", taken.c_str()},
                                                       {"can-scan", "no_such_can0"},
                                                       {"can-check", "/nonexistent/config.toml"},
                                                       {"gpio-check", "/nonexistent/config.toml"},
                                                       {"move", "elbow"},
                                                       {"watch", "--interval_s", "-1"}}) {
    Arguments with_json = words;
    with_json.push_back("--json");
    const Result plain = run_alone(words);
    const Result result = run_alone(with_json);
    ASSERT_NE(result.status, ExitStatus::kDone) << words[0];
    EXPECT_EQ(result.status, plain.status) << words[0];
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    const auto json = nlohmann::json::parse(result.err);
    EXPECT_EQ(json.at("exit_status"), static_cast<int>(result.status)) << result.err;
    EXPECT_EQ(json.at("command"), words[0]);
    EXPECT_EQ("strainwavectl: " + json.at("text").get<std::string>() + "\n", plain.err);
    const bool of_one = std::ranges::count(words, std::string_view("elbow")) > 0 &&
                        std::ranges::count(words, std::string_view("wrist")) == 0;
    EXPECT_EQ(json.value("joint", ""), of_one ? "elbow" : "") << result.err;
  }
}

TEST(CommandLine, AnswersWordsOfWhichItUnderstandsNothingAsJsonToo) {
  for (const Arguments& words :
       std::vector<Arguments>{{"--json"}, {"--json", "statsu"}, {"status", "--jsn", "--json"}}) {
    const auto json = nlohmann::json::parse(run(words).err);
    EXPECT_EQ(json.at("error"), "wrong input");
    EXPECT_EQ(json.at("exit_status"), 2);
  }
}

TEST(CommandLine, NamesWithJsonAllJointsThatAFailureMayBeOf) {
  const Result result = run_alone({"move", "elbow", "0.1", "wrist", "nowhere", "--json"});
  EXPECT_EQ(nlohmann::json::parse(result.err).at("joints"), (std::vector<std::string>{"elbow", "wrist"}))
      << result.err;
}

TEST(CommandLine, TellsWithJsonWhatFailedOfEachOfSeveralJoints) {
  const Result result = run_alone({"enable", "elbow", "wrist", "--json"});
  const auto json = nlohmann::json::parse(result.err);
  EXPECT_EQ(json.at("joints"), (std::vector<std::string>{"elbow", "wrist"}));
  ASSERT_EQ(json.at("failures").size(), 2U) << result.err;
  EXPECT_EQ(json.at("failures")[1].at("joint"), "wrist");
  EXPECT_EQ(json.at("failures")[1].at("error"), "no answer");
  EXPECT_EQ(json.at("failures")[1].at("exit_status"), 3);
}

TEST(CommandLine, TakesOptionsBeforeAndAfterTheCommand) {
  EXPECT_EQ(run({"status", "--lcm-url", "memq://", "--timeout_s", "0.1", "--prefix", "LAB"}).status,
            ExitStatus::kNoAnswer);
}

}  // namespace
}  // namespace strainwave
