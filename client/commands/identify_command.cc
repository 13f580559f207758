// SPDX-License-Identifier: BSD-3-Clause
// identify: steady speeds in both directions, recorded.
#include <fmt/format.h>

#include <cmath>
#include <strainwave/setpoint_v1.hpp>

#include "client/commands/commands.h"
#include "client/commands/guarded_motion.h"
#include "client/commands/identify_plan.h"
#include "client/protocol/event_log_writer.h"
#include "client/protocol/orders.h"
#include "client/protocol/published_limits.h"
#include "client/text/text.h"
#include "strainwave/client_error.h"

namespace strainwave {

namespace {

// The stream ends by itself this soon after the program does.
constexpr double kValidFor_s = 0.5;
constexpr double kRenewEvery_s = 0.1;
// Beyond the time that a leg should take.
constexpr double kPatience_s = 5.0;

class Identification {
 public:
  Identification(Client& client, const std::string& joint, const IdentifyPlan& plan)
      : client_(client), joint_(joint), plan_(plan), guarded_(client, joint, "end its motion") {}

  /// All sweeps; `report` is called after each.
  void run(const std::function<void(const Sweep&)>& report) {
    for (const Sweep& sweep : plan_.sweeps) {
      leg(sweep.from_rad, plan_.approach_speed_rad_s);
      leg(sweep.to_rad, sweep.speed_rad_s);
      leg(sweep.from_rad, sweep.speed_rad_s);
      report(sweep);
    }
  }

 private:
  const state_v1& state() const { return client_.find(joint_)->state; }

  /// There at this speed, and at rest.
  void leg(double target_rad, double speed_rad_s) {
    setpoint_v1 setpoint{};
    setpoint.position_rad = target_rad;
    setpoint.valid_for_s = kValidFor_s;
    setpoint.speed_limit_rad_s = speed_rad_s;
    setpoint.stream_id = client_.new_stream();
    begin(setpoint);
    const double expected_s = std::abs(target_rad - state().joint_position_rad) / speed_rad_s;
    const Deadline late(expected_s + kPatience_s);
    const Deadline old_states(kOldStates_s);
    while (!arrived(target_rad)) {
      client_.send(joint_, channel_kind::kSetpoint, setpoint);
      const Deadline renewal(kRenewEvery_s);
      while (!renewal.passed() && !arrived(target_rad)) {
        client_.wait_until([] { return false; }, Deadline(0.01));
        check(old_states.passed() ? std::optional(target_rad) : std::nullopt);
      }
      if (late.passed())
        throw ClientError(ExitStatus::kRefused, fmt::format("{}: not at {:.4f} rad after {:.1f} s", joint_,
                                                            target_rad, expected_s + kPatience_s));
    }
  }

  /// A stream begins with a setpoint that is answered, so that it cannot be lost.
  void begin(setpoint_v1 setpoint) {
    setpoint.begins_stream = 1;
    setpoint.approach = 1;
    setpoint.acknowledge = 1;
    require_accepted(client_.request(joint_, channel_kind::kSetpoint, setpoint), joint_, "a setpoint");
    guarded_.accepted();
  }

  bool arrived(double target_rad) const {
    return state().setpoint_position_rad == target_rad && state().setpoint_velocity_rad_s == 0.0;
  }

  void check(std::optional<double> target_rad) {
    guarded_.require_undisturbed();
    if (target_rad && state().target_position_rad != *target_rad)
      throw ClientError(ExitStatus::kRefused, joint_ + ": another order replaced this one's");
    const double torque_Nm = std::abs(state().torque_applied_Nm);
    if (torque_Nm > plan_.max_torque_Nm)
      throw ClientError(ExitStatus::kRefused,
                        fmt::format("{}: {:.1f} N.m exceed the {:.1f} N.m that were allowed", joint_,
                                    torque_Nm, plan_.max_torque_Nm));
  }

  Client& client_;
  std::string joint_;
  const IdentifyPlan& plan_;
  GuardedJoint guarded_;
};

void require_ready(const JointView& view, const std::string& joint) {
  const auto mode = static_cast<Mode>(view.state.mode);
  if (mode != Mode::kHolding)
    throw ClientError(ExitStatus::kRefused,
                      fmt::format("{}: is {}, not holding: strainwavectl enable {}, or hold {}", joint,
                                  to_text(mode), joint, joint));
  const auto status = static_cast<TemperatureStatus>(view.state.temperature_status);
  if (status != TemperatureStatus::kValid)
    throw ClientError(ExitStatus::kRefused,
                      fmt::format("{}: its temperature is not known ({}), and friction means nothing without",
                                  joint, to_text(status)));
}

/// The log should begin with the limits, which the fit needs: they come once a second.
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
    Identification(client, joint, plan).run([&](const Sweep& sweep) {
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
  say(output, fmt::format("{0}: now strainwave-design fit --log {0}", arguments.file.string()),
      {{"joint", joint}, {"file", arguments.file.string()}});
}

}  // namespace strainwave
