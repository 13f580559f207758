// SPDX-License-Identifier: BSD-3-Clause
// The studies of chapter 6, robustness and heat with the project's own tables: properties that hold for all gains.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "base/input_error.h"
#include "base/text_file.h"
#include "control/table/gain_table_json.h"
#include "sim/joint/reference_plant.h"
#include "sim/studies/chapter6.h"
#include "sim/studies/chapter6_figures.h"
#include "sim/studies/figure.h"
#include "sim/studies/heat.h"
#include "sim/studies/performance_tables.h"
#include "sim/studies/robustness.h"
#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

const std::filesystem::path kData = std::filesystem::path(STRAINWAVE_SOURCE_DIR) / "data";

const Chapter6& chapter6() {
  static const Chapter6 chapter = run_chapter6(chapter6_contenders(read_chapter6_tables(kData / "tables")));
  return chapter;
}

double pi2(Setting setting, Scenario scenario, int range, const std::string& contender) {
  return chapter6().at({setting, scenario, range}, contender).statistics.pi2;
}

TEST(Chapter6, IsNowhereFasterThanPhysicsAllow) {
  for (const Chapter6Run& run : chapter6().runs) {
    const TimeOptimalResult* limit = chapter6().limit(run.key);
    ASSERT_EQ(limit == nullptr, run.key.setting == Setting::kIdeal);
    if (limit != nullptr) {
      EXPECT_GT(run.result.statistics.pi2, limit->statistics.pi2) << run.contender;
    }
  }
}

TEST(Chapter6, HasTheSourcesOrderAtSmallSignals) {
  for (const Scenario scenario : kScenarios) {
    for (int range = 0; range < 2; ++range) {
      const double c4 = pi2(Setting::kIdeal, scenario, range, "C4");
      EXPECT_LT(c4, 0.5 * pi2(Setting::kIdeal, scenario, range, "C3"));
      EXPECT_LT(c4, 0.5 * pi2(Setting::kIdeal, scenario, range, "PID"));
      EXPECT_LT(pi2(Setting::kIdeal, scenario, range, "C2"), pi2(Setting::kIdeal, scenario, range, "C1"));
    }
  }
}

TEST(Chapter6, HasAScheduledControllerBetterThanThePrototypeOnTheRamp) {
  const double at_most[] = {36.0, 37.0, 47.0, 140.0};
  for (int range = 0; range < kRangeCount; ++range) {
    const LoopStatistics& c4 = chapter6().at({Setting::kLimited, Scenario::kRamp, range}, "C4").statistics;
    EXPECT_LE(c4.pi2, at_most[range]);
    EXPECT_LT(c4.steady_error_rad, 1e-5) << "at every temperature";
  }
}

TEST(Chapter6, HasAnExtendedControllerThatIsQuietExactAndBetterThanThePidOnTheRealisticPlant) {
  const double one_count_rad = realistic_plant().encoder.resolution_rad();
  for (const Scenario scenario : kScenarios) {
    for (int range = 0; range < kRangeCount; ++range) {
      const LoopStatistics& extended =
          chapter6().at({Setting::kRealistic, scenario, range}, "C4+").statistics;
      EXPECT_LT(extended.pi2, pi2(Setting::kRealistic, scenario, range, "PID"));
      EXPECT_LE(std::abs(extended.final_error_rad), one_count_rad);
      EXPECT_EQ(extended.steady_sign_changes_per_s, 0.0);
    }
  }
}

TEST(Chapter6, StaysWithinTheMotorsLimits) {
  for (const Chapter6Run& run : chapter6().runs)
    if (run.key.setting != Setting::kIdeal) {
      EXPECT_LE(run.result.statistics.peak_torque_Nm, kReferencePeakTorque_Nm) << run.contender;
    }
}

TEST(Chapter6, SimulatesEveryPeriodOfEveryScenario) {
  EXPECT_EQ(chapter6().periods, static_cast<long>(chapter6().contenders.size()) * 3 * 4 * (5000 + 12000));
}

TEST(PerformanceTables, StandBesideTheSourcesNumbers) {
  const auto tables = performance_tables(chapter6(), read_source_indices(kData / "performance_index.csv"));
  ASSERT_EQ(tables.size(), 12U);
  const TextTable& table9 = tables[1];
  EXPECT_EQ(table9.title.substr(0, 7), "Table 9");
  for (const auto& row : table9.rows) {
    ASSERT_EQ(row.size(), table9.header.size());
    if (row[0] == "C4") {
      EXPECT_EQ(row[2], "109.8");
    }
  }
  for (const auto& row : run_table(chapter6()).rows)
    EXPECT_EQ(row.size(), run_table(chapter6()).header.size());
}

RobustnessConfig small_study() {
  RobustnessConfig config;
  config.plant = realistic_plant();
  config.draws = 6;
  config.duration_s = 0.5;
  config.payload_torque_Nm = 2.0;
  return config;
}

TEST(Robustness, DrawsTheSameJointsFromTheSameSeed) {
  RobustnessConfig config = small_study();
  const auto first = run_robustness(config, {pid_contender()});
  config.draws = 3;
  const auto fewer = run_robustness(config, {pid_contender()});
  for (std::size_t i = 0; i < fewer.size(); ++i) {
    EXPECT_EQ(first[i].inertia_kgm2, fewer[i].inertia_kgm2);
    EXPECT_EQ(first[i].statistics[0].pi2, fewer[i].statistics[0].pi2);
  }
  config.seed = 2;
  EXPECT_NE(run_robustness(config, {pid_contender()})[0].inertia_kgm2, first[0].inertia_kgm2);
}

TEST(Robustness, DrawsWithinItsRanges) {
  RobustnessConfig config = small_study();
  config.draws = 100;
  config.duration_s = 0.1;
  double least = 2.0;
  double most = 0.0;
  for (const RobustnessDraw& draw : run_robustness(config, {})) {
    EXPECT_GE(draw.inertia_kgm2, 0.7 * kReferenceInertia_kgm2);
    EXPECT_LE(draw.inertia_kgm2, 1.3 * kReferenceInertia_kgm2);
    EXPECT_LE(std::abs(draw.load_torque_Nm), 2.0);
    EXPECT_GE(draw.temperature_C, -10.0);
    EXPECT_LE(draw.temperature_C, 45.0);
    least = std::min(least, draw.friction_factor);
    most = std::max(most, draw.friction_factor);
  }
  EXPECT_LT(least, 0.75);
  EXPECT_GT(most, 1.25);
}

TEST(Robustness, RefusesAnImpossibleSpread) {
  RobustnessConfig config = small_study();
  config.inertia_spread = 1.0;
  EXPECT_THROW(run_robustness(config, {pid_contender()}), InputError);
}

TEST(Heat, WarmsTheJointAndCostsMostWhenToldTooCold) {
  HeatConfig config;
  config.plant = realistic_plant();
  config.plant.thermal = {1.2, 20.0, 0.0};  // small, so that it warms within the test
  config.duration_s = 100.0;
  config.sensor_lag_s = 10.0;
  const auto runs = run_heat(config, read_gain_table(kData / "tables" / "c4.json"));
  ASSERT_EQ(runs.size(), 6U);
  for (const HeatRun& run : runs) {
    EXPECT_EQ(run.pi2_over_time.size(), 100U) << run.name;
    EXPECT_GT(run.joint_temperature_C.back().second, config.ambient_temperature_C + 3.0) << run.name;
  }
  EXPECT_LT(runs[1].told_temperature_C[10].second, runs[1].joint_temperature_C[10].second)
      << "the sensor lags";
  EXPECT_GT(runs[3].mean_pi2, runs[0].mean_pi2) << "told 10 degC too cold, friction is overcompensated";
  EXPECT_TRUE(std::isnan(runs[5].told_temperature_C[10].second)) << "without a sensor nothing is told";
}

TEST(Figure, KeepsEveryExtremeWhenItThins) {
  Points points;
  for (int i = 0; i < 10000; ++i) points.emplace_back(i, i == 5003 ? 7.0 : (i == 7007 ? -7.0 : 0.0));
  const Points kept = thinned(points, 400);
  EXPECT_LE(kept.size(), 402U);
  EXPECT_EQ(kept.front(), points.front());
  EXPECT_EQ(kept.back(), points.back());
  EXPECT_NE(std::find(kept.begin(), kept.end(), points[5003]), kept.end());
  EXPECT_NE(std::find(kept.begin(), kept.end(), points[7007]), kept.end());
  EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
}

TEST(Chapter6Figures, ShowEveryErrorAboveTheAxis) {
  int panels = 0;
  for (const Figure& figure : response_figures(chapter6())) {
    if (!figure.id.starts_with("errors_")) continue;
    for (const Panel& panel : figure.panels) {
      ++panels;
      ASSERT_EQ(panel.y_range.size(), 2U) << figure.id;
      for (const Series& series : panel.series) {
        for (const auto& [time_s, value] : series.points) {
          ASSERT_GT(value, 1.5 * panel.y_range[0]) << figure.id << " " << series.name << " at " << time_s;
          ASSERT_LE(value, panel.y_range[1]) << figure.id << " " << series.name << " at " << time_s;
        }
      }
    }
  }
  EXPECT_EQ(panels, 16);
}

TEST(Chapter6Figures, DrawTheTwoControllersOfNearlyEqualGainsSoThatBothAreSeen) {
  for (const Figure& figure : response_figures(chapter6())) {
    for (const Panel& panel : figure.panels) {
      for (const Series& series : panel.series)
        EXPECT_EQ(series.mark == Mark::kDashed, series.name == "C3" || series.name == "time-optimal")
            << figure.id << " " << series.name;
    }
  }
}

TEST(Figure, IsAsLargeAsItsPanelsAndKeepsTinyRanges) {
  const TemporaryFolder folder;
  Panel panel{"title", "time (s)", "error (rad)", "", {{"a", {{0, 1e-9}, {1, 1e-3}}}}, true, {}, {1e-10, 1}};
  const auto drawn = [&](int columns, const std::string& id) {
    draw_figures({{id, "", columns, std::vector<Panel>(static_cast<std::size_t>(columns), panel)}},
                 folder.path());
    return read_text_file(folder.path() / (id + ".svg"));
  };
  // Each figure has its own width, so that one panel is not stretched to the width of three.
  EXPECT_NE(drawn(1, "one").find("width=\"460\""), std::string::npos);
  const std::string three = drawn(3, "three");
  EXPECT_NE(three.find("width=\"1380\""), std::string::npos);
  EXPECT_NE(three.find("1e-10"), std::string::npos);
}

TEST(TextTable, WritesMarkdownCsvAndHtml) {
  const TextTable table{"A < B", {"|x|", "y"}, {{"1", "2"}}};
  EXPECT_EQ(table.markdown(), "### A < B\n\n| \\|x\\| | y |\n|---|---|\n| 1 | 2 |\n\n");
  EXPECT_EQ(table.csv(), "|x|,y\n1,2\n");
  EXPECT_NE(table.html().find("A &lt; B"), std::string::npos);
}

}  // namespace
}  // namespace strainwave
