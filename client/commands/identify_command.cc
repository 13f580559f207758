// SPDX-License-Identifier: BSD-3-Clause
// identify: moves at steady speeds in both directions and records them.
#include <fmt/format.h>

#include <functional>

#include "client/commands/commands.h"
#include "client/commands/guarded_motion.h"
#include "client/commands/guarded_strokes.h"
#include "client/commands/identify_plan.h"
#include "client/protocol/event_log_writer.h"
#include "client/protocol/published_limits.h"
#include "client/text/text.h"
#include "strainwave/client_error.h"

namespace strainwave {

namespace {

/// Runs all sweeps of `plan` and calls `report` after each.
void run_sweeps(Client& client, const std::string& joint, const IdentifyPlan& plan,
                const std::function<void(const Sweep&)>& report) {
  GuardedStrokes strokes(client, joint, plan.max_torque_Nm);
  for (const Sweep& sweep : plan.sweeps) {
    strokes.go(sweep.from_rad, plan.approach_speed_rad_s);
    strokes.go(sweep.to_rad, sweep.speed_rad_s);
    strokes.go(sweep.from_rad, sweep.speed_rad_s);
    report(sweep);
  }
}

void require_ready(const JointView& view, const std::string& joint) {
  require_holding(view, joint);
  const auto status = static_cast<TemperatureStatus>(view.state.temperature_status);
  if (status != TemperatureStatus::kValid)
    throw ClientError(
        ExitStatus::kRefused,
        fmt::format("{}: its temperature is not known ({}), and friction depends on it: connect the sensor",
                    joint, to_text(status)));
}

/// The log should begin with the limits, which the fit needs. The daemon publishes them once a second.
void wait_for_limits_in(Client& client, const EventLogWriter& log, const std::string& joint) {
  const std::string name = channel(client.options().prefix, joint, channel_kind::kLimits);
  client.wait_until([&] { return log.counts().contains(name); }, Deadline(client.options().timeout_s));
}

}  // namespace

void identify(Client& client, const Output& output, const IdentifyArguments& arguments) {
  const std::string& joint = arguments.joint;
  const JointView& view = client.wait_for_joint(joint);
  const limits_v1 limits = PublishedLimits(client, {joint}).wait_for(joint);
  const IdentifyPlan plan = plan_identification(arguments, limits, view.state.joint_position_rad);
  if (output.json)
    output.stream << to_json(plan, joint) << '\n';
  else
    output.stream << fmt::format("{} at {} degC:\n{}", joint, temperature_text(view.state.temperature_used_C),
                                 to_text(plan));
  output.stream.flush();
  if (arguments.dry_run) return;
  require_ready(view, joint);
  EventLogWriter log(client.connection(), client.options().prefix, {joint}, arguments.file,
                     arguments.overwrite);
  wait_for_limits_in(client, log, joint);
  run_guarded(client, joint, [&] {
    run_sweeps(client, joint, plan, [&](const Sweep& sweep) {
      say(output,
          fmt::format("{}: {:.4f} rad/s done, {} degC", joint, sweep.speed_rad_s,
                      temperature_text(view.state.temperature_used_C)),
          {{"joint", joint},
           {"speed_rad_s", sweep.speed_rad_s},
           {"temperature_used_C", view.state.temperature_used_C}});
      output.stream.flush();
    });
  });
  hold(client, output, joint);
  log.finish();
  say(output,
      fmt::format("{0}: next: strainwave-design fit --log {0} --prior FRICTION.json --out NEW.json",
                  arguments.file.string()),
      {{"joint", joint}, {"file", arguments.file.string()}});
}

}  // namespace strainwave
