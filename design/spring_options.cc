// SPDX-License-Identifier: BSD-3-Clause
#include "design/spring_options.h"

#include <CLI/CLI.hpp>

#include "base/csv.h"
#include "base/input_error.h"
#include "base/printable.h"

namespace strainwave {

namespace {

constexpr double kLeastInertia_kgm2 = 1e-6;
constexpr double kLeastStiffness_Nm_rad = 1.0;

BoxRange parse_range(const std::string& place, const std::string& key, const std::string& text,
                     double least) {
  const std::size_t dots = text.find("..");
  const double from = parse_number(text.substr(0, dots), place, key);
  const double to = dots == std::string::npos ? from : parse_number(text.substr(dots + 2), place, key);
  if (!(from >= least && from <= to))
    throw InputError(place, key, text,
                     "must be FROM..TO, ascending, or one number, of at least " + number_text(least));
  return {from, to};
}

// "2..3kg@0.4m": point masses at this distance from the joint's axis. Without kg@ the text is an inertia.
BoxRange parse_load(const std::string& place, const std::string& key, const std::string& text) {
  if (text.find_first_of("kg@") == std::string::npos)
    return parse_range(place, key, text, kLeastInertia_kgm2);
  const std::size_t at = text.find("kg@");
  if (at == std::string::npos || !text.ends_with("m"))
    throw InputError(place, key, text, "must be MASSkg@RADIUSm, such as 3kg@0.4m");
  const BoxRange mass_kg = parse_range(place, key, text.substr(0, at), 0.0);
  const double radius_m = parse_number(text.substr(at + 3, text.size() - at - 4), place, key);
  const BoxRange load{mass_kg.from * radius_m * radius_m, mass_kg.to * radius_m * radius_m};
  if (!(load.from >= kLeastInertia_kgm2 && radius_m > 0.0))
    throw InputError(place, key, text, "mass and radius must be above 0");
  return load;
}

}  // namespace

void add_spring_options(CLI::App& command, SpringOptions& options) {
  CLI::Option* const load =
      command.add_option("--load-inertia_kgm2,--load", options.load_inertia_kgm2,
                         "inertia of the link, which makes the joint flexible: FROM..TO, one number, or a "
                         "mass at a radius, such as 3kg@0.4m");
  command
      .add_option(
          "--motor-inertia_kgm2", options.motor_inertia_kgm2,
          "inertia of the motor at the joint, before the spring: FROM..TO, or one number, which gains widens "
          "by 5 or 2 % to both sides if possible (default: of the catalogue's actuator with the gear)")
      ->needs(load);
  command
      .add_option("--stiffness_Nm_rad", options.stiffness_Nm_rad,
                  "measured first slope of the spring, FROM..TO or one number; the gear's other slopes scale "
                  "with it (default: the gear's)")
      ->needs(load);
  command
      .add_option("--damping_Nms_rad", options.damping_Nms_rad,
                  "the spring's damping, FROM..TO or one number")
      ->needs(load)
      ->capture_default_str();
  command
      .add_option("--delay", options.delay_periods,
                  "periods between a torque's computation and its effect, FROM..TO or one number")
      ->needs(load)
      ->capture_default_str();
}

std::optional<BoxRange> given_motor_inertia(const SpringOptions& options, const std::string& place) {
  if (options.motor_inertia_kgm2.empty()) return std::nullopt;
  return parse_range(place, "--motor-inertia_kgm2", options.motor_inertia_kgm2, kLeastInertia_kgm2);
}

SpringRequest spring_request(const SpringOptions& options, const std::string& place,
                             const BoxRange& motor_inertia_kgm2) {
  SpringRequest request;
  request.motor_inertia_kgm2 = motor_inertia_kgm2;
  request.link_inertia_kgm2 = parse_load(place, "--load-inertia_kgm2", options.load_inertia_kgm2);
  if (!options.stiffness_Nm_rad.empty())
    request.stiffness_1_Nm_rad =
        parse_range(place, "--stiffness_Nm_rad", options.stiffness_Nm_rad, kLeastStiffness_Nm_rad);
  request.damping_Nms_rad = parse_range(place, "--damping_Nms_rad", options.damping_Nms_rad, 0.0);
  const BoxRange delays = parse_range(place, "--delay", options.delay_periods, 0.0);
  request.least_delay = static_cast<int>(delays.from);
  request.most_delay = static_cast<int>(delays.to);
  if (delays.to > kMaxBoxDelay || delays.from != request.least_delay || delays.to != request.most_delay)
    throw InputError(place, "--delay", options.delay_periods,
                     "must be whole periods, at most " + std::to_string(kMaxBoxDelay));
  return request;
}

}  // namespace strainwave
