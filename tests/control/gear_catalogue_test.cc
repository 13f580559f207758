// SPDX-License-Identifier: BSD-3-Clause
#include "control/joint/gear_catalogue.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <utility>

#include "base/csv.h"

namespace strainwave {
namespace {

/// Cells of data/gears.csv by size and ratio, then by column, without the empty ones.
using Cells = std::map<std::string, double>;
std::map<std::pair<double, double>, Cells> read_file() {
  const CsvText table = read_csv_text(STRAINWAVE_SOURCE_DIR "/data/gears.csv");
  std::map<std::pair<double, double>, Cells> file;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    Cells cells;
    for (std::size_t c = 1; c < table.columns.size(); ++c)
      if (!table.rows[i][c].empty())
        cells[table.columns[c]] = parse_number(table.rows[i][c], table.place(i), table.columns[c]);
    file[{find_gear(table.rows[i][0])->size, cells.at("ratio")}] = cells;
  }
  return file;
}

const std::vector<const char*> kTorques{"rated_torque_Nm", "average_torque_Nm", "repeated_peak_torque_Nm",
                                        "momentary_peak_torque_Nm", "ratcheting_torque_Nm"};

TEST(GearCatalogue, HasTheFiveSizesInBothRatiosByName) {
  ASSERT_EQ(gear_catalogue().size(), 10U);
  for (const int size : {14, 17, 20, 25, 32})
    for (const int ratio : {50, 100}) {
      const std::string name = "csf-" + std::to_string(size) + "-" + std::to_string(ratio);
      ASSERT_NE(find_gear(name), nullptr) << name;
      EXPECT_EQ(find_gear(name)->size, size);
      EXPECT_EQ(find_gear(name)->ratio, ratio) << name;
    }
  EXPECT_EQ(find_gear("csf-17-49"), nullptr);
}

TEST(GearCatalogue, OrdersTorquesAndStiffnessWithinAGear) {
  for (const auto& [key, cells] : read_file()) {
    SCOPED_TRACE("size " + std::to_string(key.first) + ", ratio " + std::to_string(key.second));
    for (std::size_t i = 1; i < kTorques.size(); ++i)
      EXPECT_LT(cells.at(kTorques[i - 1]), cells.at(kTorques[i])) << kTorques[i];
    EXPECT_LT(cells.at("stiffness_1_Nm_rad"), cells.at("stiffness_2_Nm_rad"));
    EXPECT_LT(cells.at("stiffness_2_Nm_rad"), cells.at("stiffness_3_Nm_rad"));
    EXPECT_LT(cells.at("torque_1_Nm"), cells.at("torque_2_Nm"));
    if (cells.contains("running_torque_Ncm")) {
      EXPECT_GT(cells.at("running_torque_Ncm"), cells.at("starting_torque_Ncm"))
          << "viscous friction is above 0";
    }
  }
}

// Geometry scales these values with a power of the size. A wrong unit or digit shows as a factor.
TEST(GearCatalogue, HasTheUnitsThatItsColumnsName) {
  for (const auto& [key, cells] : read_file()) {
    const auto [size, ratio] = key;
    SCOPED_TRACE("size " + std::to_string(size) + ", ratio " + std::to_string(ratio));
    const double volume = std::pow(size / 17.0, 3.0);
    const auto per_volume = [&](const char* column) { return cells.at(column) / volume; };
    EXPECT_NEAR(std::log(per_volume("stiffness_1_Nm_rad") / 9000.0), 0.0, std::log(1.5));
    EXPECT_NEAR(std::log(per_volume("rated_torque_Nm") / 16.0), 0.0, std::log(2.0));
    EXPECT_NEAR(std::log(cells.at("wave_generator_inertia_kgm2") / 7.9e-6 / std::pow(size / 17.0, 5.0)), 0.0,
                std::log(1.5));
    if (cells.contains("running_torque_Ncm")) {
      EXPECT_NEAR(std::log(per_volume("running_torque_Ncm") / 6.0), 0.0, std::log(1.2));
    }
    EXPECT_LT(cells.at("ratcheting_torque_Nm"), 0.03 * cells.at("stiffness_1_Nm_rad"));
  }
}

TEST(GearCatalogue, ReadsTheColumnsInTheUnitsOfItsMembers) {
  const Gear& gear = *find_gear("csf-25-100");
  const Cells cells = read_file().at({25.0, 100.0});
  EXPECT_EQ(gear.spring.stiffness_2_Nm_rad, cells.at("stiffness_2_Nm_rad"));
  EXPECT_EQ(gear.repeated_peak_torque_Nm, cells.at("repeated_peak_torque_Nm"));
  EXPECT_EQ(gear.wave_generator_inertia_kgm2, cells.at("wave_generator_inertia_kgm2"));
  EXPECT_DOUBLE_EQ(gear.motor_running_torque_Nm.value(), 0.01 * cells.at("running_torque_Ncm"));
  EXPECT_DOUBLE_EQ(gear.motor_starting_torque_Nm.value(), 0.01 * cells.at("starting_torque_Ncm"));
  EXPECT_FALSE(find_gear("csf-32-50")->motor_running_torque_Nm);
}

}  // namespace
}  // namespace strainwave
