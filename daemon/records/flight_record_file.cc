// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/records/flight_record_file.h"

#include <array>
#include <charconv>
#include <ctime>
#include <string_view>

#include "base/csv.h"
#include "base/durations.h"
#include "lcmtypes/cycle_fields.h"
#include "lcmtypes/reading_doubt.h"

namespace strainwave {

namespace {

template <typename Number>
void append_number(std::string& text, Number number) {
  std::array<char, 32> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), csv_number(number)).ptr;
  text.append(buffer.data(), end);
}

void append_sample(std::string& text, const FlightSample& sample, std::int64_t fault_ns) {
  append_number(text, seconds(sample.time_ns - fault_ns));
  visit_cycle_fields(sample, [&](const FieldName&, auto value) {
    text += ',';
    // A byte is a number here, not a character.
    if constexpr (sizeof(value) == 1)
      append_number(text, int{value});
    else
      append_number(text, value);
  });
  text += '\n';
}

// "2026-11-21T03:04:05Z"
std::string utc(std::int64_t unix_us) {
  const std::time_t seconds = unix_us / 1'000'000;
  std::tm parts{};
  ::gmtime_r(&seconds, &parts);
  std::array<char, 64> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text.data();
}

// The same, without characters that do not suit a file name.
std::string utc_for_name(std::int64_t unix_us) {
  std::string text = utc(unix_us);
  std::erase_if(text, [](char c) { return c == '-' || c == ':'; });
  return text;
}

void append_line(std::string& text, std::string_view key, const std::string& value) {
  text.append("# ").append(key).append(": ").append(value).append("\n");
}

std::string with_text(const FlightSample& sample) {
  return std::to_string(sample.fault) + " " +
         fault_words(static_cast<Fault>(sample.fault), sample.drive_error);
}

}  // namespace

std::string flight_record_text(const FlightRecordHeader& header, const FlightRecorder& recorder) {
  const FlightSample& fault = recorder.sample(recorder.fault_index());
  std::string period;
  append_number(period, header.period_s);
  std::string text = "# strainwave-flight-record " + std::to_string(kFlightRecordFormat) + "\n";
  append_line(text, "joint", header.joint);
  append_line(text, "joint_model", header.joint_model);
  append_line(text, "session_id", std::to_string(header.session_id));
  append_line(text, "fault", with_text(fault));
  append_line(text, "fault_cycle", std::to_string(fault.cycle));
  append_line(text, "fault_utc", utc(header.fault_unix_us));
  append_line(text, "period_s", period);
  append_line(text, "rows", std::to_string(recorder.size()));
  append_line(text, "lost_rows", std::to_string(recorder.lost()));
  std::string units = "s";
  std::string names = "time_s";
  visit_cycle_fields(fault, [&](const FieldName& field, const auto&) {
    units.append(",").append(field.unit);
    names.append(",").append(field.name);
  });
  append_line(text, "units", units);
  text.append(names).append("\n");
  for (std::size_t i = 0; i < recorder.size(); ++i) append_sample(text, recorder.sample(i), fault.time_ns);
  return text;
}

std::string flight_record_name(const FlightRecordHeader& header, const FlightRecorder& recorder) {
  const FlightSample& fault = recorder.sample(recorder.fault_index());
  return header.joint + "-" + utc_for_name(header.fault_unix_us) + "-c" + std::to_string(fault.cycle) + "-f" +
         std::to_string(fault.fault) + kFlightRecordSuffix;
}

}  // namespace strainwave
