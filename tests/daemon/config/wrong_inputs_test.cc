// SPDX-License-Identifier: BSD-3-Clause
// Wrong inputs, as people type them, to every program: each is answered with the status for a wrong input, in one line that
// names the place, the key, the value and what is allowed. Above 300 lines: tables; a new way to go wrong is a new row.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

struct Ended {
  int status = -1;
  std::string said;
};

/// Whether this build has the program: an older build may have left one in the folder.
bool is_built(std::string_view command) {
  constexpr std::string_view kNotBuilt = STRAINWAVE_NOT_BUILT;
  return kNotBuilt.find(command.substr(0, command.find(' '))) == std::string_view::npos;
}

Ended run(const std::string& command) {
  Ended ended;
  std::FILE* pipe = ::popen((STRAINWAVE_BINARY_DIR "/bin/" + command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return ended;
  std::array<char, 4096> part{};
  for (std::size_t size = 0; (size = std::fread(part.data(), 1, part.size(), pipe)) > 0;)
    ended.said.append(part.data(), size);
  const int status = ::pclose(pipe);
  ended.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return ended;
}

/// The last line is the answer. Warnings may precede it.
std::string last_line(const std::string& text) {
  const std::string lines = text.substr(0, text.find_last_not_of('\n') + 1);
  return lines.substr(lines.rfind('\n') + 1);
}

void expect_refused(const Ended& ended, const std::vector<std::string>& mentions, const std::string& what) {
  EXPECT_EQ(ended.status, 2) << what << "\n" << ended.said;
  const std::string answer = last_line(ended.said);
  for (const std::string& part : mentions)
    EXPECT_NE(answer.find(part), std::string::npos) << what << "\nmust mention " << part << "\n"
                                                    << ended.said;
  EXPECT_TRUE(answer.starts_with("strainwave")) << "begins with the program's name\n" << ended.said;
  EXPECT_EQ(answer.find(":0:"), std::string::npos) << "no line 0\n" << ended.said;
}

TEST(WrongConfiguration, BeginsNoLineOfTheAnswer) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "forged.toml";
  std::ofstream(file) << "[daemon]\nlcm_url = \"udpm://239.255.76.67:7667?ttl=0\\nstrainwaved: all sound\"\n";
  const Ended ended = run("strainwaved --check --config " + file.string());
  EXPECT_EQ(ended.status, 2);
  EXPECT_EQ(ended.said.find("\nstrainwaved: all sound"), std::string::npos) << ended.said;
}

constexpr const char* kSound = R"([daemon]
period_s = 0.001
prefix = "LAB"

[security]
unsigned_orders = "allow"

[[joint]]
name = "elbow"
joint_model = "rhs17-6006"
inertia_kgm2 = 0.089
gear_ratio = 50
driver = "simulated"
model = "rigid"
[joint.limits]
position_min_rad = -3.2
position_max_rad = 3.2
speed_limit_rad_s = 6.0
acceleration_rad_s2 = 150
following_error_rad = 0.1
torque_limit_Nm = 34

[joint.simulated]
ambient_temperature_C = "sine:15,25,1"
)";

struct ConfigCase {
  const char* from;  ///< replaced in the sound file
  const char* to;
  std::vector<std::string> mentions;
};

const std::vector<ConfigCase> kConfigCases{
    // A mistyped key: the answer has its place and the nearest correct key.
    {"period_s = 0.001", "period = 0.001", {":2: daemon.period = 0.001", "did you mean period_s?"}},
    {"prefix", "prefx", {":3: daemon.prefx = \"LAB\"", "did you mean prefix?"}},
    {"speed_limit_rad_s = 6.0",
     "speed = 6.0",
     {"joint[0].limits.speed_limit_rad_s is missing", "line 18 has speed:"}},
    {"speed_limit_rad_s = 6.0",
     "speed_limit = 6.0",
     {"joint[0].limits.speed_limit_rad_s is missing", "line 18 has speed_limit:"}},
    {"position_min_rad", "positon_min_rad", {"position_min_rad is missing", "line 16 has positon_min_rad"}},
    {"[joint.limits]", "[joint.limit]", {"joint[0].limits is missing", "line 15 has limit"}},
    {"inertia_kgm2", "inertia", {"joint[0].inertia_kgm2 is missing", "line 11 has inertia"}},
    {"torque_limit_Nm",
     "torque_limit_nm",
     {"joint[0].limits.torque_limit_Nm is missing", "line 21 has torque_limit_nm"}},
    {"gear_ratio", "gearratio", {"joint[0].gear_ratio is missing", "line 12 has gearratio"}},
    {"following_error_rad",
     "folowing_error_rad",
     {"following_error_rad is missing", "line 20 has folowing_error_rad"}},
    {"driver =", "drivers =", {"joint[0].driver is missing", "line 13 has drivers"}},
    {"joint_model", "joint_modl", {"joint[0].joint_model is missing: the key is required"}},
    // The joint's model.
    {"model = \"rigid\"\n",
     "",
     {":8: joint[0].model is missing", "model = \"flexible\", gear = ", "mass times lever squared",
      "model = \"rigid\", inertia_kgm2 = "}},
    {"model = \"rigid\"",
     "model = \"stiff\"",
     {":14: joint[0].model = \"stiff\"", "\"flexible\", \"rigid\""}},
    {"inertia_kgm2 = 0.089\ngear_ratio = 50\ndriver = \"simulated\"\nmodel = \"rigid\"",
     "gear_ratio = 50\ndriver = \"simulated\"\nmodel = \"flexible\"",
     {":8: joint[0].gear is missing", "motor_inertia_kgm2 = ", "load_inertia_kgm2 = "}},
    {"model = \"rigid\"",
     "model = \"flexible\"",
     {":11: joint[0].inertia_kgm2 = 0.089", "model = \"rigid\""}},
    {"model = \"rigid\"",
     "model = \"rigid\"\ngear = \"csf-17-50\"",
     {":15: joint[0].gear = \"csf-17-50\"", "model = \"flexible\""}},
    {"name = \"elbow\"\n", "", {":8: joint[0].name is missing: the key is required"}},
    {"unsigned_orders",
     "unsigned_order",
     {":6: security.unsigned_order = \"allow\"", "did you mean unsigned_orders?"}},
    {"unsigned_orders = \"allow\"",
     "authorised_keys = \"keys\"",
     {":6: security.authorised_keys = \"keys\"", "did you mean authorized_keys?"}},
    {"unsigned_orders = \"allow\"\n",
     "",
     {":5: security.authorized_keys is missing", "unsigned_orders = \"allow\""}},
    {"[joint.simulated]", "[joint.simulatd]", {"joint[0].simulatd = (a table)", "did you mean simulated?"}},
    {"ambient_temperature_C",
     "ambient_C",
     {":24: joint[0].simulated.ambient_C = \"sine:15,25,1\"", "unknown key",
      "the keys here are ambient_temperature_C,", ". Physical"}},
    {"[[joint]]",
     "[[joints]]",
     {":15: joint = (a table)", "[[joint]] with two brackets", "line 8 has joints"}},
    {"name = \"elbow\"", "name = \"--all\"", {":9: joint[0].name = \"--all\"", "not - first"}},
    {"[daemon]", "[deamon]", {"deamon = (a table)", "did you mean daemon?"}},
    {"[[joint]]", "[[joints]]", {"joint", "[[joint]] with two brackets"}},
    {"[security]", "[secuirty]", {":5: secuirty = (a table)", "did you mean security?"}},
    // A value of the wrong type.
    {"torque_limit_Nm = 34",
     "torque_limit_Nm = \"34\"",
     {":21: joint[0].limits.torque_limit_Nm = \"34\"", "a number from", "without quotes"}},
    {"period_s = 0.001",
     "period_s = \"1 ms\"",
     {":2: daemon.period_s = \"1 ms\"", "a number from", "to 0.1"}},
    {"\"allow\"", "true", {":6: security.unsigned_orders = true", "one of \"refuse\", \"allow\" is allowed"}},
    {"\"allow\"",
     "false",
     {":6: security.unsigned_orders = false", "one of \"refuse\", \"allow\" is allowed"}},
    {"\"allow\"",
     "\"yes\"",
     {":6: security.unsigned_orders = \"yes\"", "one of \"refuse\", \"allow\" is allowed"}},
    {"\"allow\"", "\"alow\"", {"did you mean \"allow\"?"}},
    {"name = \"elbow\"", "name = 7", {":9: joint[0].name = 7", "a text in quotes is allowed"}},
    {"driver = \"simulated\"",
     "driver = \"simulate\"",
     {":13: joint[0].driver = \"simulate\"", "did you mean \"simulated\"?"}},
    {"driver = \"simulated\"",
     "driver = \"warp\"",
     {"joint[0].driver = \"warp\"", "\"simulated\", \"can\", \"gpio\""}},
    {"[[joint]]", "[joint]", {"joint = (a table)", "[[joint]] with two brackets"}},
    {"[joint.limits]", "[[joint.limits]]", {"joint[0].limits = (a list of 1)", "written [joint[0].limits]"}},
    {"[daemon]", "[[daemon]]", {"daemon = (a list of 1)", "a table, written [daemon]"}},
    {"torque_limit_Nm = 34", "torque_limit_Nm = true", {"torque_limit_Nm = true", "a number from"}},
    {"torque_limit_Nm = 34", "torque_limit_Nm = [34]", {"torque_limit_Nm = (a list of 1)", "a number from"}},
    {"\"elbow\"", "\"left elbow\"", {":9: joint[0].name = \"left elbow\"", "1 to 24 of the characters"}},
    {"\"LAB\"", "\"A.B\"", {":3: daemon.prefix = \"A.B\"", "1 to 24 of the characters"}},
    {"\"rhs17-6006\"",
     "\"a strain-wave gear with far too long a name\"",
     {":10: joint[0].joint_model = \"a strain-wave gear", "1 to 31 printable"}},
    {"\"rhs17-6006\"", "\"\"", {":10: joint[0].joint_model = \"\"", "1 to 31 printable"}},
    // A value out of range.
    {"inertia_kgm2 = 0.089",
     "inertia_kgm2 = -0.089",
     {":11: joint[0].inertia_kgm2 = -0.089:", "a number from 1e-09 to 1e+09"}},
    {"torque_limit_Nm = 34", "torque_limit_Nm = nan", {"torque_limit_Nm = nan", "a number from"}},
    {"torque_limit_Nm = 34", "torque_limit_Nm = inf", {"torque_limit_Nm = inf", "a number from"}},
    {"torque_limit_Nm = 34", "torque_limit_Nm = 0", {"torque_limit_Nm = 0:", "a number from 1e-09"}},
    {"gear_ratio = 50", "gear_ratio = 0", {":12: joint[0].gear_ratio = 0:", "a number from 0.001 to 1e+05"}},
    {"period_s = 0.001", "period_s = 1", {":2: daemon.period_s = 1:", "to 0.1 is allowed"}},
    {"period_s = 0.001", "period_s = -0.001", {"daemon.period_s = -0.001", "is allowed"}},
    {"period_s = 0.001",
     "period_s = 0.001\nstate_rate_Hz = 2000",
     {":3: daemon.state_rate_Hz = 2000", "to 1000 is allowed"}},
    {"period_s = 0.001",
     "period_s = 0.001\nmissed_share_limit = 0.5",
     {":3: daemon.missed_share_limit = 0.5", "below 0.5, or 1"}},
    {"period_s = 0.001",
     "period_s = 0.001\npriority = 99",
     {":3: daemon.priority = 99", "a whole number from 1 to 98"}},
    {"period_s = 0.001",
     "period_s = 0.001\npriority = 1.5",
     {":3: daemon.priority = 1.5", "a whole number from 1 to 98"}},
    {"period_s = 0.001",
     "period_s = 0.001\npriority = \"80\"",
     {"daemon.priority = \"80\"", "without quotes"}},
    {"period_s = 0.001", "period_s = 0.001\ncpu = 1000", {":3: daemon.cpu = 1000", "a whole number from -1"}},
    {"period_s = 0.001",
     "period_s = 0.001\nreal_time = \"on\"",
     {"real_time = \"on\"", "\"enforce\", \"ignore\""}},
    {"position_max_rad = 3.2",
     "position_max_rad = -4",
     {":17: joint[0].limits.position_max_rad = -4", "above position_min_rad"}},
    {"speed_limit_rad_s = 6.0", "speed_limit_rad_s = 0", {"speed_limit_rad_s = 0:", "a number from"}},
    {"speed_limit_rad_s = 6.0", "speed_limit_rad_s = -6", {"speed_limit_rad_s = -6", "a number from"}},
    {"acceleration_rad_s2 = 150",
     "acceleration_rad_s2 = 0",
     {":19: joint[0].limits.acceleration_rad_s2 = 0", "a number from 0.001"}},
    {"torque_limit_Nm = 34",
     "torque_limit_Nm = 34\ntemperature_limit_C = 500",
     {"temperature_limit_C = 500", "from -50 to 200"}},
    {"torque_limit_Nm = 34",
     "torque_limit_Nm = 34\n[joint.temperature]\nmax_C = 70",
     {":23: joint[0].temperature.max_C = 70", "above joint.limits.temperature_limit_C = 80 is"}},
    {"torque_limit_Nm = 34",
     "torque_limit_Nm = 34\noverspeed_rad_s = 1",
     {"overspeed_rad_s = 1:", "a number from 6 to 1000"}},
    {"torque_limit_Nm = 34",
     "torque_limit_Nm = 34\n[joint.control]\ninitial_load_Nm = 1e6",
     {":23: joint[0].control.initial_load_Nm = 1e+06", "a number from -34 to 34 is allowed"}},
    {"\"sine:15,25,1\"", "\"sine:15\"", {":24: joint[0].simulated.ambient_temperature_C = \"sine:15\""}},
    {"\"sine:15,25,1\"", "\"constant:-300\"", {"ambient_temperature_C = \"constant:-300\""}},
    // The network of LCM's messages.
    {"period_s = 0.001",
     "period_s = 0.001\nlcm_url = \"239.255.76.67:7667\"",
     {":3: daemon.lcm_url = \"239.255.76.67:7667\"", "udpm://GROUP:PORT?ttl=N"}},
    {"period_s = 0.001",
     "period_s = 0.001\nlcm_url = \"udpm://239.255.76.67:0\"",
     {":3: daemon.lcm_url =", "the port must be a number from 1 to 65535"}},
    {"period_s = 0.001",
     "period_s = 0.001\nlcm_url = \"udpm://239.255.76.67:99999?ttl=0\"",
     {":3: daemon.lcm_url =", "the port must be a number from 1 to 65535"}},
    {"period_s = 0.001",
     "period_s = 0.001\nlcm_url = \"udpm://239.255.76.67:7667x\"",
     {"the port must be a number from 1 to 65535"}},
    {"period_s = 0.001",
     "period_s = 0.001\nlcm_url = \"udpm://10.0.0.1:7667\"",
     {"'10.0.0.1' is not an IPv4 multicast group"}},
    {"period_s = 0.001",
     "period_s = 0.001\nlcm_url = \"udpm://239.255.76.67:7667?tll=1\"",
     {"'tll=1' is not a valid option of LCM", "ttl=N"}},
    {"period_s = 0.001",
     "period_s = 0.001\nlcm_url = \"udpm://239.255.76.67:7667?ttl=far\"",
     {"'ttl=far'", "from 0 (this machine alone) to 255"}},
    // Invalid TOML.
    {"prefix = \"LAB\"", "prefix = LAB", {":3: not valid TOML"}},
    {"[[joint]]", "[[joint", {":8: not valid TOML"}},
    {"gear_ratio = 50", "gear_ratio = 50\ngear_ratio = 51", {":13: not valid TOML", "gear_ratio"}},
    {"gear_ratio = 50", "gear_ratio 50", {":12: not valid TOML"}},
};

std::string text_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

class WrongInput : public ::testing::Test {
 protected:
  void write(const std::filesystem::path& path, std::string text, const std::string& from,
             const std::string& to) const {
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    std::ofstream(path) << text.replace(at, from.size(), to);
  }
  Ended check() const { return run("strainwaved --check --config " + file_.string()); }
  /// Writes the sound file with this line before the joint's limits.
  void write_joint_with(const std::string& line) const {
    write(file_, kSound, "driver = \"simulated\"\n", "driver = \"simulated\"\n" + line + "\n");
  }

  const TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_.path() / "c.toml";
  const std::filesystem::path table_ = folder_.path() / "t.json";
};

TEST_F(WrongInput, InAConfigurationIsNamedByPlaceKeyValueAndWhatIsAllowed) {
  for (const ConfigCase& wrong : kConfigCases) {
    write(file_, kSound, wrong.from, wrong.to);
    std::vector<std::string> mentions = wrong.mentions;
    mentions.push_back(file_);
    expect_refused(check(), mentions, wrong.to);
  }
}

TEST_F(WrongInput, IsNotFoundInASoundConfiguration) {
  std::ofstream(file_) << kSound;
  const Ended ended = check();
  EXPECT_EQ(ended.status, 0) << ended.said;
  EXPECT_EQ(ended.said.find("warning"), std::string::npos) << ended.said;
  EXPECT_NE(ended.said.find("elbow: no gain table"), std::string::npos) << ended.said;
  EXPECT_NE(ended.said.find("elbow: yields to a load above"), std::string::npos) << ended.said;
  EXPECT_NE(ended.said.find("not checked: real-time privileges"), std::string::npos) << ended.said;
}

/// Allowed, but rarely intended.
const std::vector<ConfigCase> kDoubtCases{
    {"position_max_rad = 3.2",
     "position_max_rad = 180",
     {":17: joint[0].limits.position_max_rad = 180", "turns", "if degrees are meant, write 3.1416"}},
    {"position_min_rad = -3.2",
     "position_min_rad = -90",
     {":16: joint[0].limits.position_min_rad = -90", "if degrees are meant, write -1.5708"}},
    {"following_error_rad = 0.1",
     "following_error_rad = 5",
     {":20: joint[0].limits.following_error_rad = 5", "if degrees are meant, write 0.087266"}},
    {"speed_limit_rad_s = 6.0",
     "speed_limit_rad_s = 360",
     {":18: joint[0].limits.speed_limit_rad_s = 360", "rpm", "if degrees are meant, write 6.2832"}},
    {"torque_limit_Nm = 34",
     "torque_limit_Nm = 34\noverspeed_rad_s = 30",
     {":22: joint[0].limits.overspeed_rad_s = 30", "5 times its speed limit"}},
    {"torque_limit_Nm = 34",
     "torque_limit_Nm = 34\njerk_limit_rad_s3 = 1",
     {":22: joint[0].limits.jerk_limit_rad_s3 = 1", "needs 4.899 s", "with 24 it needs one second"}},
    {"acceleration_rad_s2 = 150",
     "acceleration_rad_s2 = 0.01",
     {":19: joint[0].limits.acceleration_rad_s2 = 0.01", "needs 600 s", "with 6 it needs one second"}},
    {"speed_limit_rad_s = 6.0",
     "speed_limit_rad_s = 0.001",
     {":18: joint[0].limits.speed_limit_rad_s = 0.001", "takes 3142 s", "with 0.05236 it takes a minute"}},
    {"period_s = 0.001",
     "period_s = 0.001\nmissed_share_limit = 1.0",
     {":3: daemon.missed_share_limit = 1", "the supervision is off", "the default is 0.1"}},
    {"period_s = 0.001",
     "period_s = 0.001\nstall_limit_s = 2.0",
     {":3: daemon.stall_limit_s = 2", "without control", "the default is 0.02"}},
};

TEST_F(WrongInput, ThatIsAllowedIsDoubtedWithTheLikelyMeaning) {
  for (const ConfigCase& doubtful : kDoubtCases) {
    write(file_, kSound, doubtful.from, doubtful.to);
    const Ended ended = check();
    EXPECT_EQ(ended.status, 0) << ended.said;
    EXPECT_TRUE(ended.said.starts_with("warning: " + file_.string() + ":")) << ended.said;
    for (const std::string& part : doubtful.mentions)
      EXPECT_NE(ended.said.find(part), std::string::npos) << part << "\n" << ended.said;
  }
}

struct TableCase {
  const char* from;  ///< replaced in the shipped table
  const char* to;
  std::vector<std::string> mentions;
};

const std::vector<TableCase> kTableCases{
    {"\"inertia_kgm2\": 0.089", "\"inertia_kgm2\": 0.1", {"inertia_kgm2 = 0.1", "this joint has 0.089"}},
    {"\"gear_ratio\": 50.0", "\"gear_ratio\": 100.0", {"gear_ratio = 100", "this joint has 50"}},
    {"\"period_s\": 0.001", "\"period_s\": 0.002", {"period_s = 0.002 in the table, 0.001 in this daemon"}},
    {"\"joint_model\": \"rhs17-6006\"",
     "\"joint_model\": \"rhs20\"",
     {"rhs20", "this joint is a rhs17-6006"}},
    {"\"format\": ", "\"format\": 1", {"format = 1", "this program reads format"}},
    {"\"torque_limit_Nm\"", "\"torque_limit\"", {"torque_limit_Nm: is missing", "there is torque_limit:"}},
    {"\"torque_limit_Nm\": 34.0", "\"torque_limit_Nm\": \"34\"", {"torque_limit_Nm", "number"}},
    {"\"torque_limit_Nm\": 34.0", "\"torque_limit_Nm\": -34.0", {"torque_limit_Nm = -34", "from 1e-09"}},
    {"\"torque_limit_Nm\": 34.0", "\"torque_limit_Nm\": 3.0", {"static_Nm = 5.8", "half of torque_limit_Nm"}},
    {"\"static_Nm\": 5.", "\"static_Nm\": 5000.", {"friction.rules[0].static_Nm", "half of torque_limit_Nm"}},
    {"\"coulomb_Nm\": 5.", "\"coulomb_Nm\": 6.", {"friction.rules[0].coulomb_Nm", "must be from"}},
    {"\"zero_width_rad_s\": 0.", "\"zero_width_rad_s\": 0.1, \"x\": 0.", {"x"}},
    {"{", "", {"JSON"}},
};

TEST_F(WrongInput, InATableIsNamedByItsFileAndTheKeyOfTheConfigurationThatNamesIt) {
  const std::string shipped = text_of(STRAINWAVE_SOURCE_DIR "/data/tables/rhs17-6006.json");
  for (const TableCase& wrong : kTableCases) {
    write(table_, shipped, wrong.from, wrong.to);
    write_joint_with("table = \"t.json\"");
    std::vector<std::string> mentions = wrong.mentions;
    mentions.push_back(file_.string() + ":14: joint[0].table = \"t.json\"");
    mentions.push_back(table_);
    expect_refused(check(), mentions, wrong.to);
  }
}

TEST_F(WrongInput, ATableThatIsNotThereOrEverybodysIsFoundBeforeTheStart) {
  write_joint_with("table = \"t.json\"");
  expect_refused(check(), {":14: joint[0].table = \"t.json\"", table_, "No such file"}, "no file");
  std::filesystem::create_directory(table_);
  expect_refused(check(), {":14: joint[0].table", "is a folder, not a file"}, "a folder");
  std::filesystem::remove(table_);
  std::filesystem::copy(STRAINWAVE_SOURCE_DIR "/data/tables/rhs17-6006-friction.json", table_);
  expect_refused(check(), {":14: joint[0].table", table_, "holds fitted friction, not gains"}, "friction");
  std::filesystem::remove(table_);
  std::filesystem::copy(STRAINWAVE_SOURCE_DIR "/data/tables/c4.json", table_);
  expect_refused(check(), {"stability is not proved"}, "the source's table");
  std::filesystem::remove(table_);
  std::filesystem::copy(STRAINWAVE_SOURCE_DIR "/data/tables/rhs17-6006.json", table_);
  EXPECT_EQ(check().status, 0) << check().said;
  EXPECT_NE(check().said.find("elbow: table 'rhs17-6006 C4'"), std::string::npos) << check().said;
  std::filesystem::permissions(table_, std::filesystem::perms::others_write,
                               std::filesystem::perm_options::add);
  expect_refused(check(), {":14: joint[0].table", "everyone may write it", "chmod o-w"}, "writable");
}

TEST_F(WrongInput, ATorqueLimitThatFrictionTakesIsDoubtedWithWhatWouldDo) {
  std::filesystem::copy(STRAINWAVE_SOURCE_DIR "/data/tables/rhs17-6006.json", table_);
  const auto limited = [&](const std::string& torque_Nm) {
    std::string text = kSound;
    text.replace(text.find("torque_limit_Nm = 34"), 20, "torque_limit_Nm = " + torque_Nm);
    text.replace(text.find("acceleration_rad_s2 = "), 22, "acceleration_rad_s2 = 20 # ");
    write(file_, text, "driver = \"simulated\"\n", "driver = \"simulated\"\ntable = \"t.json\"\n");
    const Ended ended = check();
    EXPECT_EQ(ended.status, 0) << ended.said;
    return ended.said;
  };
  const std::string stuck = limited("2");
  EXPECT_NE(stuck.find("warning: elbow: torque limit 2 N.m"), std::string::npos) << stuck;
  EXPECT_NE(stuck.find("the joint does not move; "), std::string::npos) << stuck;
  // The suggested value works, and a slightly smaller one does not.
  const double enough_Nm = std::stod(stuck.substr(stuck.find("not move; ") + 10));
  EXPECT_EQ(limited(std::to_string(enough_Nm * 1.001)).find("warning"), std::string::npos);
  EXPECT_NE(limited(std::to_string(enough_Nm * 0.97)).find("hardly any torque is left for motion"),
            std::string::npos);
}

TEST_F(WrongInput, AnAccelerationThatNoTorqueAffordsIsDoubtedWithWhatIsAfforded) {
  std::filesystem::copy(STRAINWAVE_SOURCE_DIR "/data/tables/rhs17-6006.json", table_);
  const auto with = [&](const std::string& acceleration_rad_s2) {
    std::string text = kSound;
    text.replace(text.find("acceleration_rad_s2 = "), 22,
                 "acceleration_rad_s2 = " + acceleration_rad_s2 + " # ");
    write(file_, text, "driver = \"simulated\"\n", "driver = \"simulated\"\ntable = \"t.json\"\n");
    return check().said;
  };
  EXPECT_NE(
      with("1000").find("inertia_kgm2 = 0.089: torque_limit_Nm = 34 gives this inertia at most 382 rad/s2, "
                        "less than acceleration_rad_s2 = 1000"),
      std::string::npos)
      << with("1000");
  EXPECT_EQ(with("381").find("warning"), std::string::npos) << with("381");
}

// The table is for links of up to 0.3 kg m2, the joint's link has 0.1: 34 N.m are 179.9 rad/s2.
TEST_F(WrongInput, AnAccelerationOfAFlexibleJointIsDoubtedByItsOwnInertias) {
  std::filesystem::copy(STRAINWAVE_SOURCE_DIR "/data/tables/csf-17-50.json", table_);
  const auto with = [&](const std::string& acceleration_rad_s2) {
    std::string text = kSound;
    text.replace(text.find("acceleration_rad_s2 = "), 22,
                 "acceleration_rad_s2 = " + acceleration_rad_s2 + " # ");
    text.replace(text.find("inertia_kgm2 = 0.089"), 20, "motor_inertia_kgm2 = 0.089");
    write(file_, text, "model = \"rigid\"\n",
          "model = \"flexible\"\ngear = \"csf-17-50\"\nload_inertia_kgm2 = 0.1\ntable = \"t.json\"\n");
    return check().said;
  };
  EXPECT_NE(with("181").find("at most 179.9 rad/s2"), std::string::npos) << with("181");
  EXPECT_EQ(with("179").find("warning"), std::string::npos) << with("179");
}

TEST_F(WrongInput, AConfigurationThatOthersMayWriteIsRefusedOrOfASimulatedJointDoubted) {
  std::ofstream(file_) << kSound;
  const auto add = std::filesystem::perm_options::add;
  std::filesystem::permissions(file_, std::filesystem::perms::group_write, add);
  const Ended doubted = check();
  EXPECT_EQ(doubted.status, 0) << doubted.said;
  EXPECT_NE(doubted.said.find("warning: " + file_.string() + ": its group may write it: chmod g-w"),
            std::string::npos)
      << doubted.said;
  std::filesystem::permissions(file_, std::filesystem::perms::others_write, add);
  expect_refused(check(), {"everyone may write it: chmod o-w " + file_.string()}, "world-writable");
}

TEST_F(WrongInput, ATorqueLimitBelowTheTablesIsToldWithWhatThenHolds) {
  std::filesystem::copy(STRAINWAVE_SOURCE_DIR "/data/tables/rhs17-6006.json", table_);
  std::string text(kSound);
  text.replace(text.find("torque_limit_Nm = 34"), 20, "torque_limit_Nm = 3.4");
  write(file_, text, "gear_ratio = 50\n", "gear_ratio = 50\ntable = \"t.json\"\n");
  const Ended ended = check();
  EXPECT_EQ(ended.status, 0) << ended.said;
  for (const char* part : {"torque limit 3.4 N.m, from joint.limits.torque_limit_Nm, below the table's 34",
                           "the joint will not move", "yields to a load above 1.7 N.m"})
    EXPECT_NE(ended.said.find(part), std::string::npos) << part << "\n" << ended.said;
}

TEST_F(WrongInput, ATableWithLessTorqueThanTheJointIsToldWithTheLoadThatThenHolds) {
  const std::string shipped = text_of(STRAINWAVE_SOURCE_DIR "/data/tables/rhs17-6006.json");
  write(table_, shipped, "\"torque_limit_Nm\": 34.0", "\"torque_limit_Nm\": 20.0");
  write_joint_with("table = \"t.json\"");
  const Ended ended = check();
  EXPECT_EQ(ended.status, 0) << ended.said;
  for (const char* part : {"torque limit 20 N.m, from the table, below joint.limits.torque_limit_Nm = 34",
                           "yields to a load above 10 N.m, notice above 8, torque limit 20"})
    EXPECT_NE(ended.said.find(part), std::string::npos) << part << "\n" << ended.said;
}

struct CommandCase {
  const char* command;
  std::vector<std::string> mentions;
};

const std::vector<CommandCase> kCommandCases{
    {"strainwaved", {"--config", "--help"}},
    {"strainwaved --confg x.toml", {"--confg is not an option", "did you mean --config?"}},
    {"strainwaved --config /nonexistent.toml --check", {"/nonexistent.toml: cannot be read", "No such file"}},
    {"strainwaved --config / --check", {"/: is a folder, not a file"}},
    {"strainwaved --config x.toml spare words", {"unexpected: 'spare' 'words'"}},
    {"strainwavectl", {"a command is required", "status", "move"}},
    {"strainwavectl --timeout_s 0.01 status", {"--timeout_s", "'0.01'", "0.1 to 3600 seconds"}},
    {"strainwavectl --timeout_s soon status", {"--timeout_s", "'soon'", "0.1 to 3600 seconds"}},
    {"strainwavectl --prefix a.b status", {"--prefix", "'a.b' is not a name", "1 to 24"}},
    {"strainwavectl move elbow 90deg", {"90deg", "in rad", "1.5708"}},
    {"strainwavectl move elbow fast", {"'fast' is not a position", "a finite number in rad"}},
    {"strainwavectl move el.bow 1", {"JOINT", "'el.bow' is not a name", "1 to 24"}},
    {"strainwavectl move elbow 1 --speed-limit_rad_s -2",
     {"--speed-limit_rad_s", "'-2' is not a number above 0"}},
    {"strainwavectl move elbow 1 --tolerance_rad 0", {"--tolerance_rad", "'0' is not a number above 0"}},
    {"strainwavectl enable", {"JOINT is required"}},
    {"strainwavectl disable", {"JOINT is required", "--all"}},
    {"strainwavectl watch --interval_s -1", {"--interval_s", "'-1'", "seconds above 0"}},
    {"strainwavectl export /nonexistent.log --out /tmp/x", {"/nonexistent.log: cannot be read"}},
    {"strainwavectl plot-record /", {"/ cannot be read"}},
    {"strainwavectl load-table elbow /nonexistent", {"/nonexistent: cannot be read", "No such file"}},
    {"strainwavectl load-table elbow " STRAINWAVE_SOURCE_DIR "/data/tables/rhs17-6006-friction.json",
     {"rhs17-6006-friction.json: holds fitted friction, not gains"}},
    {"strainwavectl load-table elbow " STRAINWAVE_SOURCE_DIR "/data/no_load_torque.csv",
     {"no_load_torque.csv: not valid JSON: the file begins with '#", "must begin with {"}},
    {"strainwavectl load-table elbow " STRAINWAVE_SOURCE_DIR "/config/demo.toml",
     {"demo.toml: not valid JSON: the file begins with '# The demonstration"}},
    {"strainwave-sim run --controller pid --plant perfect",
     {"--plant", "perfect", "ideal, limited, realistic"}},
    {"strainwave-design verify /nonexistent", {"/nonexistent: cannot be read", "No such file"}},
    {"strainwave-design fit " STRAINWAVE_SOURCE_DIR "/data/no_load_torque.csv --out /tmp/x --gear-ratio inf",
     {"gear-ratio = inf", "at most 100000"}},
    {"strainwave-design fit " STRAINWAVE_SOURCE_DIR
     "/data/no_load_torque.csv --out /tmp/x --starting-torque_Ncm 1e308",
     {"no_load_torque.csv:4: static friction", "1e+308", "at most 1e7"}},
    {"strainwave-design fit " STRAINWAVE_SOURCE_DIR
     "/data/no_load_torque.csv --out /tmp/x --starting-torque_Ncm -1",
     {"starting-torque_Ncm = -1", "must not be negative"}},
    {"strainwave-design fit " STRAINWAVE_SOURCE_DIR "/data/no_load_torque.csv --out /tmp/x --outliers drop",
     {"--outliers", "drop", "keep", "leave-out"}},
    {"strainwave-design gains --out /tmp/x --friction " STRAINWAVE_SOURCE_DIR "/data/tables/rhs17-6006.json",
     {"rhs17-6006.json: holds gains, not fitted friction"}},
    {"strainwave-design gains --out /tmp/x --friction " STRAINWAVE_SOURCE_DIR "/data/no_load_torque.csv",
     {"no_load_torque.csv: is a catalogue over temperature", "strainwave-design fit"}},
    {"strainwave-design gains --out /tmp/x --weights 1,1,1,nane-6 --friction " STRAINWAVE_SOURCE_DIR
     "/data/tables/rhs17-6006-friction.json",
     {"--weights", "nane-6", "a number"}},
    {"strainwave-design gains --weights 1,1,1 --friction x --out y",
     {"--weights takes 4 values (cost: integral,position,velocity,torque): 3 were given"}},
    {"strainwave-design gains --weights 1,1,1,1,1 --friction x --out y",
     {"--weights takes 4 values", "5 were given"}},
    {"strainwave-design fit x --out y --model fuzy",
     {"--model: 'fuzy' is none of", "exponential", "did you mean fuzzy?"}},
    {"strainwave-design gains --friction x --out y --sampling zho", {"--sampling", "did you mean zoh?"}},
    {"strainwave-design gains --friction x --out y --gear csf-17-5O", {"--gear", "did you mean csf-17-50?"}},
    {"strainwave-design fit " STRAINWAVE_SOURCE_DIR
     "/data/no_load_torque.csv --out /tmp/x --gear-ratio 1e300",
     {"gear-ratio = 1e+300: must be above 0"}},
    {"strainwave-design verify " STRAINWAVE_SOURCE_DIR "/data/tables/rhs17-6006.json --gear csf-17-50",
     {"verify: --gear = csf-17-50", "give --load-inertia_kgm2"}},
    {"strainwave-sim robustness --table x --draws 1000000000000",
     {"--draws", "1000000000000", "a smaller number is allowed"}},
    {"strainwave-sim robustness --table x --draws 1.5", {"--draws", "1.5", "a whole number is allowed"}},
    {"strainwavectl statsu", {"'statsu' is not a command", "did you mean status?"}},
    {"strainwavectl banana", {"'banana' is not a command", "the commands are status"}},
    {"strainwavectl stop --all", {"'stop' is not a command", "hold"}},
    {"strainwavectl mvoe elbow 1 --wait", {"'mvoe' is not a command", "did you mean move?"}},
    {"strainwavectl --tiemout_s 1 status", {"--tiemout_s is not an option", "did you mean --timeout_s?"}},
    {"strainwavectl move elbow", {"POSITION_rad is required"}},
    {"strainwavectl move elbow 1 --speed 2",
     {"--speed is not an option", "did you mean --speed-limit_rad_s?"}},
    {"strainwavectl pause elbow wrist hip", {"unexpected: 'wrist' 'hip'"}},
    {"strainwavectl record elbow", {"--out is required"}},
    {"strainwavectl inject elbow gremlins", {"gremlins", "sensor_nan"}},
    {"strainwavectl keygen --out /tmp/x --role king", {"--role", "king", "operator", "engineer"}},
    {"strainwavectl keygen --out /tmp/x --role enginer", {"--role", "did you mean engineer?"}},
    {"strainwave-sim", {"a command is required", "run"}},
    {"strainwave-can-sim none0", {"ip link add dev none0 type vcan"}},
    {"strainwave-can-sim none0 --node-id 128", {"--node-id", "128"}},
    {"strainwavectl inject elbow sensor_stcuk",
     {"'sensor_stcuk' is not a fault", "did you mean sensor_stuck?", "allowed are: none"}},
    {"strainwave-sim rnu", {"'rnu' is not a command", "did you mean run?"}},
    {"strainwave-sim chapter6 --out /proc/nowhere",
     {"/proc/nowhere", "cannot be made", "name another folder"}},
    {"strainwave-sim temperature --out /dev/null", {"/dev/null", "is a file", "name a folder"}},
    {"strainwave-sim flexible --peers --out /dev/null", {"/dev/null", "is a file", "name a folder"}},
    {"strainwave-sim heat --table " STRAINWAVE_SOURCE_DIR "/data/tables/rhs17-6006.json --out /proc/nowhere",
     {"/proc/nowhere", "cannot be made", "name another folder"}},
    {"strainwave-design shwo", {"'shwo' is not a command", "did you mean show?"}},
};

TEST(WrongCommandLine, IsNamedByWhatWasGivenAndWhatIsAllowed) {
  for (const CommandCase& wrong : kCommandCases)
    if (is_built(wrong.command)) expect_refused(run(wrong.command), wrong.mentions, wrong.command);
}

TEST(WrongCommandLine, OfVerifyIsToldBeforeAnythingIsCertified) {
  if (!is_built("strainwave-design")) GTEST_SKIP() << "not built, as under a sanitizer";
  for (const char* wrong :
       {"--load-inertia_kgm2 xx --motor-inertia_kgm2 0.1",
        "--load-inertia_kgm2 0.1 --motor-inertia_kgm2 0.1 --gear x",
        "--load-inertia_kgm2 0.1 --motor-inertia_kgm2 0.1 --delay 1.5", "--gear csf-17-50"}) {
    const Ended ended =
        run("strainwave-design verify " STRAINWAVE_SOURCE_DIR "/data/tables/rhs17-6006.json " +
            std::string(wrong));
    EXPECT_EQ(ended.status, 2) << wrong << "\n" << ended.said;
    EXPECT_EQ(ended.said.find("certified"), std::string::npos) << wrong << "\n" << ended.said;
  }
}

TEST(WrongCommandLine, OfTheViewerIsNamedBeforeJavaIsAskedFor) {
  if (!std::filesystem::exists(STRAINWAVE_BINARY_DIR "/bin/strainwave-spy"))
    GTEST_SKIP() << "not built, as under a sanitizer";
  expect_refused(run("strainwave-spy --nope"), {"'--nope' is not an option", "--lcm-url=URL"}, "--nope");
  expect_refused(run("strainwave-spy --lcm-url"), {"--lcm-url: which one?", "udpm://"}, "--lcm-url");
  expect_refused(run("strainwave-spy --lcm-url=nonsense://"), {"'nonsense://'", "udpm://GROUP:PORT"}, "url");
}

TEST(WrongCommandLine, OfTheGatewayIsToldThatNobodyStartsItByHand) {
  for (const char* option : {"--help", "--nope"})
    expect_refused(run(std::string("strainwave-gateway ") + option), {"strainwaved", "never a user"}, option);
}

TEST(WrongInputs, AreMany) {
  EXPECT_GE(kConfigCases.size() + kTableCases.size() + kCommandCases.size(), 110U);
}

}  // namespace
}  // namespace strainwave
