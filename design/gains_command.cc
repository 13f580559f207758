// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string_view>

#include "base/input_error.h"
#include "base/printable.h"
#include "control/joint/encoder_side.h"
#include "control/joint/gear_catalogue.h"
#include "control/joint/joint_catalogue.h"
#include "control/table/gain_table_json.h"
#include "design/commands.h"
#include "design/creation_time.h"
#include "design/friction/friction_file.h"
#include "design/gains/controller_design.h"
#include "design/joint_defaults.h"
#include "design/spring_design.h"
#include "design/table_report.h"

namespace strainwave {

namespace {

// The defaults are those of the joint of Zhao (2006), the first of the catalogue. Other values come from the gear.
struct GainsOptions {
  std::string friction;
  std::string rules_side = "joint";
  std::string out;
  std::string name;
  std::string controller = "C4";
  std::string joint_model;
  std::string gear;
  std::optional<double> inertia_kgm2;
  std::optional<double> rotor_inertia_kgm2;
  std::optional<double> gear_ratio;
  double period_s = 1e-3;
  std::string sampling = "zoh";
  std::optional<double> torque_limit_Nm;
  std::vector<double> weights{0.1, 1.0, 1e-4, 1e-6};
  std::vector<double> x0{0.0, 1.0, 0.0};
  std::vector<double> x0_box;
  double margin = 0.01;
  double decay_rate = 1.0;
  double max_torque_Nm = 0.0;
  double max_position_rad = 0.0;
  double max_velocity_rad_s = 0.0;
  double max_integral_rad_s = 0.0;
  std::string encoder_side = to_text(EncoderSide::kMotor);
  SpringOptions spring;
};

std::vector<std::string> gear_list() {
  std::vector<std::string> names;
  for (const Gear& gear : gear_catalogue()) names.push_back(gear.name);
  return names;
}

/// The requested gear, else that of the joint of Zhao (2006).
const Gear& gear_of(const GainsOptions& options) {
  return *find_gear(options.gear.empty() ? catalogue_joint().gear : options.gear);
}

/// The given ratio, else the gear's. Throws InputError if the requested gear has another ratio.
double ratio_of(const GainsOptions& options) {
  const Gear& gear = gear_of(options);
  if (!options.gear.empty() && options.gear_ratio.value_or(gear.ratio) != gear.ratio)
    throw InputError("gains", "--gear-ratio", number_text(*options.gear_ratio),
                     "must be that of " + gear.name + ", " + number_text(gear.ratio) + ", or left out");
  return options.gear_ratio.value_or(gear.ratio);
}

std::string model_of(const GainsOptions& options) {
  return options.joint_model.empty() ? usual_model(gear_of(options)) : options.joint_model;
}

std::vector<StateVector> initial_states(const GainsOptions& options) {
  if (options.x0_box.empty()) return {StateVector::Map(options.x0.data())};
  for (const double half_width : options.x0_box) {
    if (!(half_width >= 0.0)) throw InputError("gains: x0-box: half widths must not be negative");
  }
  return box_vertices(StateVector::Map(options.x0_box.data()));
}

struct RequestedJoint {
  FrictionRules rules;
  std::string note;
  std::optional<SpringRequest> spring;
  double inertia_kgm2 = 0.0;  ///< for which the gains are designed
};

// Takes the given friction, else the catalogue's, whose origin it prints.
void take_friction(const GainsOptions& options, RequestedJoint& joint) {
  if (!options.friction.empty()) {
    joint.rules = read_friction_rules(options.friction, ratio_of(options),
                                      options.rules_side == "motor" ? GearSide::kMotor : GearSide::kJoint);
    std::fputs(friction_doubt(joint.rules.friction, find_gear(options.gear)).c_str(), stderr);
    return;
  }
  if (options.gear.empty())
    throw InputError("gains: give --friction, or --gear with a gear of the catalogue: " + gear_names());
  const CatalogueFriction friction = catalogue_friction(gear_of(options), model_of(options));
  joint.rules = friction.rules;
  joint.note = friction.note;
  std::printf("--friction %s\n", friction.origin.c_str());
}

// The motor inertia. Prints its origin unless it is given at the joint. Throws InputError that asks for it.
BoxRange motor_inertia_kgm2(const GainsOptions& options) {
  if (const auto given = given_motor_inertia(options.spring, "gains")) return *given;
  const Gear& gear = gear_of(options);
  const std::string model = options.gear.empty() ? usual_model(gear) : model_of(options);
  const MotorInertia inertia = usual_motor_inertia("gains", &gear, model, options.rotor_inertia_kgm2);
  std::printf("--motor-inertia_kgm2 %g, %s\n", inertia.at_joint_kgm2, inertia.origin.c_str());
  return {inertia.at_joint_kgm2, inertia.at_joint_kgm2};
}

// Prints the values that come from the catalogue. Throws InputError that names the missing options.
RequestedJoint read_joint(const GainsOptions& options) {
  RequestedJoint joint;
  take_friction(options, joint);
  if (options.spring.given())
    joint.spring = spring_request(options.spring, "gains", motor_inertia_kgm2(options));
  if (options.inertia_kgm2) {
    joint.inertia_kgm2 = *options.inertia_kgm2;
  } else if (joint.spring) {
    const BoxRange& motor = joint.spring->motor_inertia_kgm2;
    joint.inertia_kgm2 = 0.5 * (motor.from + motor.to) + joint.spring->link_inertia_kgm2.to;
    std::printf("--inertia_kgm2 %g, motor and heaviest link\n", joint.inertia_kgm2);
  } else {
    joint.inertia_kgm2 = motor_inertia_kgm2(options).from;
  }
  return joint;
}

TableRequest make_request(const GainsOptions& options, const CLI::App& command, const RequestedJoint& joint) {
  const auto given = [&command](const char* name, double value) {
    return command.count(name) > 0 ? std::optional<double>(value) : std::nullopt;
  };
  TableRequest request;
  DesignRequest& design = request.design;
  design.plant.joint_model = std::string_view(model_of(options));
  design.plant.gear = std::string_view(options.gear);
  design.plant.inertia_kgm2 = joint.inertia_kgm2;
  design.plant.gear_ratio = ratio_of(options);
  design.plant.period_s = options.period_s;
  design.sampling = options.sampling == "zoh" ? Sampling::kZeroOrderHold : Sampling::kForwardEuler;
  design.weights = {options.weights[0], options.weights[1], options.weights[2], options.weights[3]};
  if (joint.spring && command.count("--weights") == 0)
    design.weights.torque = usual_torque_weight(gear_of(options), design.weights.torque);
  design.initial_states = initial_states(options);
  design.margin = options.margin;
  design.decay_rate = options.decay_rate;
  design.max_torque_Nm = given("--max-torque_Nm", options.max_torque_Nm);
  design.max_position_rad = given("--max-position_rad", options.max_position_rad);
  design.max_velocity_rad_s = given("--max-velocity_rad_s", options.max_velocity_rad_s);
  design.max_integral_rad_s = given("--max-integral_rad_s", options.max_integral_rad_s);
  request.encoder_side = encoder_side_from_text(options.encoder_side).value();
  request.torque_limit_Nm = options.torque_limit_Nm.value_or(gear_of(options).repeated_peak_torque_Nm);
  request.created_utc = utc_now();
  check_request(design);
  design.friction = joint.rules.friction;
  require_friction(design.friction, request.torque_limit_Nm,
                   options.friction.empty() ? options.gear : options.friction);
  request.friction_sha256 = joint.rules.sha256;
  request.note = joint.note;
  return request;
}

// Writes TABLE.json for one controller, or DIR/c1.json .. DIR/c4.json for all.
ExitStatus gains(const GainsOptions& options, const CLI::App& command) {
  const RequestedJoint joint = read_joint(options);
  TableRequest request = make_request(options, command, joint);
  std::vector<std::pair<std::filesystem::path, GainTable>> tables;
  for (const Controller controller : {Controller::kC1, Controller::kC2, Controller::kC3, Controller::kC4}) {
    if (options.controller != "all" && options.controller != name_of(controller)) continue;
    const std::string label = name_of(controller);
    request.name = options.name.empty() ? model_of(options) + " " + label : options.name;
    std::filesystem::path path = options.out;
    if (options.controller == "all") path /= "c" + label.substr(1) + ".json";
    if (!joint.spring) {
      tables.emplace_back(path, design_rigid(controller, request));
      continue;
    }
    const SpringDesign found =
        design_on_spring(controller, request, options.gear, *joint.spring,
                         [](const std::string& what) { std::fprintf(stderr, "trying %s\n", what.c_str()); });
    std::fputs(found.text.c_str(), stdout);
    tables.emplace_back(path, found.table);
  }
  for (const auto& [path, table] : tables) {
    write_gain_table(table, path);
    std::printf("%s: %s, %s; cost bound %.6g\n", path.c_str(),
                std::string(table.primary.controller.view()).c_str(),
                request.design.sampling == Sampling::kZeroOrderHold
                    ? "certified"
                    : "designed by forward Euler, for reproducing Zhao (2006) only",
                table.primary.cost_bound);
  }
  return ExitStatus::kDone;
}

void add_plant_options(CLI::App& command, GainsOptions& options) {
  command.add_option("--joint-model", options.joint_model,
                     "identity of the joint; the daemon compares it (default: the gear's name; rhs17-6006 "
                     "for csf-17-50)");
  command.add_option("--inertia_kgm2", options.inertia_kgm2,
                     "inertia at the joint side (default: the motor's, with --load-inertia_kgm2 also the "
                     "heaviest link's)");
  command
      .add_option("--gear", options.gear,
                  "the gear by its catalogue name (data/gears.csv); the daemon compares it where its joint "
                  "names one. With --friction alone the ratio is that of csf-17-50")
      ->check(CLI::IsMember(gear_list()));
  command
      .add_option(
          "--rotor-inertia_kgm2", options.rotor_inertia_kgm2,
          "the motor's own inertia at its shaft, from which --motor-inertia_kgm2 follows with the gear's "
          "wave generator and ratio")
      ->needs("--gear");
  command.add_option("--gear-ratio", options.gear_ratio, "reduction ratio (default: the gear's)");
  command.add_option("--period_s", options.period_s, "sample period")->capture_default_str();
  command
      .add_option("--sampling", options.sampling,
                  "the joint as the loop sees it (zoh), or the approximation of Zhao (2006) (euler): a "
                  "table for chapter 6, which the daemon refuses")
      ->check(CLI::IsMember({"euler", "zoh"}))
      ->capture_default_str();
  command
      .add_option("--encoder-side", options.encoder_side,
                  "where the joint's position is measured; the daemon compares it")
      ->check(CLI::IsMember({to_text(EncoderSide::kMotor), to_text(EncoderSide::kLink)}))
      ->capture_default_str();
  command.add_option("--torque-limit_Nm", options.torque_limit_Nm,
                     "largest torque at the joint side (default: the gear's repeated peak torque)");
}

void add_design_options(CLI::App& command, GainsOptions& options) {
  command.add_option("--weights", options.weights, "cost: integral,position,velocity,torque")
      ->delimiter(',')
      ->expected(4)
      ->capture_default_str();
  CLI::Option* const x0 =
      command.add_option("--x0", options.x0, "initial state: integral_rad_s,error_rad,velocity_rad_s")
          ->delimiter(',')
          ->expected(3)
          ->capture_default_str();
  command
      .add_option("--x0-box", options.x0_box, "initial states: every state of the box with these half widths")
      ->delimiter(',')
      ->expected(3)
      ->excludes(x0);
  command
      .add_option("--margin", options.margin,
                  "fraction by which weights and limits are tightened in the design")
      ->capture_default_str();
  command
      .add_option("--decay-rate", options.decay_rate,
                  "in the design the Lyapunov function falls by its square each sample; the certificate "
                  "promises no rate")
      ->capture_default_str();
  command.add_option("--max-torque_Nm", options.max_torque_Nm,
                     "bound on the feedback torque from --x0 (Theorem 2)");
  command.add_option("--max-position_rad", options.max_position_rad,
                     "bound on the position error from --x0 (Theorem 3)");
  command.add_option("--max-velocity_rad_s", options.max_velocity_rad_s,
                     "bound on the velocity from --x0 (Theorem 3)");
  command.add_option("--max-integral_rad_s", options.max_integral_rad_s,
                     "bound on the integral of the error from --x0 (Theorem 3)");
}

}  // namespace

void add_gains_command(CLI::App& program, CommandBody& chosen) {
  CLI::App* command = program.add_subcommand(
      "gains", "Design certified gains; the defaults are the RHS-17-6006 of Zhao (2006)");
  const auto options = std::make_shared<GainsOptions>();
  command->add_option("--friction", options->friction,
                      "fuzzy rules: JSON from fit, or CSV (default: those of --gear, by the catalogue)");
  command->add_option("--rules-side", options->rules_side, "side of the gear that a rules CSV is stated at")
      ->check(CLI::IsMember({"joint", "motor"}))
      ->capture_default_str();
  command->add_option("--controller", options->controller, "C1, C2, C3, C4 or all")
      ->check(CLI::IsMember({"C1", "C2", "C3", "C4", "all"}))
      ->capture_default_str();
  add_plant_options(*command, *options);
  add_design_options(*command, *options);
  add_spring_options(*command, options->spring);
  command->get_option("--rotor-inertia_kgm2")->excludes("--motor-inertia_kgm2");
  command->add_option("--name", options->name, "name of the table; default: joint model and controller");
  command
      ->add_option("--out", options->out,
                   "table to write; with --controller all the folder for c1.json .. c4.json")
      ->required();
  command->callback(
      [&chosen, options, command] { chosen = [options, command] { return gains(*options, *command); }; });
}

}  // namespace strainwave
