// SPDX-License-Identifier: BSD-3-Clause
// What strainwavectl can do, one function per command. Each returns when it is done and throws ClientError
// (or InputError for a file's content) when it is not. None knows the command line. Not real-time.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "client/protocol/client.h"
#include "client/protocol/joint_path.h"
#include "client/protocol/motion.h"
#include "client/text/output.h"
#include "client/watch/watch_screen.h"
#include "drivers/injected_fault.h"
#include "lcmtypes/key_text.h"

namespace strainwave {

/// All joints as a table, or every field of one.
struct StatusArguments {
  std::optional<std::string> joint;
};
void show_status(Client& client, const Output& output, const StatusArguments& arguments);

/// The daemon's timing totals: real time or not, overruns, worst cases, refused messages.
void show_timing(Client& client, const Output& output);

/// Joints over time: on a terminal a full screen that also takes keys (client/watch/), otherwise (or plain) a
/// line for each joint at each interval.
void watch(Client& client, const Output& output, const WatchArguments& arguments);

/// Writes every message of the prefix, or of `joints` and the daemon as a whole, to an LCM event log.
struct RecordArguments {
  std::vector<std::string> joints;  ///< empty: all of the prefix
  std::filesystem::path file;
  std::optional<double> duration_s;  ///< nothing: until interrupted
  bool overwrite = false;
  bool mcap = false;  ///< an MCAP file instead of an LCM event log
};
void record(Client& client, const Output& output, const RecordArguments& arguments);

/// Decodes an LCM event log: a folder with one CSV file per channel, or one .csv with the states of all
/// joints, see state_csv.h.
struct ExportArguments {
  std::filesystem::path log;
  std::filesystem::path out;
  bool overwrite = false;
  bool mcap = false;  ///< one MCAP file instead, see text/mcap_log.h
};
void export_log(const Output& output, const ExportArguments& arguments);

/// Replays the setpoints of a log for `joint` with their timing, as new orders. They are signed with the key, for the present session. A
/// pause after a stream becomes a hold. An interrupt or a refusal holds the joint.
struct PlayArguments {
  std::filesystem::path log;
  std::string joint;
};
void play(Client& client, const Output& output, const PlayArguments& arguments);

/// Moves `joint` at steady speeds, each in both directions, and records everything for strainwave-design fit
/// --log. Limits are checked before anything moves. An interrupt, a fault, another order or too much torque ends it in a hold. So
/// does the end of this program, because the setpoints are a stream.
struct IdentifyArguments {
  std::string joint;
  std::filesystem::path file;
  std::optional<std::pair<double, double>>
      range_rad;  ///< nothing: 1 rad to either side, within the joint's limits
  double slowest_rad_s = 0.025;
  double fastest_rad_s = 0.0;           ///< 0: 80 % of the joint's limit
  int speeds = 12;                      ///< evenly spaced by ratio
  double steady_s = 4.0;                ///< longest time at one speed in one direction
  std::optional<double> max_torque_Nm;  ///< nothing: the joint's limit
  bool overwrite = false;
  bool dry_run = false;  ///< check and print the plan, move nothing
};
void identify(Client& client, const Output& output, const IdentifyArguments& arguments);

/// Names what is wrong with `joint`: from a test motion, or from a recording. Throws ClientError (refused) when it finds something, after it
/// has said what.
struct DoctorArguments {
  std::string joint;             ///< with a flight record empty: the record's
  std::filesystem::path log;     ///< an LCM event log or a flight record; empty: a test motion
  std::filesystem::path config;  ///< the daemon's file; empty: what it says is not judged
  double reach_rad = 0.5;        ///< of the test motion, to either side
  bool dry_run = false;          ///< say what the test motion would be, move nothing
};
void examine_joint(Client& client, const Output& output, const DoctorArguments& arguments);
void examine_log(const Output& output, const DoctorArguments& arguments);

/// Lets strainwaved measure `joint` and strainwave-design make its table: commission.json, friction.json, table.json, JOINT.toml and
/// report.html in `out`. What is there already is kept, but for the report. Throws ClientError that names the step that failed, and the
/// command that repeats it.
struct CommissionArguments {
  std::string joint;
  std::filesystem::path config;  ///< the daemon's file, which is not changed
  std::filesystem::path out;     ///< a folder, which is made
};
void commission(const Output& output, const CommissionArguments& arguments);

/// Draws a flight record (docs/flight-recorder.md) with gnuplot.
struct PlotRecordArguments {
  std::filesystem::path file;
  std::optional<std::filesystem::path> out;  ///< nothing: beside the file
  std::optional<double> around_s;            ///< nothing: the whole record
};
void plot_record(const Output& output, const PlotRecordArguments& arguments);

/// An order to each of `joints`, or when there are none to every joint of the prefix, one after the other. A failure of one does not keep
/// it from the others. The error names all failures and has the status of the worst.
using JointOrder = void (*)(Client& client, const Output& output, const std::string& joint);
void order_each(Client& client, const Output& output, const std::vector<std::string>& joints,
                JointOrder order);
/// A disable likewise: it is sent to every joint before any answer is waited for.
void disable(Client& client, const Output& output, const std::vector<std::string>& joints);

/// Orders to one joint. enable() returns once the joint holds. What is so already is no error, and nothing is sent for it.
void enable(Client& client, const Output& output, const std::string& joint);
void hold(Client& client, const Output& output, const std::string& joint);
void clear_fault(Client& client, const Output& output, const std::string& joint);
/// Returns once the joint holds, homed.
void home(Client& client, const Output& output, const std::string& joint);

/// Moves to `position_rad`; with `wait`, returns once the joint is within `tolerance_rad` of it and stays there.
struct MoveArguments {
  std::string joint;
  double position_rad = 0.0;
  bool wait = false;
  double speed_limit_rad_s = 0.0;  ///< 0: calmly
  double tolerance_rad = 1e-3;
};
void move(Client& client, const Output& output, const MoveArguments& arguments);

/// Several joints on a straight path: they leave and arrive together. Speeds within `speed_limit_rad_s` each.
struct MoveTogetherArguments {
  std::vector<JointTarget> targets;  ///< each joint once
  bool wait = false;
  double speed_limit_rad_s = 0.0;  ///< 0: a quarter of each joint's limit
  double tolerance_rad = 1e-3;
};
void move_together(Client& client, const Output& output, const MoveTogetherArguments& arguments);

/// Follows the path of a CSV file; every joint must hold at its first knot. With `wait` as above.
struct PathArguments {
  std::filesystem::path file;
  bool wait = false;
  double tolerance_rad = 1e-3;
};
void follow_path(Client& client, const Output& output, const PathArguments& arguments);
/// Its parts by joint, in the order in which the joints come first. Throws InputError that names the file.
std::vector<JointPath> read_path(const std::filesystem::path& file);

/// The path that `joint` is on, with all of its joints.
void pause_path(Client& client, const Output& output, const std::string& joint);
void resume_path(Client& client, const Output& output, const std::string& joint);

/// Offers a gain table to one joint, or to every joint of the prefix. A refusal by one does not keep it from
/// the others.
struct LoadTableArguments {
  std::optional<std::string> joint;
  std::filesystem::path file;
};
void load_table(Client& client, const Output& output, const LoadTableArguments& arguments);

/// Makes this user the owner of the joint, also where another client owns it. Needs the role engineer.
void take_over(Client& client, const Output& output, const std::string& joint);
/// Gives the joint up: it has no owner.
void release(Client& client, const Output& output, const std::string& joint);

/// What the joint has learned of its friction: a line for each temperature rule of its table.
void show_friction(Client& client, const Output& output, const std::string& joint);
/// Forgets it (kResetLearning), keeps it as it is (kFreezeLearning) or lets the joint learn again (kResumeLearning).
void order_learning(Client& client, const Output& output, const std::string& joint, Action action);

/// Uses the previous gain table again; an engineer's order, as loading one is.
void revert_table(Client& client, const Output& output, const std::string& joint);

/// Injects a fault into a simulated drive, or ends all of them (kNone).
struct InjectArguments {
  std::string joint;
  InjectedFault kind = InjectedFault::kNone;
  double amount = 0.0;
  double for_s = 0.0;  ///< 0: until ended
};
void inject(Client& client, const Output& output, const InjectArguments& arguments);
/// Throws ClientError (usage) that names what is allowed: no such kind, amount missing, needless or out of range.
InjectArguments parse_injection(const std::string& joint, const std::string& kind, double amount,
                                double for_s);

/// Prints every digital line of a daemon's configuration, its level and who holds it, without touching outputs. Throws when one
/// cannot be used. strainwaved does the work; it need not run.
void gpio_check(const Output& output, const std::filesystem::path& config);

/// Makes a key pair: the secret key in `out`, its public line in `out`.pub. Neither may exist.
struct KeygenArguments {
  std::filesystem::path out;
  Role role = Role::kOperator;
  std::optional<std::string> comment;  ///< nothing: user@host
};
void keygen(const Output& output, const KeygenArguments& arguments);

/// Who answers on a CAN bus; reads only.
void can_scan(const Output& output, const std::string& interface_name);
/// Runs the daemon's own start-up of the drives of `config`, without enabling any.
void can_check(const Output& output, const std::filesystem::path& config,
               const std::filesystem::path& data_sheet);

}  // namespace strainwave
