// SPDX-License-Identifier: BSD-3-Clause
#include "telemetry/exposition.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace strainwave {
namespace {

TEST(Exposition, HasTheSamplesOfAFamilyBelowItsHeading) {
  Exposition page;
  page.family("a_total", MetricType::kCounter, "Some a.");
  page.sample({{"prefix", "SW"}, {"joint", "elbow"}}, 1.5);
  page.sample({}, 1e-9);
  page.family("b", MetricType::kHistogram, "Some b.");
  page.sample("_bucket", {{"le", "+Inf"}}, 3.0);
  EXPECT_EQ(std::move(page).text(),
            "# HELP a_total Some a.\n# TYPE a_total counter\na_total{prefix=\"SW\",joint=\"elbow\"} "
            "1.5\na_total 1e-09\n"
            "# HELP b Some b.\n# TYPE b histogram\nb_bucket{le=\"+Inf\"} 3\n");
}

TEST(Exposition, LeavesNothingOfAFamilyWithoutSamples) {
  Exposition page;
  page.family("a", MetricType::kGauge, "Some a.");
  EXPECT_EQ(std::move(page).text(), "");
}

TEST(Exposition, WritesWhatIsNoNumberAsPrometheusReadsIt) {
  Exposition page;
  page.family("a", MetricType::kGauge, "Some a.");
  page.sample({}, std::nan(""));
  page.sample({}, std::numeric_limits<double>::infinity());
  page.sample({}, -std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::move(page).text().ends_with("a NaN\na +Inf\na -Inf\n"));
}

}  // namespace
}  // namespace strainwave
