// SPDX-License-Identifier: BSD-3-Clause
#include "client/commands/identify_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "client/text/text.h"
#include "strainwave/client_error.h"

namespace strainwave {

namespace {

constexpr double kDefaultReach_rad = 1.0;
constexpr double kDefaultShareOfSpeed = 0.8;
constexpr double kApproachShare = 0.5;  // share of the fastest speed

[[noreturn]] void refuse(const std::string& what) {
  throw ClientError(ExitStatus::kUsage, "identify: " + what);
}

std::pair<double, double> checked_range(const IdentifyArguments& arguments, const limits_v1& limits,
                                        double position_rad) {
  const std::pair<double, double> widest{limits.position_min_rad, limits.position_max_rad};
  const auto [from, to] =
      arguments.range_rad.value_or(std::pair{std::max(widest.first, position_rad - kDefaultReach_rad),
                                             std::min(widest.second, position_rad + kDefaultReach_rad)});
  if (!std::isfinite(from) || !std::isfinite(to) || from >= to)
    refuse(fmt::format("--range_rad {} {}: the first position must be below the second", from, to));
  if (from < widest.first || to > widest.second)
    refuse(fmt::format("--range_rad {} {}: the joint's limits are {} to {} rad", from, to, widest.first,
                       widest.second));
  if (position_rad < from || position_rad > to)
    refuse(fmt::format("the joint is at {:.4f} rad, outside the range {} to {} rad: move it there first",
                       position_rad, from, to));
  return {from, to};
}

double checked_fastest(const IdentifyArguments& arguments, const limits_v1& limits) {
  const double fastest = arguments.fastest_rad_s > 0.0 ? arguments.fastest_rad_s
                                                       : kDefaultShareOfSpeed * limits.speed_limit_rad_s;
  if (fastest > limits.speed_limit_rad_s)
    refuse(
        fmt::format("--fastest_rad_s {}: the joint's limit is {} rad/s", fastest, limits.speed_limit_rad_s));
  if (arguments.slowest_rad_s >= fastest)
    refuse(fmt::format("--slowest_rad_s {}: must be below the fastest speed, {} rad/s",
                       arguments.slowest_rad_s, fastest));
  return fastest;
}

double checked_torque(const IdentifyArguments& arguments, const limits_v1& limits) {
  const double torque_Nm = arguments.max_torque_Nm.value_or(limits.torque_limit_Nm);
  if (torque_Nm > limits.torque_limit_Nm)
    refuse(fmt::format("--max-torque_Nm {}: the joint's limit is {} N.m", torque_Nm, limits.torque_limit_Nm));
  return torque_Nm;
}

}  // namespace

IdentifyPlan plan_identification(const IdentifyArguments& arguments, const limits_v1& limits,
                                 double position_rad) {
  IdentifyPlan plan;
  plan.range_rad = checked_range(arguments, limits, position_rad);
  plan.max_torque_Nm = checked_torque(arguments, limits);
  const double fastest = checked_fastest(arguments, limits);
  plan.approach_speed_rad_s = kApproachShare * fastest;
  const double width_rad = plan.range_rad.second - plan.range_rad.first;
  const double center_rad = 0.5 * (plan.range_rad.first + plan.range_rad.second);
  const double ratio = std::pow(fastest / arguments.slowest_rad_s, 1.0 / (arguments.speeds - 1));
  double at_rad = position_rad;
  for (int i = 0; i < arguments.speeds; ++i) {
    const double speed = i + 1 == arguments.speeds ? fastest : arguments.slowest_rad_s * std::pow(ratio, i);
    const double ramps_rad =
        0.5 * speed * speed * (1.0 / limits.acceleration_rad_s2 + 1.0 / limits.deceleration_rad_s2);
    const double length_rad = std::min(width_rad, ramps_rad + speed * arguments.steady_s);
    const double steady_s = (length_rad - ramps_rad) / speed;
    if (steady_s < std::min(kLeastSteady_s, arguments.steady_s)) {
      plan.left_out_rad_s.push_back(speed);
      continue;
    }
    const Sweep sweep{speed, center_rad - 0.5 * length_rad, center_rad + 0.5 * length_rad, steady_s};
    plan.duration_s +=
        std::abs(sweep.from_rad - at_rad) / plan.approach_speed_rad_s +
        2.0 * (steady_s + speed / limits.acceleration_rad_s2 + speed / limits.deceleration_rad_s2);
    at_rad = sweep.from_rad;
    plan.sweeps.push_back(sweep);
  }
  if (plan.sweeps.size() < kLeastSweeps)
    refuse(fmt::format(
        "only {} of {} speeds can be held for {} s within {} rad: give a longer --range_rad or a smaller "
        "--fastest_rad_s",
        plan.sweeps.size(), arguments.speeds, kLeastSteady_s, width_rad));
  return plan;
}

std::string to_text(const IdentifyPlan& plan) {
  std::string text;
  for (const Sweep& sweep : plan.sweeps)
    text += fmt::format("  {:8.4f} rad/s  {:+.3f} to {:+.3f} rad and back, {:.2f} s each way\n",
                        sweep.speed_rad_s, without_negative_zero(sweep.from_rad, 3),
                        without_negative_zero(sweep.to_rad, 3), sweep.steady_s);
  for (const double speed : plan.left_out_rad_s)
    text += fmt::format("  {:8.4f} rad/s  left out: the range is too short\n", speed);
  return text + fmt::format("  about {:.0f} s, between {:+.3f} and {:+.3f} rad, at most {:.1f} N.m\n",
                            plan.duration_s, without_negative_zero(plan.range_rad.first, 3),
                            without_negative_zero(plan.range_rad.second, 3), plan.max_torque_Nm);
}

std::string to_json(const IdentifyPlan& plan, const std::string& joint) {
  nlohmann::ordered_json json{{"joint", joint},
                              {"duration_s", plan.duration_s},
                              {"position_min_rad", plan.range_rad.first},
                              {"position_max_rad", plan.range_rad.second},
                              {"max_torque_Nm", plan.max_torque_Nm},
                              {"left_out_rad_s", plan.left_out_rad_s}};
  for (const Sweep& sweep : plan.sweeps)
    json["sweeps"].push_back({{"speed_rad_s", sweep.speed_rad_s},
                              {"from_rad", sweep.from_rad},
                              {"to_rad", sweep.to_rad},
                              {"steady_s", sweep.steady_s}});
  return json.dump();
}

}  // namespace strainwave
