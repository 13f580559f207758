// SPDX-License-Identifier: BSD-3-Clause
#include "client/text/mcap_flight.h"

#include <array>
#include <chrono>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "base/csv.h"
#include "base/input_error.h"
#include "client/text/flight_record.h"
#include "client/text/mcap_writer.h"
#include "lcmtypes/cycle_fields.h"
#include "lcmtypes/message_json.h"
#include "lcmtypes/reading_doubt.h"
#include "strainwave/vocabulary.h"

namespace strainwave {

namespace {

constexpr const char* kSchemaName = "strainwave.flight_record_1";

std::string head_of(const FlightRecordInfo& info, const std::string& key, const std::string& source) {
  const auto found = info.head.find(key);
  if (found == info.head.end()) throw InputError(source + " has no " + key + ": it is incomplete");
  return found->second;
}

std::int64_t fault_ns(const FlightRecordInfo& info, const std::string& source) {
  const std::string text = head_of(info, "fault_utc", source);
  int year = 0;
  unsigned month = 0;
  unsigned day = 0;
  int hour = 0;
  int minute = 0;
  int second = 0;
  std::istringstream stream(text);
  std::array<char, 6> marks{};
  // "2026-11-21T03:04:05Z". Each separator is read as one character, so that "-" does not become a sign.
  stream >> year >> marks[0] >> month >> marks[1] >> day >> marks[2] >> hour >> marks[3] >> minute >>
      marks[4] >> second >> marks[5];
  const std::chrono::year_month_day date{std::chrono::year(year), std::chrono::month(month),
                                         std::chrono::day(day)};
  // The range that fits into nanoseconds since 1970.
  const bool in_range = year >= 1970 && year < 2262 && date.ok() && hour >= 0 && hour < 24 && minute >= 0 &&
                        minute < 60 && second >= 0 && second <= 60;
  if (!stream || std::string_view(marks.data(), marks.size()) != "--T::Z" || !in_range)
    throw InputError(source, "fault_utc", text, "a time as 2026-11-21T03:04:05Z is allowed");
  const auto at = std::chrono::sys_days(date) + std::chrono::hours(hour) + std::chrono::minutes(minute) +
                  std::chrono::seconds(second);
  return std::chrono::duration_cast<std::chrono::nanoseconds>(at.time_since_epoch()).count();
}

std::string schema_of(const CsvText& csv) {
  json::Schema schema(kSchemaName);
  for (const std::string& column : csv.columns) {
    if (json::is_a_name(column))
      schema.text(column);
    else
      schema.number(column);
  }
  schema.text("mode_text");
  schema.text("fault_text");
  schema.number("tracking_error_rad");
  return std::move(schema).end();
}

std::string message_of(const CsvText& csv, std::size_t row) {
  json::Object object;
  for (std::size_t c = 0; c < csv.columns.size(); ++c) {
    if (json::is_a_name(csv.columns[c]))
      object.add(csv.columns[c], std::string_view(csv.rows[row][c]));
    else
      object.add(csv.columns[c], flight_number(csv, row, c));
  }
  const auto value = [&](const char* name) { return flight_number(csv, row, csv.column(name)); };
  object.add("mode_text", std::string_view(to_text(static_cast<Mode>(std::lround(value("mode"))))));
  object.add("fault_text", fault_words(static_cast<Fault>(std::lround(value("fault"))),
                                       std::llround(value("drive_error"))));
  object.add("tracking_error_rad", value("setpoint_position_rad") - value("joint_position_rad"));
  return std::move(object).end();
}

}  // namespace

bool is_flight_record(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string line;
  return std::getline(stream, line) && line.starts_with("# strainwave-flight-record ");
}

FlightMcap write_flight_mcap(const std::filesystem::path& file, const std::filesystem::path& mcap) {
  const FlightRecordInfo info = read_flight_record(file);
  const std::int64_t at_ns = fault_ns(info, file.string());
  const CsvText csv = read_csv_text(file);
  const std::size_t time = csv.column("time_s");
  FlightMcap written{head_of(info, "joint", file.string()) + ".FLIGHT", csv.rows.size()};
  McapWriter writer(mcap, "strainwave " STRAINWAVE_VERSION);
  const std::uint16_t channel = writer.add_channel(written.topic, kSchemaName, schema_of(csv));
  for (std::size_t row = 0; row < csv.rows.size(); ++row) {
    const double time_s = flight_number(csv, row, time);
    if (!(std::abs(time_s) < 1e6))
      throw InputError(csv.place(row), "time_s", csv.rows[row][time], "seconds from the fault are allowed");
    const auto ns = static_cast<std::uint64_t>(at_ns + std::llround(1e9 * time_s));
    writer.write(channel, ns, ns, message_of(csv, row));
  }
  writer.finish();
  return written;
}

}  // namespace strainwave
