// SPDX-License-Identifier: BSD-3-Clause
#include "design/friction/catalogue.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "base/csv.h"
#include "base/input_error.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

const std::filesystem::path kData = STRAINWAVE_SOURCE_DIR "/data";

// Half a unit of the last printed digit of the source: 5 significant digits for viscous friction, 4 decimals for the rest.
double printed_viscous_error(double value) {
  return 0.51 * std::pow(10.0, std::floor(std::log10(value)) - 4.0);
}

TEST(Catalogue, ReproducesTheSourcesParametersToThePrintedDigits) {
  const FrictionData data = read_catalogue(kData / "no_load_torque.csv");
  const CsvTable printed = read_csv(kData / "friction_parameters.csv");
  ASSERT_EQ(data.points.size(), printed.rows.size());
  for (std::size_t k = 0; k < data.points.size(); ++k) {
    const FrictionPoint& point = data.points[k];
    const auto& row = printed.rows[k];
    EXPECT_EQ(point.temperature_C, row[0]);
    EXPECT_NEAR(point.motor_viscous_Ncm_per_rpm, row[1], printed_viscous_error(row[1]))
        << point.temperature_C;
    EXPECT_NEAR(point.motor_coulomb_Ncm, row[2], 0.51e-4) << point.temperature_C;
    // The source uses 1.5 and 1.55 N.cm of starting torque at 15 and 17.5 degC, and 1.6 elsewhere. One value is printed with 3 decimals.
    const double starting = row[0] == 15.0 ? 1.5 : row[0] == 17.5 ? 1.55 : 1.6;
    EXPECT_NEAR(point.motor_static_Ncm, row[3] + 1.6 - starting, 4e-4) << point.temperature_C;
  }
}

TEST(Catalogue, ReadsParametersAsTheyAre) {
  const FrictionData data = read_catalogue(kData / "friction_parameters.csv");
  EXPECT_EQ(data.points.front().motor_static_Ncm, 8.7247);
  EXPECT_EQ(data.motor_speeds_rpm, (std::vector<double>{500.0, 1000.0, 2000.0, 3500.0}));
  EXPECT_EQ(data.sha256.size(), 64u);
}

class CatalogueFile : public ::testing::Test {
 protected:
  std::string message_of(const std::string& text) {
    const std::filesystem::path path = temporary_.path() / "catalogue.csv";
    std::ofstream(path) << text;
    return testing::refusal_of([&] { read_catalogue(path); });
  }

  TemporaryFolder temporary_;
};

TEST_F(CatalogueFile, RefusesWhatIsNotACatalogue) {
  const std::string header = "temperature_C,torque_500rpm_Ncm,torque_1000rpm_Ncm\n";
  EXPECT_EQ(message_of(header + "0,1,2\n5,1,2\n10,1,2\n"), "accepted");
  EXPECT_NE(message_of(header + "0,1,2\n5,1,2\n").find("at least three"), std::string::npos);
  EXPECT_NE(message_of(header + "0,1,2\n5,1,2\n5,1,2\n").find(".csv:4:"), std::string::npos);
  EXPECT_NE(message_of(header + "0,1,2\n5,-1,2\n10,1,2\n").find(".csv:3:"), std::string::npos);
  EXPECT_NE(message_of("temperature_C,torque_500rpm_Ncm,speed\n0,1,2\n").find("speed"), std::string::npos);
  EXPECT_NE(message_of("temperature_C,torque_500rpm_Ncm\n0,1\n5,1\n10,1\n").find("two or more speeds"),
            std::string::npos);
}

TEST_F(CatalogueFile, RefusesWhatIsNoFriction) {
  const std::string torque = "temperature_C,torque_500rpm_Ncm,torque_1000rpm_Ncm,starting_torque_Ncm\n";
  EXPECT_EQ(message_of(torque + "0,1,2,1\n5,1,2,1\n10,1,2,1\n"), "accepted");
  for (const char* const bad : {"5,1,2,1e308", "5,1,2,-0.5", "5,1,5,1", "5,1e300,2,1"})
    EXPECT_NE(message_of(torque + "0,1,2,1\n" + bad + "\n10,1,2,1\n").find(".csv:3:"), std::string::npos)
        << bad;
  EXPECT_NE(message_of(torque + "-300,1,2,1\n5,1,2,1\n10,1,2,1\n").find("-273.15"), std::string::npos);
  EXPECT_NE(message_of("temperature_C,torque_500rpm_Ncm,torque_500.0rpm_Ncm\n0,1,2\n5,1,2\n10,1,2\n")
                .find("torque_500.0rpm_Ncm"),
            std::string::npos);
  const std::string parameters = "temperature_C,viscous_Ncm_per_rpm,coulomb_Ncm,static_Ncm\n";
  EXPECT_EQ(message_of(parameters + "0,0.1,2,3\n5,0.1,2,3\n10,0.1,2,3\n"), "accepted");
  EXPECT_NE(message_of(parameters + "0,0.1,2,3\n5,0.1,2,1.9\n10,0.1,2,3\n").find("static friction"),
            std::string::npos);
}

TEST_F(CatalogueFile, AByteOrderMarkIsNoPartOfTheFirstColumn) {
  EXPECT_EQ(message_of("\xEF\xBB\xBFtemperature_C,torque_1rpm_Ncm,torque_2rpm_Ncm\n0,1,2\n5,1,2\n10,1,2\n"),
            "accepted");
}

TEST_F(CatalogueFile, AStartingTorqueIsWhatCataloguesPrintCoulombFrictionIncluded) {
  const std::filesystem::path path = temporary_.path() / "starting.csv";
  std::ofstream(path) << "temperature_C,torque_1rpm_Ncm,torque_2rpm_Ncm,starting_torque_Ncm\n0,1,1,1.5\n5,1,"
                         "1,1.25\n10,1,1,1\n";
  const FrictionData data = read_catalogue(path, 99.0);  // the column overrides the option
  EXPECT_EQ(data.points[0].motor_static_Ncm, 1.5);
  EXPECT_EQ(data.points[1].motor_static_Ncm, 1.25);
  EXPECT_TRUE(data.has_starting_torque);
}

TEST_F(CatalogueFile, OneStartingTorqueIsThatOfRoomTemperature) {
  const std::filesystem::path path = temporary_.path() / "one.csv";
  std::ofstream(path) << "temperature_C,torque_1rpm_Ncm,torque_2rpm_Ncm\n0,5,5\n20,3,3\n30,2,2\n";
  const FrictionData data = read_catalogue(path, 4.0);
  EXPECT_NEAR(data.motor_excess_Ncm, 1.5, 1e-12) << "Coulomb friction is 2.5 N.cm at 25 degC";
  for (const FrictionPoint& point : data.points)
    EXPECT_NEAR(point.motor_static_Ncm - point.motor_coulomb_Ncm, 1.5, 1e-12) << point.temperature_C;
  EXPECT_THROW(read_catalogue(path, 1.6), InputError) << "below Coulomb friction: no breakaway torque";
}

TEST_F(CatalogueFile, RefusesTorqueThatFallsWithSpeedAndNamesTheLikelyCause) {
  const std::string reversed =
      message_of("temperature_C,torque_500rpm_Ncm,torque_1000rpm_Ncm\n0,3,2\n5,2.5,2\n10,2,1.5\n");
  EXPECT_NE(reversed.find("at 3 of 3 temperatures"), std::string::npos) << reversed;
  EXPECT_NE(reversed.find("reverse order"), std::string::npos) << reversed;
  const std::string parameters = "temperature_C,viscous_Ncm_per_rpm,coulomb_Ncm,static_Ncm\n";
  EXPECT_NE(message_of(parameters + "0,-0.1,2,3\n5,-0.1,2,3\n10,0.1,2,3\n").find("at 2 of 3"),
            std::string::npos);
  EXPECT_EQ(message_of(parameters + "0,0.1,2,3\n5,-0.1,2,3\n10,0.1,2,3\n"), "accepted")
      << "one cell may be wrong";
}

TEST_F(CatalogueFile, SaysHowToConvertTorqueInKilogramForce) {
  const std::string message = message_of("temperature_C,torque_500rpm_kgcm,torque_1000rpm_kgcm\n25,2,3\n");
  EXPECT_NE(message.find("9.81 N cm"), std::string::npos) << message;
}

TEST_F(CatalogueFile, OfOneTemperatureIsAnsweredWithWhatToDo) {
  const std::string message = message_of("temperature_C,torque_500rpm_Ncm,torque_1000rpm_Ncm\n25,2,3\n");
  EXPECT_NE(message.find("holds 1 temperature:"), std::string::npos) << message;
  EXPECT_NE(message.find("no_load_torque.csv"), std::string::npos) << message;
}

}  // namespace
}  // namespace strainwave
