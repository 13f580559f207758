// SPDX-License-Identifier: BSD-3-Clause
// commission: strainwaved measures and strainwave-design designs. The results become a configuration and a report.
#include <fmt/format.h>

#include <optional>

#include "base/printable.h"
#include "base/text_file.h"
#include "client/commands/commands.h"
#include "client/commands/commission_design.h"
#include "client/commands/sibling_program.h"
#include "client/protocol/interrupt.h"
#include "commission/report.h"
#include "control/table/gain_table_json.h"
#include "strainwave/client_error.h"

namespace strainwave {

namespace {

constexpr int kCurvePoints = 60;
constexpr double kCurveReach = 1.1;  // multiple of the fastest measured speed

std::string command_line(const std::string& program, const std::vector<std::string>& arguments) {
  std::string line = program;
  for (const std::string& argument : arguments) line += " " + shell_word(argument);
  return line;
}

/// The steps of one commissioning. Each step may end it.
class CommissionRun {
 public:
  CommissionRun(const Output& output, const CommissionArguments& arguments)
      : output_(output),
        arguments_(arguments),
        joint_(read_joint_to_design(arguments.config, arguments.joint)) {}

  void run() {
    measure();
    design_friction();
    design_table();
    write_configuration();
    run_program("checking the configuration", "strainwaved",
                {"--config", configuration().string(), "--check"});
    write_report();
    say(output_,
        fmt::format("{}: commissioned; see {}. The first motion, with the emergency stop at hand:\n{}",
                    arguments_.joint, file("report.html").string(), first_motion()),
        {{"joint", arguments_.joint},
         {"config", configuration().string()},
         {"table", file("table.json").string()},
         {"report", file("report.html").string()}});
  }

 private:
  std::filesystem::path file(const std::string& name) const { return arguments_.out / name; }
  std::filesystem::path configuration() const { return file(arguments_.joint + ".toml"); }

  std::string first_motion() const {
    return fmt::format(
        "  strainwaved --config {0} &\n  strainwavectl {3}enable {1}\n  strainwavectl {3}move {1} {2:.4g} "
        "--speed-limit_rad_s 0.1 --wait",
        shell_word(configuration().string()), shell_word(arguments_.joint), joint_.first_target_rad,
        joint_.prefix == ClientOptions().prefix ? "" : "--prefix " + shell_word(joint_.prefix) + " ");
  }

  /// The command to type after a failed step. After a failed measurement it is the whole commission command, which continues measuring.
  std::string repeated(const std::string& program, const std::vector<std::string>& arguments) const {
    if (arguments.front() != "--commission") return command_line(program, arguments);
    return command_line("strainwavectl", {"commission", arguments_.joint, "--config",
                                          arguments_.config.string(), "--out", arguments_.out.string()});
  }

  /// Returns the printed text, if captured. Without JSON, the text also goes to the output.
  std::string run_program(const std::string& step, const std::string& program,
                          const std::vector<std::string>& arguments, bool captured = false) {
    if (!output_.json) output_.stream << "-- " << step << '\n';
    output_.stream.flush();
    std::string printed;
    const bool capture = captured || output_.json;
    const int status = run_sibling(program, arguments, capture ? &printed : nullptr);
    if (captured && !output_.json) output_.stream << printed;
    if (interrupted() || status == static_cast<int>(ExitStatus::kInterrupted))
      throw ClientError(
          ExitStatus::kInterrupted,
          fmt::format("{}: stopped while {}; repeat the command to go on", arguments_.joint, step));
    if (status != 0)
      throw ClientError(ExitStatus::kRefused,
                        fmt::format("{}: {} failed{}{}; to repeat it: {}", arguments_.joint, step,
                                    output_.json ? ": " : ", see above", output_.json ? printed : "",
                                    repeated(program, arguments)),
                        {arguments_.joint, {}, {}, {}, {}});
    return printed;
  }

  /// Returns whether `path` has to be made. If it exists, prints that it is kept.
  bool is_missing(const std::filesystem::path& path) {
    if (!std::filesystem::exists(path)) return true;
    if (!output_.json)
      output_.stream << path.string() << ": kept; to make it anew, delete it and repeat the command\n";
    return false;
  }

  /// Refuses a folder that holds the design of another joint, or of an older measurement.
  void require_own_folder() const {
    const std::optional<CommissionRecord> before = read_commission_record(arguments_.out);
    const auto refuse = [&](const std::filesystem::path& path, const std::string& what) {
      throw ClientError(ExitStatus::kRefused, path.string() + ": " + what,
                        {arguments_.joint, {}, {}, {}, {}});
    };
    if (before && before->joint != arguments_.joint)
      refuse(file("commission.json"),
             "belongs to joint " + before->joint + ": name another folder with --out");
    if (std::filesystem::exists(configuration()) &&
        std::filesystem::equivalent(configuration(), arguments_.config))
      refuse(configuration(), "would be overwritten: name another folder with --out");
    if (before && before->configuration_text == read_text_file(arguments_.config)) return;
    for (const std::filesystem::path& made : {file("friction.json"), file("table.json"), configuration()})
      if (std::filesystem::exists(made))
        refuse(made,
               "belongs to an earlier measurement, and the joint must be measured again: delete it, or name "
               "another folder with --out");
  }

  void measure() {
    require_own_folder();
    try {
      run_program("measuring", "strainwaved",
                  {"--commission", arguments_.joint, "--config", arguments_.config.string(), "--out",
                   arguments_.out.string()});
    } catch (const ClientError&) {
      // The report of the measured values explains the failure.
      record_ = read_commission_record(arguments_.out);
      if (record_) write_report();
      throw;
    }
    record_ = read_commission_record(arguments_.out);
    if (!record_) throw ClientError(ExitStatus::kRefused, file("commission.json").string() + ": is missing");
  }

  void design_friction() {
    if (!is_missing(file("friction.json"))) return;
    run_program("fitting friction", "strainwave-design",
                {"fit", "--record", file("commission.json").string(), "--gear", joint_.gear, "--joint-model",
                 joint_.joint_model, "--out", file("friction.json").string()});
  }

  void design_table() {
    if (is_missing(file("table.json")))
      run_program("designing gains", "strainwave-design",
                  gains_arguments(*record_, joint_, file("friction.json"), file("table.json")));
    certificate_ =
        run_program("verifying", "strainwave-design", {"verify", file("table.json").string()}, true);
  }

  void write_configuration() {
    if (!is_missing(configuration())) return;
    const std::filesystem::path from = std::filesystem::absolute(arguments_.config).parent_path();
    const std::filesystem::path to = std::filesystem::absolute(arguments_.out);
    const std::string moved = with_moved_paths(read_text_file(arguments_.config),
                                               std::filesystem::proximate(from, to).string() + "/");
    write_text_file(configuration(),
                    with_settings(moved, arguments_.joint, measured_settings(*record_, joint_, "table.json"),
                                  arguments_.config.string()));
  }

  /// Friction of the table over speed, if the record and the table exist. Empty otherwise.
  std::vector<FrictionAtSpeed> table_friction() const {
    if (record_->friction.empty() || !std::filesystem::exists(file("table.json"))) return {};
    const FuzzyFriction friction = read_gain_table(file("table.json")).friction;
    const FrictionAtSpeed& fastest = record_->friction.back();
    const FrictionParameters here = friction.blend(friction.weights(fastest.temperature_C));
    std::vector<FrictionAtSpeed> curve;
    for (int i = 1; i <= kCurvePoints; ++i) {
      const double speed_rad_s = kCurveReach * fastest.speed_rad_s * i / kCurvePoints;
      curve.push_back({speed_rad_s,
                       fastest.temperature_C,
                       {stribeck_friction_Nm(here, friction.velocity.stribeck(), speed_rad_s), 0.0}});
    }
    return curve;
  }

  void write_report() const {
    write_text_file(file("report.html"), to_html(*record_, {table_friction(), certificate_,
                                                            certificate_.empty() ? "" : first_motion()}));
  }

  const Output& output_;
  const CommissionArguments& arguments_;
  JointToDesign joint_;
  std::optional<CommissionRecord> record_;
  std::string certificate_;
};

}  // namespace

void commission(const Output& output, const CommissionArguments& arguments) {
  CommissionRun(output, arguments).run();
}

}  // namespace strainwave
