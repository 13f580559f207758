// SPDX-License-Identifier: BSD-3-Clause
// Checks the includes between folders against the table in docs/architecture.md.
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <set>
#include <sstream>
#include <string_view>

#include "tests/support/class_sizes.h"
#include "tests/support/include_rules.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/type_names.h"

namespace strainwave::testing {
namespace {

const IncludeRules& rules() {
  static const IncludeRules kRules(STRAINWAVE_SOURCE_DIR "/docs/architecture.md");
  return kRules;
}

constexpr std::string_view kLicenceMark = "SPDX-License-Identifier: ";

/// Sources without their licence in the first line.
std::vector<std::string> find_without_licence(const std::filesystem::path& root) {
  std::vector<std::string> found;
  for (const std::filesystem::path& path : sources_under(root)) {
    std::ifstream file(path);
    std::string first;
    std::getline(file, first);
    if (first != "// " + std::string(kLicenceMark) + "BSD-3-Clause")
      found.push_back(path.lexically_relative(root).string());
  }
  return found;
}

/// Sources above 300 lines that do not say why in their first lines.
std::vector<std::string> find_long_files(const std::filesystem::path& root) {
  constexpr int kLines = 300;
  constexpr int kFirst = 6;
  std::vector<std::string> found;
  for (const std::filesystem::path& path : sources_under(root)) {
    std::ifstream file(path);
    int lines = 0;
    bool explained = false;
    for (std::string line; std::getline(file, line);) {
      if (line.find(kLicenceMark) != std::string::npos) continue;
      ++lines;
      explained = explained || (lines < kFirst && line.find("bove 300 lines") != std::string::npos);
    }
    if (lines > kLines && !explained)
      found.push_back(path.lexically_relative(root).string() + " has " + std::to_string(lines) + " lines");
  }
  return found;
}

bool allowed(const char* file, const char* line) {
  return rules().find_defect(file, line).empty();
}

TEST(Layering, HoldsInTheWholeTree) {
  const std::vector<std::string> defects = rules().find_defects(STRAINWAVE_SOURCE_DIR);
  std::ostringstream list;
  for (const std::string& defect : defects) list << defect << '\n';
  EXPECT_TRUE(defects.empty()) << list.str();
}

TEST(Layering, AllowsNothingThatNobodyUses) {
  EXPECT_EQ(rules().find_unused(STRAINWAVE_SOURCE_DIR), std::vector<std::string>{});
}

TEST(Layering, IsReadFromThePage) {
  EXPECT_GE(rules().row_count(), 25U);
}

TEST(Layering, HasOneTypeForAQualifiedName) {
  const std::vector<std::string> defects = find_repeated_types(STRAINWAVE_SOURCE_DIR);
  std::ostringstream list;
  for (const std::string& defect : defects) list << defect << '\n';
  EXPECT_TRUE(defects.empty()) << list.str();
}

TEST(Layering, NamesTheLicenceInTheFirstLineOfEverySource) {
  EXPECT_EQ(find_without_licence(STRAINWAVE_SOURCE_DIR), std::vector<std::string>{})
      << "begin the file with // " << kLicenceMark << "BSD-3-Clause";
}

TEST(Layering, KeepsFilesShortOrSaysWhyNot) {
  EXPECT_EQ(find_long_files(STRAINWAVE_SOURCE_DIR), std::vector<std::string>{})
      << "above 300 lines: split it, or say in its first lines why it is (\"Above 300 lines: ...\")";
}

/// Drivers, supervisor and readers that are still larger. Do not add to this list.
const std::set<std::string, std::less<>> kLarge{
    "Admission",  "CanBus",     "Cia402Node",        "Node",
    "OdriveNode", "Supervisor", "SimulatedActuator", "TomlSection"};

std::string class_of(const std::string& defect) {
  return defect.substr(0, defect.find(' '));
}

TEST(Layering, KeepsClassesSmall) {
  std::set<std::string, std::less<>> found;
  for (const std::string& defect : find_large_classes(STRAINWAVE_SOURCE_DIR, 20, 25)) {
    found.insert(class_of(defect));
    EXPECT_TRUE(kLarge.contains(class_of(defect)))
        << defect << ": above 20 or 25 it holds several ideas: a timing, an estimate, a queue, a mode";
  }
  EXPECT_EQ(found, kLarge) << "a class that has become small leaves the list";
}

TEST(ClassSizes, CountDataAndMethodsOfEachClassOnItsOwn) {
  const std::string source =
      "class One final : public Base {\n public:\n  One() : a_{1}, b_(2) {}\n  explicit One(int a);\n  "
      "~One();\n"
      "  One& operator=(const One&) = delete;\n  int a() const { return a_; }\n  virtual void f(int x = 0) = "
      "0;\n"
      "  using T = int;\n  static constexpr int kA = f(1);\n  enum class E { kB, kC };\n"
      "  struct Inner { int x = 0; int y{0}; };\n private:\n  int a_{1};\n  std::function<void(int)> g_;\n"
      "  static int h(std::array<int, 2> values);\n  double b_ = sqrt(2.0);\n};\nclass Two;\n";
  const std::vector<ClassSize> sizes = class_sizes(source);
  ASSERT_EQ(sizes.size(), 2U);
  EXPECT_EQ(sizes[0].name, "Inner");
  EXPECT_EQ(sizes[0].members, 2);
  EXPECT_EQ(sizes[1].name, "One");
  EXPECT_EQ(sizes[1].members, 3) << "a_, g_, b_";
  EXPECT_EQ(sizes[1].methods, 3) << "a, f, h";
}

TEST(Types, AreFoundAtNamespaceLevelAlone) {
  const std::string source =
      "// struct Comment {};\n#define X struct Macro {}\nnamespace a::b {\nstruct One { struct Inner {}; };\n"
      "template <typename T>\nclass Two final : public One {};\nenum class Three : int { kA };\n"
      "namespace {\nstruct Hidden {};\n}\nstruct Four;\nvoid f(struct Five* five) { struct Local {}; }\n"
      "const char* text = \"struct Text {\";\nconst char brace = '{';\nlong n = 1'000;\n}\nstruct Global "
      "{};\nstruct a::b::Two::Member {};\n";
  EXPECT_EQ(types_defined_in(source),
            (std::vector<std::string>{"a::b::One", "a::b::Two", "a::b::Three", "Global"}));
}

TEST(Layering, FollowsTheArrows) {
  EXPECT_TRUE(allowed("control/friction/friction.cc", "#include \"control/friction/friction.h\""));
  EXPECT_TRUE(allowed("design/gains/lmi.cc", "#include \"control/table/gain_table.h\""));
  EXPECT_TRUE(allowed("drivers/simulated_actuator.h", "#include \"sim/joint/joint_plant.h\""));
  EXPECT_TRUE(allowed("daemon/realtime/joint/joint_loop.h", "#include \"drivers/actuator.h\""));
  EXPECT_TRUE(allowed("client/protocol/client.h", "#include \"lcmtypes/channels.h\""));
  EXPECT_TRUE(allowed("client/commands/can_commands.cc", "#include \"drivers/can/can_scan.h\""));
  EXPECT_TRUE(allowed("tests/design/gains/lmi_test.cc", "#include \"design/gains/lmi.h\""));
  EXPECT_TRUE(allowed("bench/loop.cc", "#include \"daemon/realtime/joint/joint_loop.h\""));
}

TEST(Layering, RefusesEveryArrowThatIsNotThere) {
  EXPECT_FALSE(allowed("daemon/supervisor.cc", "#include \"design/gains/lmi.h\""));
  EXPECT_FALSE(allowed("daemon/supervisor.cc", "#include \"sim/joint/joint_plant.h\""));
  EXPECT_FALSE(allowed("daemon/supervisor.cc", "#include \"client/protocol/client.h\""));
  EXPECT_FALSE(allowed("control/friction/friction.cc", "#include \"drivers/actuator.h\""));
  EXPECT_FALSE(allowed("control/friction/friction.cc", "#include \"design/gains/lmi.h\""));
  EXPECT_FALSE(allowed("sim/joint/joint_plant.cc", "#include \"drivers/actuator.h\""));
  EXPECT_FALSE(allowed("drivers/can/cia402.cc", "#include \"sim/joint/joint_plant.h\""));
  EXPECT_FALSE(allowed("lcmtypes/wire.h", "#include \"daemon/config/config.h\""));
  EXPECT_FALSE(allowed("client/protocol/client.cc", "#include \"daemon/config/config.h\""));
  EXPECT_FALSE(allowed("client/protocol/client.cc", "#include \"sim/joint/joint_plant.h\""));
  EXPECT_FALSE(allowed("client/protocol/client.cc", "#include \"drivers/can/can_bus.h\""));
  EXPECT_FALSE(allowed("design/gains/lmi.cc", "#include \"sim/joint/joint_plant.h\""));
}

TEST(Layering, HasOneStackInsideTheDaemon) {
  EXPECT_TRUE(allowed("daemon/assembly.cc", "#include \"daemon/config/config.h\""));
  EXPECT_TRUE(allowed("daemon/config/config.h", "#include \"daemon/realtime/joint/joint_loop.h\""));
  EXPECT_TRUE(allowed("daemon/admission/a.h", "#include \"daemon/realtime/joint/orders.h\""));
  for (const char* folder : {"gateway", "realtime", "records", "admission", "config"}) {
    const std::string file = std::string("daemon/") + folder + "/a.cc";
    EXPECT_FALSE(allowed(file.c_str(), "#include \"daemon/supervisor.h\"")) << folder;
    EXPECT_FALSE(allowed(file.c_str(), "#include \"daemon/log.h\"")) << folder;
    const bool is_top = std::string_view(folder) == "config";
    EXPECT_EQ(allowed(file.c_str(), "#include \"daemon/config/config.h\""), is_top) << folder;
    const bool is_admission = std::string_view(folder) == "admission";
    EXPECT_EQ(allowed(file.c_str(), "#include \"daemon/admission/admission.h\""), is_admission) << folder;
  }
  EXPECT_FALSE(allowed("daemon/gateway/gateway.cc", "#include \"daemon/realtime/joint/orders.h\""));
  EXPECT_FALSE(allowed("daemon/realtime/a.cc", "#include \"daemon/records/flight_record_file.h\""));
  EXPECT_FALSE(allowed("daemon/realtime/a.cc", "#include \"daemon/gateway/gateway_process.h\""));
}

TEST(Layering, HasOneStackInsideTheClientTheSimulatorAndTheBus) {
  const std::vector<std::string> stack{"link", "text", "watch", "commands", "options"};
  for (std::size_t from = 0; from < stack.size(); ++from)
    for (std::size_t to = from + 1; to < stack.size(); ++to)
      EXPECT_FALSE(allowed(("client/" + stack[from] + "/a.cc").c_str(),
                           ("#include \"client/" + stack[to] + "/a.h\"").c_str()))
          << stack[from] << " -> " << stack[to];
  EXPECT_TRUE(allowed("client/options/a.cc", "#include \"client/commands/commands.h\""));
  EXPECT_FALSE(allowed("sim/joint/a.cc", "#include \"sim/studies/scenarios.h\""));
  EXPECT_FALSE(allowed("sim/studies/a.cc", "#include \"sim/commands/commands.h\""));
  EXPECT_TRUE(allowed("drivers/can/cia402/a.cc", "#include \"drivers/can/canopen/sdo_client.h\""));
  EXPECT_FALSE(allowed("drivers/can/canopen/a.cc", "#include \"drivers/can/cia402/cia402_node.h\""));
  EXPECT_FALSE(allowed("drivers/can/odrive/a.cc", "#include \"drivers/can/canopen/canopen.h\""));
  EXPECT_FALSE(allowed("drivers/gpio/a.cc", "#include \"drivers/can/can_bus.h\""));
}

TEST(Layering, LetsNothingThatIsShippedIncludeTests) {
  for (const char* file : {"control/a.cc", "design/a.cc", "sim/a.cc", "drivers/a.cc", "lcmtypes/a.cc",
                           "daemon/a.cc", "client/a.cc", "telemetry/a.cc"}) {
    EXPECT_FALSE(allowed(file, "#include \"tests/support/include_rules.h\"")) << file;
  }
}

TEST(Layering, SeesAnIncludeHoweverItIsSpaced) {
  for (const char* line : {"#include \"design/gains/lmi.h\"", "  #  include   \"design/gains/lmi.h\"",
                           "#include\"design/gains/lmi.h\"", "#include \"design/gains/lmi.h\"  // why",
                           "#include <design/gains/lmi.h>", "#include <strainwave/joint.h>"}) {
    EXPECT_FALSE(allowed("daemon/a.cc", line)) << line;
  }
  EXPECT_TRUE(allowed("daemon/a.cc", "// #include \"design/gains/lmi.h\" would be wrong here"));
}

TEST(Layering, WantsIncludesFromTheRoot) {
  EXPECT_FALSE(allowed("daemon/a.cc", "#include \"config.h\""));
  EXPECT_FALSE(allowed("daemon/realtime/a.cc", "#include \"../config.h\""));
  EXPECT_FALSE(allowed("daemon/realtime/a.cc", "#include \"daemon/../design/lmi.h\""));
}

TEST(Layering, KeepsLibrariesWhereTheyBelong) {
  EXPECT_TRUE(allowed("design/gains/sdpa_call.cc", "#include <sdpa_call.h>"));
  EXPECT_FALSE(allowed("daemon/a.cc", "#include <sdpa_call.h>"));
  EXPECT_TRUE(allowed("daemon/gateway/gateway.h", "#include <lcm/lcm-cpp.hpp>"));
  EXPECT_FALSE(allowed("daemon/supervisor.cc", "#include <lcm/lcm-cpp.hpp>"));
  EXPECT_FALSE(allowed("client/watch/order_desk.h", "#include <lcm/lcm-cpp.hpp>"));
  EXPECT_FALSE(allowed("telemetry/a.cc", "#include <lcm/lcm-cpp.hpp>"));
  EXPECT_TRUE(allowed("telemetry/server/a.cc", "#include <boost/asio.hpp>"));
  EXPECT_FALSE(allowed("telemetry/a.cc", "#include <boost/asio.hpp>"));
  EXPECT_FALSE(allowed("control/a.h", "#include <strainwave/state_v1.hpp>"));
  EXPECT_FALSE(allowed("client/a.h", "#include <nlohmann/json.hpp>"));
  EXPECT_TRUE(allowed("base/json_fields.h", "#include <nlohmann/json.hpp>"));
  EXPECT_FALSE(allowed("client/a.h", "#include <CLI/CLI.hpp>"));
  EXPECT_TRUE(allowed("client/a.cc", "#include <CLI/CLI.hpp>"));
}

TEST(Layering, KeepsControlFreeOfThreadsSocketsAndClocks) {
  for (const char* line : {"#include <thread>", "#include <mutex>", "#include <chrono>",
                           "#include <sys/socket.h>", "#include <spdlog/spdlog.h>", "#include <atomic>"}) {
    EXPECT_FALSE(allowed("control/a.cc", line)) << line;
  }
  for (const char* line : {"#include <Eigen/Core>", "#include <array>", "#include <cmath>"}) {
    EXPECT_TRUE(allowed("control/a.cc", line)) << line;
  }
  EXPECT_FALSE(allowed("control/friction/friction.cc", "#include <nlohmann/json.hpp>"));
}

/// A small temporary tree of sources.
class SourceTree : public ::testing::Test {
 protected:
  void write(const std::string& file, const std::string& text) const {
    std::filesystem::create_directories((root_ / file).parent_path());
    std::ofstream(root_ / file) << text;
  }

  TemporaryFolder temporary_;
  const std::filesystem::path& root_ = temporary_.path();
};

TEST_F(SourceTree, WithAWrongLineIsReportedWithFileAndLine) {
  write("daemon/realtime/loop.cc", "#include <array>\n#include \"design/gains/lmi.h\"\n");
  write("daemon/config/config.cc", "#include \"control/units.h\"\n");
  write("daemon/main.cc", "#include \"daemon/realtime/loop.h\"\n");
  const std::vector<std::string> defects = rules().find_defects(root_);
  ASSERT_EQ(defects.size(), 1U);
  EXPECT_EQ(defects[0], "daemon/realtime/loop.cc:2: daemon/realtime/ must not include design/gains/lmi.h");
}

TEST_F(SourceTree, WithAFolderThatTheTableDoesNotKnowIsReported) {
  write("helpers/util.h", "int helper();\n");
  write("stray.cc", "int main() {}\n");
  write("build/dev/generated.cc", "#include \"x.h\"\n");
  write(".git/x.cc", "#include \"x.h\"\n");
  write("docs/readme.md", "#include \"x.h\"\n");
  const std::vector<std::string> defects = rules().find_defects(root_);
  ASSERT_EQ(defects.size(), 2U);
  EXPECT_NE(defects[0].find("helpers"), std::string::npos) << defects[0];
  EXPECT_NE(defects[1].find("stray.cc"), std::string::npos) << defects[1];
}

TEST_F(SourceTree, WithALongFileIsReportedUnlessItSaysWhy) {
  const std::string lines(301, '\n');
  write("daemon/long.cc", lines);
  write("daemon/told.cc", "// Above 300 lines: a table.\n" + lines);
  write("daemon/short.cc", std::string(300, '\n'));
  EXPECT_EQ(find_long_files(root_), std::vector<std::string>{"daemon/long.cc has 301 lines"});
}

TEST_F(SourceTree, WithTwoTypesOfOneNameIsReportedWithBothFiles) {
  write("daemon/a.h", "namespace s {\nstruct Totals {};\n}\n");
  write("sim/studies/b.h", "namespace s {\nclass Totals {};\n}\n");
  write("sim/studies/c.cc", "namespace s {\nnamespace {\nstruct Totals {};\n}\n}\n");
  EXPECT_EQ(find_repeated_types(root_),
            std::vector<std::string>{"s::Totals is defined in daemon/a.h and in sim/studies/b.h"});
}

}  // namespace
}  // namespace strainwave::testing
