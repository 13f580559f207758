// SPDX-License-Identifier: BSD-3-Clause
#include "commission/report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/units.h"
#include "commission/report_chart.h"

namespace strainwave {
namespace {

constexpr ResponseModel kModel{0.7, 0.5, 30000.0, 3.0, 0.001};

CommissionRecord record_with(const std::string& text) {
  CommissionRecord record;
  record.joint = record.configuration = record.problem = text;
  record.steps = {{text, StepOutcome::kFailed, text, 1.0}};
  record.values = {{text, text, 1.0, {2.0, 0.1}, 2.0}};
  record.friction = {{0.1, 20.0, {9.0, 0.2}}, {0.5, 20.0, {12.0, 0.3}}};
  record.model = kModel;
  for (const double frequency_Hz : {5.0, 20.0, 80.0})
    record.response.push_back(response_of(kModel, frequency_Hz));
  return record;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(CommissionReport, EscapesEveryText) {
  const std::string text = "<script>&\"'";
  const std::string html = to_html(record_with(text), {{}, text, text});
  EXPECT_EQ(count(html, "<script"), 0U);
  EXPECT_EQ(count(html, "&lt;script&gt;&amp;&quot;&#39;"), 10U) << html;
}

TEST(CommissionReport, NeedsNothingButItself) {
  const std::string html = to_html(record_with("elbow"), {});
  for (const char* outside : {"http", "src=", "href=", "url(", "@import", "<script"})
    EXPECT_EQ(count(html, outside), 0U) << outside;
  EXPECT_EQ(count(html, "<svg"), 3U) << "magnitude, phase, friction";
}

TEST(CommissionReport, ShowsConfiguredMeasuredAndUsedOfEachValue) {
  CommissionRecord record;
  record.values = {{"load_inertia_kgm2", "kg.m2", 0.48, {0.521, 0.0123}, 0.52}};
  const std::string html = to_html(record, {});
  for (const char* shown : {"load_inertia_kgm2", ">0.48<", ">0.521<", ">±0.012<", ">0.52<", "kg.m2"})
    EXPECT_EQ(count(html, shown), 1U) << shown;
}

TEST(CommissionReport, OfAnUnfinishedRecordHasNoDiagram) {
  const std::string html = to_html(CommissionRecord{}, {});
  EXPECT_EQ(count(html, "<svg"), 0U);
  EXPECT_EQ(count(html, "Certificate"), 0U);
}

TEST(ResponseModel, IsOneInertiaFarBelowTheSpringAndTheMotorFarAbove) {
  const double low_Hz = 0.1, high_Hz = 3000.0;
  EXPECT_NEAR(response_of(kModel, low_Hz).magnitude_rad_sNm * kTurn_rad * low_Hz * 1.2, 1.0, 1e-3);
  EXPECT_NEAR(response_of(kModel, high_Hz).magnitude_rad_sNm * kTurn_rad * high_Hz * 0.7, 1.0, 0.01);
  EXPECT_NEAR(response_of(kModel, low_Hz).phase_rad, -0.25 * kTurn_rad - kTurn_rad * low_Hz * 0.001, 1e-3);
}

TEST(ResponseModel, HasItsDipWhereTheLinkSwingsAgainstAStandingMotor) {
  const double dip_Hz = std::sqrt(30000.0 / 0.5) / kTurn_rad;
  const double there = response_of(kModel, dip_Hz).magnitude_rad_sNm;
  EXPECT_LT(there, response_of(kModel, 0.9 * dip_Hz).magnitude_rad_sNm);
  EXPECT_LT(there, response_of(kModel, 1.1 * dip_Hz).magnitude_rad_sNm);
}

Chart one_curve(std::vector<ChartPoint> points, bool logarithmic) {
  return {"a", "x", "y", logarithmic, logarithmic, {{"", std::move(points), false}}};
}

TEST(Chart, DrawsEachPointThatItsAxesHave) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<ChartPoint> points{{-1.0, 2.0}, {1.0, nan}, {1.0, 2.0}, {10.0, 0.0}, {100.0, 5.0}};
  EXPECT_EQ(count(to_svg(one_curve(points, false)), "<circle"), 4U);
  EXPECT_EQ(count(to_svg(one_curve(points, true)), "<circle"), 2U);
  EXPECT_EQ(to_svg(one_curve({{-1.0, 2.0}}, true)), "");
}

TEST(Chart, KeepsAllPointsWithinItsFrame) {
  const std::string svg = to_svg(one_curve({{0.001, 3e5, 1e5}, {7.0, -2e5}, {3.0, 0.0}}, false));
  for (std::size_t at = svg.find("cx=\""); at != std::string::npos; at = svg.find("cx=\"", at + 1)) {
    const double x = std::stod(svg.substr(at + 4));
    const double y = std::stod(svg.substr(svg.find("cy=\"", at) + 4));
    EXPECT_TRUE(x > 70.0 && x < 620.0) << x;
    EXPECT_TRUE(y > 26.0 && y < 254.0) << y;
  }
}

TEST(Chart, OfOnePointHasAFrameAllTheSame) {
  EXPECT_EQ(count(to_svg(one_curve({{1.0, 0.0}}, false)), "<circle"), 1U);
  EXPECT_EQ(count(to_svg(one_curve({{1.0, 0.0}}, false)), "nan"), 0U);
}

}  // namespace
}  // namespace strainwave
