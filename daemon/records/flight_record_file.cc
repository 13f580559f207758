#include "daemon/records/flight_record_file.h"

#include <array>
#include <charconv>
#include <ctime>
#include <string_view>

#include "lcmtypes/vocabulary.h"

namespace strainwave {

namespace {

struct Column {
  std::string_view name;
  std::string_view unit;
};

constexpr std::array kColumns{
    Column{"cycle", "1"},
    Column{"time_s", "s"},
    Column{"mode", "1"},
    Column{"fault", "1"},
    Column{"notices", "1"},
    Column{"drive_state", "1"},
    Column{"reading_fresh", "1"},
    Column{"setpoint_position_rad", "rad"},
    Column{"setpoint_velocity_rad_s", "rad/s"},
    Column{"target_position_rad", "rad"},
    Column{"joint_position_rad", "rad"},
    Column{"joint_velocity_rad_s", "rad/s"},
    Column{"torque_commanded_Nm", "N.m"},
    Column{"torque_applied_Nm", "N.m"},
    Column{"torque_feedback_Nm", "N.m"},
    Column{"torque_feedforward_Nm", "N.m"},
    Column{"temperature_C", "degC"},
    Column{"temperature_measured_C", "degC"},
    Column{"temperature_status", "1"},
    Column{"gains_in_use", "1"},
    Column{"zero_velocity_weight", "1"},
    Column{"table_id", "1"},
};

template <typename Number>
void append_number(std::string& text, Number number) {
  std::array<char, 32> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number).ptr;
  text.append(buffer.data(), end);
}

class Row {
 public:
  explicit Row(std::string& text) : text_(text) {}
  template <typename Number>
  Row& add(Number number) {
    if (!first_) text_ += ',';
    first_ = false;
    append_number(text_, number);
    return *this;
  }
  void end() { text_ += '\n'; }

 private:
  std::string& text_;
  bool first_ = true;
};

void append_sample(std::string& text, const FlightSample& sample, std::int64_t fault_ns) {
  Row(text)
      .add(sample.cycle)
      .add(static_cast<double>(sample.time_ns - fault_ns) * 1e-9)
      .add(int{sample.mode})
      .add(int{sample.fault})
      .add(int{sample.notices})
      .add(int{sample.drive_state})
      .add(int{sample.reading_fresh})
      .add(sample.setpoint_position_rad)
      .add(sample.setpoint_velocity_rad_s)
      .add(sample.target_position_rad)
      .add(sample.joint_position_rad)
      .add(sample.joint_velocity_rad_s)
      .add(sample.torque_commanded_Nm)
      .add(sample.torque_applied_Nm)
      .add(sample.torque_feedback_Nm)
      .add(sample.torque_feedforward_Nm)
      .add(sample.temperature_C)
      .add(sample.temperature_measured_C)
      .add(int{sample.temperature_status})
      .add(int{sample.gains_in_use})
      .add(sample.zero_velocity_weight)
      .add(sample.table_id)
      .end();
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

// The same without what a file name should not have.
std::string utc_for_name(std::int64_t unix_us) {
  std::string text = utc(unix_us);
  std::erase_if(text, [](char c) { return c == '-' || c == ':'; });
  return text;
}

void append_line(std::string& text, std::string_view key, const std::string& value) {
  text.append("# ").append(key).append(": ").append(value).append("\n");
}

std::string with_text(std::uint8_t fault) {
  return std::to_string(fault) + " " + std::string(to_text(static_cast<Fault>(fault)));
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
  append_line(text, "fault", with_text(fault.fault));
  append_line(text, "fault_cycle", std::to_string(fault.cycle));
  append_line(text, "fault_utc", utc(header.fault_unix_us));
  append_line(text, "period_s", period);
  append_line(text, "rows", std::to_string(recorder.size()));
  append_line(text, "lost_rows", std::to_string(recorder.lost()));
  std::string units;
  std::string names;
  for (const Column& column : kColumns) {
    units.append(units.empty() ? "" : ",").append(column.unit);
    names.append(names.empty() ? "" : ",").append(column.name);
  }
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
