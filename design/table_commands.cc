#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <optional>

#include "base/csv.h"
#include "base/input_error.h"
#include "base/printable.h"
#include "control/certificate.h"
#include "control/gain_table_json.h"
#include "design/commands.h"
#include "design/spring_proof.h"
#include "design/table_report.h"

namespace strainwave {

namespace {

struct VerifyOptions {
  std::string path;
  std::string gear;
  double motor_inertia_kgm2 = 0.0;
  std::string load_inertia_kgm2;  // "FROM..TO" or one number
  std::string damping_Nms_rad = "0";
  std::string delay_periods = "1";
};

BoxRange parse_range(const std::string& key, const std::string& text, double least) {
  const std::string place = "verify";
  const std::size_t dots = text.find("..");
  const double from = parse_number(text.substr(0, dots), place, key);
  const double to = dots == std::string::npos ? from : parse_number(text.substr(dots + 2), place, key);
  if (!(from >= least && from <= to))
    throw InputError(place, key, text, "must be FROM..TO, ascending, from " + number_text(least));
  return {from, to};
}

// What box of joints with a spring is meant; nothing when none is.
std::optional<SpringBox> spring_box_of(const VerifyOptions& options, const GainTable& table) {
  if (options.load_inertia_kgm2.empty()) return std::nullopt;
  constexpr double kLeastInertia_kgm2 = 1e-6;
  if (!(options.motor_inertia_kgm2 >= kLeastInertia_kgm2))
    throw InputError("verify", "--motor-inertia_kgm2", number_text(options.motor_inertia_kgm2),
                     "must be the inertia on the motor's side of the spring, at the joint");
  const std::string gear = options.gear.empty() ? std::string(table.plant.gear.view()) : options.gear;
  SpringBox box =
      spring_box(table.friction, gear, options.motor_inertia_kgm2,
                 parse_range("--load-inertia_kgm2", options.load_inertia_kgm2, kLeastInertia_kgm2));
  box.damping_Nms_rad = parse_range("--damping_Nms_rad", options.damping_Nms_rad, 0.0);
  return box;
}

// Every delay of the range has its own proof: a joint has one.
bool verify_spring(const SpringBox& box, const VerifyOptions& options, const GainTable& table) {
  const BoxRange delays = parse_range("--delay", options.delay_periods, 0.0);
  if (delays.to > kMaxSpringDelay)
    throw InputError("verify", "--delay", options.delay_periods,
                     "must be whole periods, at most " + std::to_string(kMaxSpringDelay));
  const std::vector<GainRow> gains = gains_of(table);
  bool certified = true;
  for (int delay = static_cast<int>(delays.from); delay <= static_cast<int>(delays.to); ++delay) {
    const SpringProof proof = prove_spring_box(gains, box, {table.plant.period_s, delay, 1.0});
    certified = certified && proof.outcome == SpringOutcome::kCertified;
    std::printf("with the spring, delay %d: %s\n", delay, describe(proof).c_str());
  }
  return certified;
}

int verify(const VerifyOptions& options) {
  const GainTable table = read_gain_table(options.path);
  const std::optional<SpringBox> box = spring_box_of(options, table);
  bool certified = true;
  for (const FeedbackGains* gains : {&table.primary, &table.fallback}) {
    const CertificateReport report = certify(*gains, table.plant, table.friction);
    certified = certified && report.certified;
    std::fputs(margins_text(*gains, report).c_str(), stdout);
  }
  if (box) certified = verify_spring(*box, options, table) && certified;
  std::printf("%s: %s\n", options.path.c_str(), certified ? "certified" : "NOT CERTIFIED");
  return certified ? 0 : 1;
}

}  // namespace

CommandBody add_verify_command(CLI::App& app, CLI::App*& command) {
  command = app.add_subcommand("verify", "Prove that a table's gains are stable; exit status 0 or 1");
  const auto options = std::make_shared<VerifyOptions>();
  command->add_option("TABLE", options->path, "gain table (JSON)")->required();
  CLI::Option* const load =
      command->add_option("--load-inertia_kgm2", options->load_inertia_kgm2,
                          "also on a joint whose gear is a spring, with links of FROM..TO behind it");
  CLI::Option* const motor = command->add_option("--motor-inertia_kgm2", options->motor_inertia_kgm2,
                                                 "its inertia before the spring, at the joint");
  load->needs(motor);
  motor->needs(load);
  command->add_option("--gear", options->gear, "its gear by its catalogue name (default: the table's)")
      ->needs(load);
  command
      ->add_option("--damping_Nms_rad", options->damping_Nms_rad,
                   "the spring's damping, FROM..TO or one number")
      ->needs(load)
      ->capture_default_str();
  command
      ->add_option("--delay", options->delay_periods,
                   "periods between a torque's computation and its effect, FROM..TO or one number")
      ->needs(load)
      ->capture_default_str();
  return [options] { return verify(*options); };
}

CommandBody add_show_command(CLI::App& app, CLI::App*& command) {
  command = app.add_subcommand("show", "Describe a table");
  const auto path = std::make_shared<std::string>();
  command->add_option("TABLE", *path, "gain table (JSON)")->required();
  return [path] {
    std::fputs(description(read_gain_table(*path)).c_str(), stdout);
    return 0;
  };
}

}  // namespace strainwave
