// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/wrongly_configured.h"

#include <algorithm>

#include "base/parallel.h"
#include "sim/studies/link_limit.h"
#include "sim/studies/statistics.h"

namespace strainwave {

namespace {

std::vector<double> over_known(const std::vector<WronglyConfiguredRow>& rows, double least_step_rad,
                               double largest_step_rad) {
  std::vector<double> ratios;
  for (const WronglyConfiguredRow& row : rows)
    if (row.cell.step_rad >= least_step_rad && row.cell.step_rad < largest_step_rad)
      ratios.push_back(row.over_known);
  return ratios;
}

template <typename Of>
std::string count(const std::vector<WronglyConfiguredRow>& rows, const Of& of) {
  return std::to_string(std::count_if(rows.begin(), rows.end(), of));
}

std::vector<std::string> summary_row(const std::string& wrong,
                                     const std::vector<WronglyConfiguredRow>& rows) {
  std::vector<std::string> fields = {wrong, std::to_string(rows.size())};
  for (const double step_rad : {1e-3, 1e-2, 0.1, 1.0}) {
    const auto ratios = over_known(rows, 0.3 * step_rad, 3.0 * step_rad);
    fields.push_back(number(percentile(ratios, 0.5), 3) + ", " + number(percentile(ratios, 0.95), 3));
  }
  std::vector<double> rest_errors;
  std::vector<double> overshoots;
  for (const WronglyConfiguredRow& row : rows) {
    rest_errors.push_back(1e3 * row.result.rest_error_rad);
    overshoots.push_back(1e3 * row.result.overshoot_rad);
  }
  fields.push_back(number(percentile(overshoots, 0.5), 2) + ", " + number(percentile(overshoots, 1.0), 2));
  fields.push_back(count(
      rows, [](const WronglyConfiguredRow& row) { return row.result.rest_error_rad > kCountedError_rad; }));
  fields.push_back(number(percentile(rest_errors, 1.0), 2));
  fields.push_back(count(rows, [](const WronglyConfiguredRow& row) { return row.result.switched_off; }));
  fields.push_back(count(rows, [](const WronglyConfiguredRow& row) { return row.result.oscillates; }));
  return fields;
}

}  // namespace

std::vector<WronglyConfiguredRow> run_wrongly_configured(const std::vector<FlexibleCell>& cells,
                                                         const Contender& contender) {
  std::vector<WronglyConfiguredRow> rows(cells.size());
  run_in_parallel(cells.size(), [&](std::size_t i) {
    rows[i].cell = cells[i];
    rows[i].result = run_without_limit(cells[i], contender);
  });
  double known = 0.0;
  for (WronglyConfiguredRow& row : rows) {
    if (row.cell.effect == "none") known = row.result.link_counted_ratio;
    row.over_known = row.result.link_counted_ratio / known;
  }
  return rows;
}

TextTable wrongly_configured_summary(const std::string& title,
                                     const std::vector<WronglyConfiguredRow>& rows) {
  std::vector<std::string> wrongs;
  for (const WronglyConfiguredRow& row : rows)
    if (std::find(wrongs.begin(), wrongs.end(), row.cell.effect) == wrongs.end())
      wrongs.push_back(row.cell.effect);
  TextTable table;
  table.title =
      title + ": the link's sum above 40 urad over that of the same joint with the right model; median, 95 %";
  table.header = {"wrong",
                  "joints",
                  "0.001 rad",
                  "0.01 rad",
                  "0.1 rad",
                  "1 rad",
                  "overshoot (mrad): median, worst",
                  "off by more than 40 urad",
                  "worst (mrad)",
                  "switched off",
                  "oscillating"};
  for (const std::string& wrong : wrongs) {
    std::vector<WronglyConfiguredRow> of_wrong;
    for (const WronglyConfiguredRow& row : rows)
      if (row.cell.effect == wrong) of_wrong.push_back(row);
    table.rows.push_back(summary_row(wrong, of_wrong));
  }
  return table;
}

}  // namespace strainwave
