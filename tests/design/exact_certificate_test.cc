// SPDX-License-Identifier: BSD-3-Clause
// Both checkers of a table agree on the shipped tables and on tables that are changed until a proof just fails.
#include "design/exact/exact_certificate.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <random>
#include <span>
#include <stdexcept>
#include <string>

#include "control/table/box_certificate.h"
#include "control/table/gain_table_json.h"
#include "design/exact/least_fall.h"

namespace strainwave {
namespace {

GainTable table_of(const char* name) {
  return read_gain_table(std::string(STRAINWAVE_SOURCE_DIR "/data/tables/") + name);
}

// The exponential of a rotation by 1 rad contains cos 1 and sin 1, and the enclosure is narrow.
TEST(RationalMatrix, ExponentialEnclosesARotation) {
  RationalMatrix M(2, 2);
  M(0, 1) = -1;
  M(1, 0) = 1;
  const Enclosure rotation = exponential(M, {1, 1});
  EXPECT_DOUBLE_EQ(rotation.value(0, 0).get_d(), std::cos(1.0));
  EXPECT_DOUBLE_EQ(rotation.value(1, 0).get_d(), std::sin(1.0));
  // The rows of a rotation have length 1 within the enclosure, though not exactly.
  const mpq_class length =
      rotation.value(0, 0) * rotation.value(0, 0) + rotation.value(0, 1) * rotation.value(0, 1);
  EXPECT_LT(abs(length - 1), 4 * rotation.radius(0, 0));
  EXPECT_LT(rotation.radius(0, 0), mpq_class(1, mpz_class(1) << 120));
  EXPECT_THROW(exponential(mpq_class(100) * M, {1, 1}), std::domain_error);
}

// The chord lies above exp(h w) by at most h^2 w^2 exp / 8. The bound holds, and short chords reach it.
TEST(RationalMatrix, InterpolationBoundHoldsAndIsTight) {
  for (const double width : {0.5, 0.01}) {
    RationalMatrix size(1, 1);
    RationalMatrix change(1, 1);
    size(0, 0) = 1;
    change(0, 0) = width;
    const double bound = interpolation_bound(size, change, {1})(0, 0).get_d();
    const double most = width * width * std::exp(1.0) / 8.0;
    EXPECT_NEAR(bound, most, 1e-12 * most);
    const double off = 0.5 * (std::exp(1.0 - width) + std::exp(1.0)) - std::exp(1.0 - 0.5 * width);
    EXPECT_LE(off, bound);
    EXPECT_GE(off, bound * std::exp(-width));
  }
}

// There is no rounding: a singular matrix is not definite, and a matrix that is larger by 2^-1000 is.
TEST(RationalMatrix, DefinitenessIsExact) {
  RationalMatrix a(2, 2);
  a(0, 0) = 1;
  a(0, 1) = a(1, 0) = 3;
  a(1, 1) = 9;
  EXPECT_FALSE(is_positive_definite(a));
  a(1, 1) += mpq_class(1, mpz_class(1) << 1000);
  EXPECT_TRUE(is_positive_definite(a));
  a(0, 0) = 0;
  EXPECT_FALSE(is_positive_definite(a));
}

// If falls() accepts an enclosure, V falls for every matrix within it. The test tries corners with random signs.
TEST(LeastFall, HoldsForEveryMatrixWithinTheBounds) {
  std::mt19937_64 random(5);
  std::uniform_int_distribution<int> entry(-40, 40);
  int accepted = 0;
  for (int i = 0; i < 200; ++i) {
    const std::size_t n = 3;
    RationalMatrix P = RationalMatrix::identity(n, 100);
    Enclosure loop{RationalMatrix(n, n), RationalMatrix(n, n)};
    for (std::size_t r = 0; r < n; ++r)
      for (std::size_t c = 0; c < n; ++c) {
        if (c < r) P(r, c) = P(c, r) = entry(random);
        loop.value(r, c) = mpq_class(entry(random)) / 100;
        loop.radius(r, c) = mpq_class(std::abs(entry(random))) / 400;
      }
    if (!is_positive_definite(P) || !falls(P, P, loop, 1)) continue;
    ++accepted;
    for (int k = 0; k < 20; ++k) {
      RationalMatrix H = loop.value;
      for (std::size_t r = 0; r < n; ++r)
        for (std::size_t c = 0; c < n; ++c) H(r, c) += (entry(random) > 0 ? 1 : -1) * loop.radius(r, c);
      EXPECT_TRUE(is_positive_definite(P - transpose(H) * (P * H)));
    }
  }
  EXPECT_GE(accepted, 10);
}

TEST(ExactCertificate, ProvesShippedTables) {
  for (const char* name : {"rhs17-6006.json", "total-0.178/c4.json", "csf-17-50.json"}) {
    const ExactReport report = certify_exactly(table_of(name));
    EXPECT_TRUE(report.certified) << name << ": " << report.refusal;
    EXPECT_GE(report.inequalities, 39) << name;
  }
}

/// One cell of a shipped table, with three gains. Its proof takes a tenth of a second.
GainTable one_cell(const char* name, std::size_t cell) {
  GainTable table = table_of(name);
  CertifiedBox& box = table.box;
  box.cells[0] = box.cells[cell];
  for (std::size_t i = 1; i < box.cells.size(); ++i) box.cells[i] = {};
  box.cell_count = 1;
  box.least_delay = box.most_delay = box.cells[0].delay_periods;
  box.stiffness_Nm_rad = box.cells[0].stiffness_Nm_rad;
  box.link_inertia_kgm2 = box.cells[0].link_inertia_kgm2;
  table.friction.rule_count = 1;
  for (std::size_t i = 1; i < table.friction.rules.size(); ++i) table.friction.rules[i] = {};
  table.primary.rule_count = 2;
  for (std::size_t j = 2; j < table.primary.F.size(); ++j) {
    table.primary.F[j] = {};
    table.primary.P[j] = {};
  }
  return table;
}

/// One way to change a table. An `amount` of 0 leaves the table unchanged.
struct Change {
  int kind = 0;
  std::size_t place = 0;
  double sign = 1.0;

  GainTable of(GainTable table, double amount) const {
    const double factor = 1.0 + sign * amount;
    BoxCell& cell = table.box.cells[0];
    const std::size_t rule = place % 3;
    switch (kind) {
      case 0:  // all gains
        for (auto& row : table.primary.F)
          for (double& gain : row) gain *= factor;
        break;
      case 1:  // one gain
        table.primary.F[rule][place / 3 % 3] *= factor;
        break;
      case 2:  // one entry of the cell's P
        cell.P[place % table.box.entries_of(cell)] *= factor;
        break;
      case 3:  // the cell's width
        cell.stiffness_Nm_rad.to *= 1.0 + amount;
        cell.stiffness_Nm_rad.from /= 1.0 + amount;
        table.box.stiffness_Nm_rad = cell.stiffness_Nm_rad;
        break;
      case 4:
        cell.link_inertia_kgm2.to *= 1.0 + (sign > 0.0 ? amount : 0.0);
        cell.link_inertia_kgm2.from /= 1.0 + (sign < 0.0 ? amount : 0.0);
        table.box.link_inertia_kgm2 = cell.link_inertia_kgm2;
        break;
      case 5:
        table.box.damping_Nms_rad.to *= 1.0 + amount;
        table.friction.rules[0].friction.viscous_Nms_rad *= 1.0 + amount;
        break;
      default:  // the motor's inertia
        (sign > 0.0 ? table.box.motor_inertia_kgm2.to : table.box.motor_inertia_kgm2.from) *= factor;
        table.plant.inertia_kgm2 *= factor;
        break;
    }
    return table;
  }
};
constexpr int kKinds = 7;

bool first_accepts(const GainTable& table) {
  return certify_box(table).certified;
}

/// Returns the largest amount of this change that the first checker accepts, within a part in 2^30. Returns nothing if it accepts 0.9.
std::optional<double> edge_of(const GainTable& table, const Change& change) {
  double accepted = 0.0;
  double refused = 0.9;
  if (first_accepts(change.of(table, refused))) return std::nullopt;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (accepted + refused);
    (first_accepts(change.of(table, middle)) ? accepted : refused) = middle;
  }
  return accepted;
}

/// Judges changed tables on both sides of the edge and prints the counts. The first checker must refuse a table if V does not fall on some joint of
/// the box. Judges `usual` tables, or $STRAINWAVE_MUTATED_TABLES of them: 10,000 take minutes.
void compare(std::span<const GainTable> sound, int usual) {
  const char* const wanted = std::getenv("STRAINWAVE_MUTATED_TABLES");
  const int tables = wanted != nullptr ? std::atoi(wanted) : usual;
  std::mt19937_64 random(11);
  std::array<std::array<int, 2>, 2> count{};  // [exact accepts][first accepts]
  int undecided = 0;
  int judged = 0;
  for (std::size_t i = 0; judged < tables; ++i) {
    const GainTable& table = sound[i % sound.size()];
    const Change change{static_cast<int>(i / sound.size()) % kKinds, random() % 45,
                        random() % 2 == 0 ? 1.0 : -1.0};
    const std::optional<double> edge = edge_of(table, change);
    if (!edge) continue;
    for (const double side : {-1.0, 1.0}) {
      const double off = std::pow(10.0, std::uniform_real_distribution<double>(-9.0, -1.0)(random));
      const GainTable changed = change.of(table, *edge * (1.0 + side * off));
      const bool first = first_accepts(changed);
      const ExactReport exact = certify_exactly(changed);
      ++judged;
      ++count.at(exact.certified ? 1 : 0).at(first ? 1 : 0);
      // The exact checker may miss a proof between the corners, but not at a joint.
      const bool missed = exact.refusal.find("no proof between") != std::string::npos;
      undecided += first && missed ? 1 : 0;
      EXPECT_FALSE(first && !exact.certified && !missed)
          << table.name.view() << ", change " << change.kind << " at " << change.place << ", off the edge by "
          << side * off << ": " << exact.refusal;
    }
  }
  std::printf(
      "%d tables: both accept %d, both refuse %d, exact alone accepts %d, first alone %d (%d undecided)\n",
      judged, count[1][1], count[0][0], count[1][0], count[0][1], undecided);
  EXPECT_GT(count[1][1], 0);
  EXPECT_GT(count[0][0], 0);
}

TEST(ExactCertificate, AgreesWithTheFirstCheckerOnChangedRigidTables) {
  const std::array<GainTable, 2> sound{table_of("rhs17-6006.json"), table_of("total-0.356/c2.json")};
  compare(sound, 56);  // each kind of change to each table, on both sides of two edges
}

TEST(ExactCertificate, AgreesWithTheFirstCheckerOnChangedCells) {
  const std::array<GainTable, 3> sound{one_cell("csf-17-50.json", 3), one_cell("csf-17-50-delays.json", 12),
                                       one_cell("csf-17-50-link.json", 5)};
  compare(sound, 14);
}

}  // namespace
}  // namespace strainwave
