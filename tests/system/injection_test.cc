// SPDX-License-Identifier: BSD-3-Clause
// Faults injected into the running daemon over LCM, and the flight records that they leave.
#include <filesystem>
#include <fstream>
#include <thread>

#include "drivers/injected_fault.h"
#include "lcmtypes/reading_doubt.h"
#include "tests/support/daemon_fixture.h"
#include "tests/support/private_network.h"

namespace strainwave::testing {
namespace {

using std::chrono::milliseconds;

class DaemonInjection : public DaemonTest {
 protected:
  void start_holding(const std::string& configuration) {
    daemon_.emplace(folder_, configuration);
    client_.emplace();
    ASSERT_TRUE(client_->wait_for_state("elbow", [](const state_v1&) { return true; })) << daemon_->log();
    const Answer loaded = client_->load("elbow", shipped_table());
    ASSERT_TRUE(loaded.accepted) << loaded.text;
    ASSERT_TRUE(client_->command("elbow", Action::kEnable).accepted);
    ASSERT_TRUE(client_->wait_for_mode("elbow", Mode::kHolding)) << daemon_->log();
  }
  Answer inject(InjectedFault kind, double for_s, double amount) {
    return client_->send_and_wait(
        "elbow", "INJECT", client_->make_injection("elbow", static_cast<std::int32_t>(kind), for_s, amount));
  }
  std::vector<std::filesystem::path> records() const {
    std::vector<std::filesystem::path> paths;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "records", error))
      if (entry.path().string().ends_with(".flight.csv")) paths.push_back(entry.path());
    return paths;
  }

  std::optional<DaemonProcess> daemon_;
  std::optional<TestClient> client_;
};

TEST_F(DaemonInjection, LatchesTheFaultAndLeavesAFlightRecord) {
  start_holding(configuration("[recorder]\ndirectory = \"records\"\nseconds = 1\n"));
  ASSERT_TRUE(client_->move("elbow", 1.0).accepted);
  const Answer answer = inject(InjectedFault::kSensorNan, 0.5, 0.0);
  ASSERT_TRUE(answer.accepted) << answer.text;
  ASSERT_TRUE(client_->wait_for_mode("elbow", Mode::kFaulted));
  EXPECT_EQ(client_->state("elbow")->fault, static_cast<int>(Fault::kImplausibleReading));
  EXPECT_EQ(client_->state("elbow")->drive_error, doubt_number(ReadingDoubt::kPositionNotFinite));
  EXPECT_NE(daemon_->log().find("fault 5: implausible reading: the position is not a number, see"),
            std::string::npos)
      << daemon_->log();
  for (int i = 0; i < 100 && records().empty(); ++i) client_->pump(milliseconds(50));
  ASSERT_EQ(records().size(), 1U) << daemon_->log();
  std::ifstream record(records().front());
  std::string line;
  ASSERT_TRUE(std::getline(record, line));
  EXPECT_EQ(line, "# strainwave-flight-record 1");
  int rows = -1;
  while (std::getline(record, line)) rows += line.starts_with("#") ? 0 : 1;
  EXPECT_GT(rows, 100);

  client_->pump(milliseconds(700));
  EXPECT_EQ(client_->state("elbow")->mode, static_cast<int>(Mode::kFaulted))
      << "the cause is gone, the fault is not";
  ASSERT_TRUE(client_->command("elbow", Action::kClearFault).accepted);
  ASSERT_TRUE(client_->command("elbow", Action::kEnable).accepted);
  EXPECT_TRUE(client_->wait_for_mode("elbow", Mode::kHolding));
}

TEST_F(DaemonInjection, GoesOnWhenTheRecordCannotBeWritten) {
  start_holding(configuration("[recorder]\ndirectory = \"/proc/no/such/place\"\nseconds = 0.2\n"));
  ASSERT_TRUE(inject(InjectedFault::kPowerLost, 0.1, 0.0).accepted);
  ASSERT_TRUE(client_->wait_for_mode("elbow", Mode::kFaulted));
  EXPECT_TRUE(daemon_->wait_for_log("flight record lost", std::chrono::seconds(5))) << daemon_->log();
  client_->pump(milliseconds(200));
  ASSERT_TRUE(client_->command("elbow", Action::kClearFault).accepted);
  ASSERT_TRUE(client_->command("elbow", Action::kEnable).accepted);
  EXPECT_TRUE(client_->wait_for_mode("elbow", Mode::kHolding));
}

TEST_F(DaemonInjection, FaultsWhenTooManyPeriodsAreMissed) {
  std::string text = configuration();
  const std::string key = "missed_share_limit = 1";
  text.replace(text.find(key), key.size(), "missed_share_limit = 0.2");
  start_holding(text);
  ASSERT_TRUE(inject(InjectedFault::kOverrun, 1.0, 0.003).accepted);
  ASSERT_TRUE(client_->wait_for_mode("elbow", Mode::kFaulted));
  EXPECT_EQ(client_->state("elbow")->fault, static_cast<int>(Fault::kPeriodsMissed));
  ASSERT_TRUE(client_->wait_for_timing());
  EXPECT_GE(client_->timing()->overruns, 20);
}

}  // namespace
}  // namespace strainwave::testing
