// SPDX-License-Identifier: BSD-3-Clause
// doctor: turns a test motion or a recording into evidence, and prints the diagnosis of doctor/ in words.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "client/commands/commands.h"
#include "client/commands/guarded_strokes.h"
#include "client/protocol/event_log_writer.h"
#include "client/protocol/interrupt.h"
#include "client/protocol/published_limits.h"
#include "client/text/flight_record.h"
#include "client/text/mcap_flight.h"
#include "client/text/text.h"
#include "doctor/diagnosis.h"
#include "doctor/test_motion.h"
#include "lcmtypes/event_log.h"
#include "lcmtypes/message_kinds.h"
#include "strainwave/client_error.h"

namespace strainwave {

namespace {

Evidence begun(const DoctorArguments& arguments, const std::string& joint) {
  Evidence evidence;
  if (!arguments.config.empty()) evidence.told = read_configured_joint(arguments.config, joint);
  return evidence;
}

/// Adds the received messages of a joint to the evidence.
class Listening {
 public:
  Listening(Client& client, const std::string& joint, Evidence& evidence)
      : joint_(joint),
        evidence_(evidence),
        subscription_(client.connection().subscribe(recorded_channels(client.options().prefix, {joint}),
                                                    &Listening::on_message, this)) {}

 private:
  void on_message(const ReceivedMessage& message) {
    const auto name = parse_channel(message.channel);
    if (name && (name->joint.empty() || name->joint == joint_))
      visit_message(name->kind, message.bytes, [&](const auto& heard) { evidence_.take(heard); });
  }

  std::string joint_;
  Evidence& evidence_;
  Subscription subscription_;
};

Evidence from_event_log(const DoctorArguments& arguments) {
  if (arguments.joint.empty())
    throw ClientError(
        ExitStatus::kUsage,
        "doctor: an LCM event log may hold several joints: name one, as in doctor JOINT --log FILE");
  Evidence evidence = begun(arguments, arguments.joint);
  EventLogReader reader(arguments.log);
  for (LogEvent event; reader.next(event);) {
    const auto name = parse_channel(event.channel);
    if (!name || (!name->joint.empty() && name->joint != arguments.joint)) continue;
    visit_message(name->kind, event.data, [&](const auto& message) { evidence.take(message); });
  }
  return evidence;
}

Evidence from_flight_record(const DoctorArguments& arguments, const std::string& joint, double period_s) {
  Evidence evidence = begun(arguments, joint);
  evidence.period_s = period_s;
  const CsvText csv = read_csv_text(arguments.log);
  const auto column = [&](const char* name) { return csv.column(name); };
  const auto number = [&](std::size_t row, std::size_t at) { return flight_number(csv, row, at); };
  const std::size_t cycle = column("cycle"), speed = column("setpoint_velocity_rad_s"),
                    position = column("joint_position_rad"), commanded = column("torque_commanded_Nm"),
                    applied = column("torque_applied_Nm"), temperature = column("temperature_used_C"),
                    mode = column("mode"), fault = column("fault"), notices = column("notices"),
                    status = column("temperature_status"), drive_error = column("drive_error");
  for (std::size_t row = 0; row < csv.rows.size(); ++row)
    evidence.samples.push_back({.cycle = static_cast<std::int64_t>(number(row, cycle)),
                                .setpoint_velocity_rad_s = number(row, speed),
                                .joint_position_rad = number(row, position),
                                .torque_commanded_Nm = number(row, commanded),
                                .torque_applied_Nm = number(row, applied),
                                .temperature_used_C = number(row, temperature),
                                .mode = static_cast<std::int32_t>(number(row, mode)),
                                .fault = static_cast<std::int32_t>(number(row, fault)),
                                .notices = static_cast<std::int32_t>(number(row, notices)),
                                .temperature_status = static_cast<std::int32_t>(number(row, status)),
                                .drive_error = static_cast<std::int64_t>(number(row, drive_error))});
  return evidence;
}

std::string to_text(const std::string& joint, const Diagnosis& diagnosis, const Evidence& evidence) {
  std::string text =
      diagnosis.findings.empty()
          ? fmt::format("{}: nothing found in {} states\n", joint, evidence.samples.size())
          : fmt::format("{}: likeliest cause first, from {} states\n", joint, evidence.samples.size());
  for (const Finding& finding : diagnosis.findings) {
    text += fmt::format("  {} ({:.0f} %)\n", finding.cause, 100.0 * finding.probability);
    for (const std::string& seen : finding.evidence) text += fmt::format("    seen: {}\n", seen);
    text += fmt::format("    do: {}\n", finding.remedy);
  }
  for (const std::string& open : diagnosis.not_judged) text += fmt::format("  not judged: {}\n", open);
  return text;
}

std::string to_json(const std::string& joint, const Diagnosis& diagnosis, const Evidence& evidence) {
  nlohmann::ordered_json json{{"joint", joint}, {"states", evidence.samples.size()}};
  json["findings"] = nlohmann::ordered_json::array();
  for (const Finding& finding : diagnosis.findings)
    json["findings"].push_back({{"cause", finding.cause},
                                {"probability", finding.probability},
                                {"evidence", finding.evidence},
                                {"remedy", finding.remedy}});
  json["not_judged"] = diagnosis.not_judged;
  return json.dump() + "\n";
}

/// Prints the findings, and throws if there is any.
void report(const Output& output, const std::string& joint, const Evidence& evidence) {
  if (evidence.samples.size() < 2)
    throw ClientError(
        ExitStatus::kUsage,
        fmt::format(
            "{}: fewer than two states of this joint were found: check its name, or record for longer",
            joint));
  const Diagnosis diagnosis = diagnose(evidence);
  output.stream << (output.json ? to_json(joint, diagnosis, evidence) : to_text(joint, diagnosis, evidence));
  output.stream.flush();
  if (!diagnosis.findings.empty())
    throw ClientError(
        ExitStatus::kRefused,
        fmt::format("{}: {} found", joint, diagnosis.findings.size() == 1 ? "a cause is" : "causes are"),
        {joint, {}, {}, {}, {}});
}

std::string plan_text(const std::string& joint, const std::vector<TestStroke>& strokes,
                      const limits_v1& limits, double position_rad) {
  double low = position_rad, high = position_rad, fastest = 0.0;
  for (const TestStroke& stroke : strokes) {
    low = std::min(low, stroke.position_rad);
    high = std::max(high, stroke.position_rad);
    fastest = std::max(fastest, stroke.speed_rad_s);
  }
  return fmt::format("{}: {} strokes between {:+.3f} and {:+.3f} rad, at most {:.2f} rad/s, about {:.0f} s",
                     joint, strokes.size(), low, high, fastest, duration_s(strokes, limits, position_rad));
}

void run_strokes(Client& client, const std::string& joint, const std::vector<TestStroke>& strokes,
                 double torque_limit_Nm) {
  run_guarded(client, joint, [&] {
    GuardedStrokes guarded(client, joint, torque_limit_Nm);
    for (const TestStroke& stroke : strokes) {
      guarded.go(stroke.position_rad, stroke.speed_rad_s);
      guarded.rest(stroke.rest_s);
    }
  });
}

}  // namespace

void examine_joint(Client& client, const Output& output, const DoctorArguments& arguments) {
  const std::string& joint = arguments.joint;
  const JointView& view = client.wait_for_joint(joint);
  if (!arguments.dry_run) require_holding(view, joint);
  Evidence evidence = begun(arguments, joint);
  evidence.take(PublishedLimits(client, {joint}).wait_for(joint));
  const double position_rad = view.state.joint_position_rad;
  const auto strokes = plan_test_motion(*evidence.limits, position_rad, arguments.reach_rad);
  if (strokes.empty())
    throw ClientError(ExitStatus::kUsage, fmt::format("{}: less than 0.1 rad of travel is free around {:.3f} "
                                                      "rad: move the joint away from its limits, or "
                                                      "give a larger --reach_rad",
                                                      joint, position_rad));
  if (!output.json || arguments.dry_run)
    say(output, plan_text(joint, strokes, *evidence.limits, position_rad),
        {{"joint", joint}, {"duration_s", duration_s(strokes, *evidence.limits, position_rad)}});
  if (arguments.dry_run) return;
  const Listening listening(client, joint, evidence);
  std::exception_ptr ended;
  try {
    run_strokes(client, joint, strokes, evidence.limits->torque_limit_Nm * 1.01);
    client.wait_until([&] { return evidence.timings.size() >= 2; }, Deadline(client.options().timeout_s));
  } catch (const ClientError& error) {
    if (error.status() == ExitStatus::kInterrupted || error.status() == ExitStatus::kNoAnswer) throw;
    // The failure that ended the test is evidence, too. Without a finding it is thrown again: an unfinished test does not prove health.
    if (!output.json) output.stream << fmt::format("the test ended early: {}\n", error.what());
    client.wait_until([] { return false; }, Deadline(0.3));
    ended = std::current_exception();
  }
  report(output, joint, evidence);
  if (ended) std::rethrow_exception(ended);
}

void examine_log(const Output& output, const DoctorArguments& arguments) {
  if (!is_flight_record(arguments.log)) return report(output, arguments.joint, from_event_log(arguments));
  const FlightRecordInfo info = read_flight_record(arguments.log);
  const auto head = info.head.find("joint");
  const std::string joint = head == info.head.end() ? arguments.joint : head->second;
  report(output, joint, from_flight_record(arguments, joint, info.period_s));
}

}  // namespace strainwave
