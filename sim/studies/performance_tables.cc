// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/performance_tables.h"

#include <algorithm>

#include "base/csv.h"
#include "base/input_error.h"

namespace strainwave {

namespace {

int source_table(Scenario scenario, bool relative) {
  return (scenario == Scenario::kStaircase ? 8 : 10) + (relative ? 1 : 0);
}

std::string source_value(const std::vector<SourceIndex>& source, int table, const std::string& controller,
                         int range) {
  const auto found = std::find_if(source.begin(), source.end(), [&](const SourceIndex& candidate) {
    return candidate.table == table && candidate.controller == controller;
  });
  return found == source.end() ? "" : number(found->value[static_cast<std::size_t>(range)]);
}

std::vector<std::string> header(bool relative, bool limited) {
  std::vector<std::string> fields = {"controller"};
  for (const double start_rad : kRangeStart_rad) {
    const std::string from = "from " + number(start_rad) + " rad";
    fields.push_back(from);
    fields.push_back("Zhao");
    if (relative && limited) fields.push_back("x limit");
  }
  return fields;
}

TextTable table_of(const Chapter6& chapter, const std::vector<SourceIndex>& source, Setting setting,
                   Scenario scenario, bool relative) {
  const int table = source_table(scenario, relative);
  const bool limited = setting != Setting::kIdeal;
  TextTable result;
  result.title = "Table " + std::to_string(table) + ", " +
                 (relative ? "PI2 = sum |e/r|" : "PI1 = sum e^2 (rad^2)") + ", " +
                 std::string(name(scenario)) + ", " + std::string(name(setting));
  result.header = header(relative, limited);
  for (const std::string& contender : chapter.contenders) {
    std::vector<std::string> row = {contender};
    for (int range = 0; range < kRangeCount; ++range) {
      const Chapter6Key key{setting, scenario, range};
      const LoopStatistics& statistics = chapter.at(key, contender).statistics;
      row.push_back(number(relative ? statistics.pi2 : statistics.pi1_rad2));
      row.push_back(source_value(source, table, contender, range));
      if (relative && limited) row.push_back(number(statistics.pi2 / chapter.limit(key)->statistics.pi2, 3));
    }
    result.rows.push_back(row);
  }
  if (!limited) return result;
  std::vector<std::string> row = {"physical limit"};
  for (int range = 0; range < kRangeCount; ++range) {
    const LoopStatistics& limit = chapter.limit({setting, scenario, range})->statistics;
    row.push_back(number(relative ? limit.pi2 : limit.pi1_rad2));
    row.emplace_back();
    if (relative) row.emplace_back("1");
  }
  result.rows.push_back(row);
  return result;
}

}  // namespace

std::vector<SourceIndex> read_source_indices(const std::filesystem::path& path) {
  const std::vector<std::string> columns = {"table",   "index",   "controller", "range_1",
                                            "range_2", "range_3", "range_4"};
  std::vector<SourceIndex> indices;
  const CsvText table = read_csv_text(path);
  table.require_columns(columns);
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const std::vector<std::string>& fields = table.rows[r];
    const std::string where = table.place(r);
    SourceIndex index;
    index.table = static_cast<int>(parse_number(fields[0], where, "table"));
    index.index = fields[1];
    index.controller = fields[2];
    for (std::size_t i = 0; i < index.value.size(); ++i)
      index.value[i] = parse_number(fields[3 + i], where, columns[3 + i]);
    indices.push_back(index);
  }
  return indices;
}

std::vector<TextTable> performance_tables(const Chapter6& chapter, const std::vector<SourceIndex>& source) {
  std::vector<TextTable> tables;
  for (const Setting setting : kSettings)
    for (const Scenario scenario : kScenarios)
      for (const bool relative : {false, true})
        tables.push_back(table_of(chapter, source, setting, scenario, relative));
  return tables;
}

TextTable run_table(const Chapter6& chapter) {
  TextTable table;
  table.header = {
      "setting",       "scenario",    "range_start_rad", "controller",      "pi1_rad2",
      "pi2",           "limit_pi2",   "ratio_to_limit",  "final_error_rad", "steady_error_rad",
      "overshoot_rad", "rise_time_s", "settling_time_s", "peak_torque_Nm",  "steady_sign_changes_per_s"};
  for (const Chapter6Run& run : chapter.runs) {
    const LoopStatistics& s = run.result.statistics;
    const TimeOptimalResult* limit = chapter.limit(run.key);
    const auto exact = [](double value) { return number(value, 9); };
    table.rows.push_back({std::string(name(run.key.setting)), std::string(name(run.key.scenario)),
                          number(kRangeStart_rad[static_cast<std::size_t>(run.key.range)]), run.contender,
                          exact(s.pi1_rad2), exact(s.pi2), limit ? exact(limit->statistics.pi2) : "",
                          limit ? exact(s.pi2 / limit->statistics.pi2) : "", exact(s.final_error_rad),
                          exact(s.steady_error_rad), exact(s.overshoot_rad), exact(s.rise_time_s),
                          exact(s.settling_time_s), exact(s.peak_torque_Nm),
                          exact(s.steady_sign_changes_per_s)});
  }
  return table;
}

}  // namespace strainwave
