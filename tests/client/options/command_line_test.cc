#include "client/options/command_line.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <vector>

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

// Every wait is short and in-process; no daemon is there.
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

TEST(CommandLine, WithoutADaemonIsNoAnswer) {
  for (const std::vector<const char*>& arguments :
       std::vector<std::vector<const char*>>{{"status"},
                                             {"status", "elbow"},
                                             {"timing"},
                                             {"watch"},
                                             {"enable", "elbow"},
                                             {"disable", "elbow"},
                                             {"hold", "elbow"},
                                             {"clear-fault", "elbow"},
                                             {"move", "elbow", "0.1"}}) {
    const Result result = run_alone(arguments);
    EXPECT_EQ(result.status, ExitStatus::kNoAnswer) << ::testing::PrintToString(arguments);
    EXPECT_EQ(result.out, "");
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

TEST(CommandLine, TakesOptionsBeforeAndAfterTheCommand) {
  EXPECT_EQ(run({"status", "--lcm-url", "memq://", "--timeout_s", "0.1", "--prefix", "LAB"}).status,
            ExitStatus::kNoAnswer);
}

}  // namespace
}  // namespace strainwave
