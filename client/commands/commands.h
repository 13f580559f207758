// SPDX-License-Identifier: BSD-3-Clause
// The commands of strainwavectl, one function each. Each returns when it is done. On failure it throws
// ClientError, or InputError for the content of a file. No command knows the command line. Not real-time.
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

/// Shows all joints as a table, or every field of one joint.
struct StatusArguments {
  std::optional<std::string> joint;
};
void show_status(Client& client, const Output& output, const StatusArguments& arguments);

/// Shows the timing totals of the daemon: real time or not, overruns, worst cases, refused messages.
void show_timing(Client& client, const Output& output);

/// Shows joints over time. On a terminal it is a full screen that also takes keys (client/watch/). Otherwise,
/// or if plain, it prints a line for each joint at each interval.
void watch(Client& client, const Output& output, const WatchArguments& arguments);

/// Writes every message of the prefix to an LCM event log, or only those of `joints` and of the daemon.
struct RecordArguments {
  std::vector<std::string> joints;  ///< empty: all joints of the prefix
  std::filesystem::path file;
  std::optional<double> duration_s;  ///< no value: until interrupted
  bool overwrite = false;
  bool mcap = false;  ///< an MCAP file instead of an LCM event log
};
void record(Client& client, const Output& output, const RecordArguments& arguments);

/// Decodes an LCM event log into a folder with one CSV file per channel, or into one .csv with the states of
/// all joints (see state_csv.h).
struct ExportArguments {
  std::filesystem::path log;
  std::filesystem::path out;
  bool overwrite = false;
  bool mcap = false;  ///< one MCAP file instead, see text/mcap_log.h
};
void export_log(const Output& output, const ExportArguments& arguments);

/// Replays the setpoints of a log for `joint` with their timing, as new orders. They are signed with the key,
/// for the present session. A pause after a stream becomes a hold. An interrupt or a refusal holds the joint.
struct PlayArguments {
  std::filesystem::path log;
  std::string joint;
};
void play(Client& client, const Output& output, const PlayArguments& arguments);

/// Moves `joint` at steady speeds, each in both directions, and records everything for strainwave-design fit
/// --log. It checks the limits before anything moves. An interrupt, a fault, another order or too much torque
/// ends the motion in a hold. The end of this program does so, too, because the setpoints are a stream.
struct IdentifyArguments {
  std::string joint;
  std::filesystem::path file;
  std::optional<std::pair<double, double>>
      range_rad;  ///< no value: 1 rad to either side, within the joint's limits
  double slowest_rad_s = 0.025;
  double fastest_rad_s = 0.0;           ///< 0: 80 % of the joint's limit
  int speeds = 12;                      ///< in geometric steps from the slowest to the fastest
  double steady_s = 4.0;                ///< longest time at one speed in one direction
  std::optional<double> max_torque_Nm;  ///< no value: the joint's limit
  bool overwrite = false;
  bool dry_run = false;  ///< check and print the plan, move nothing
};
void identify(Client& client, const Output& output, const IdentifyArguments& arguments);

/// Names the faults of `joint`, from a test motion or from a recording. Throws ClientError (refused) when it
/// finds one, after it has printed the findings.
struct DoctorArguments {
  std::string joint;             ///< empty with a flight record: the joint of the record
  std::filesystem::path log;     ///< an LCM event log or a flight record; empty: a test motion
  std::filesystem::path config;  ///< the daemon's file; empty: the doctor does not judge the configuration
  double reach_rad = 0.5;        ///< reach of the test motion, to either side
  bool dry_run = false;          ///< print the plan of the test motion, move nothing
};
void examine_joint(Client& client, const Output& output, const DoctorArguments& arguments);
void examine_log(const Output& output, const DoctorArguments& arguments);

/// Has strainwaved measure `joint` and strainwave-design make its table. `out` then holds commission.json,
/// friction.json, table.json, JOINT.toml and report.html. Existing files are kept, except the report. Throws
/// ClientError that names the failed step and the command that repeats it.
struct CommissionArguments {
  std::string joint;
  std::filesystem::path config;  ///< the daemon's file, which is not changed
  std::filesystem::path out;     ///< a folder, created if missing
};
void commission(const Output& output, const CommissionArguments& arguments);

/// Draws a flight record (docs/flight-recorder.md) with gnuplot.
struct PlotRecordArguments {
  std::filesystem::path file;
  std::optional<std::filesystem::path> out;  ///< no value: beside the file
  std::optional<double> around_s;            ///< no value: the whole record
};
void plot_record(const Output& output, const PlotRecordArguments& arguments);

/// Gives an order to each of `joints` in turn, or to every joint of the prefix if `joints` is empty. A failure of
/// one joint does not stop the others. The error names all failures and has the status of the worst.
using JointOrder = void (*)(Client& client, const Output& output, const std::string& joint);
void order_each(Client& client, const Output& output, const std::vector<std::string>& joints,
                JointOrder order);
/// Disables several joints: it sends the order to every joint before it waits for any answer.
void disable(Client& client, const Output& output, const std::vector<std::string>& joints);

/// Orders to one joint. enable() returns once the joint holds. If the joint is already in the wanted state, nothing is sent and there is no error.
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
  double speed_limit_rad_s = 0.0;  ///< 0: a calm default
  double tolerance_rad = 1e-3;
};
void move(Client& client, const Output& output, const MoveArguments& arguments);

/// Moves several joints on a straight path: they leave and arrive together. Each joint stays within `speed_limit_rad_s`.
struct MoveTogetherArguments {
  std::vector<JointTarget> targets;  ///< each joint once
  bool wait = false;
  double speed_limit_rad_s = 0.0;  ///< 0: a quarter of each joint's limit
  double tolerance_rad = 1e-3;
};
void move_together(Client& client, const Output& output, const MoveTogetherArguments& arguments);

/// Follows the path of a CSV file. Every joint must hold at its first knot. `wait` is as in MoveArguments.
struct PathArguments {
  std::filesystem::path file;
  bool wait = false;
  double tolerance_rad = 1e-3;
};
void follow_path(Client& client, const Output& output, const PathArguments& arguments);
/// Reads the path's parts by joint, in the order in which the joints appear. Throws InputError that names the file.
std::vector<JointPath> read_path(const std::filesystem::path& file);

/// Pauses or resumes the path that `joint` is on, with all of its joints.
void pause_path(Client& client, const Output& output, const std::string& joint);
void resume_path(Client& client, const Output& output, const std::string& joint);

/// Offers a gain table to one joint, or to every joint of the prefix. A refusal by one joint does not stop
/// the others.
struct LoadTableArguments {
  std::optional<std::string> joint;
  std::filesystem::path file;
};
void load_table(Client& client, const Output& output, const LoadTableArguments& arguments);

/// Makes this user the owner of the joint, even if another client owns it. Needs the role engineer.
void take_over(Client& client, const Output& output, const std::string& joint);
/// Gives up the ownership of the joint, which then has no owner.
void release(Client& client, const Output& output, const std::string& joint);

/// Shows the learned friction of the joint: a line for each temperature rule of its table.
void show_friction(Client& client, const Output& output, const std::string& joint);
/// Forgets the learned friction (kResetLearning), freezes it (kFreezeLearning) or lets learning go on (kResumeLearning).
void order_learning(Client& client, const Output& output, const std::string& joint, Action action);

/// Uses the previous gain table again. Like loading a table, this needs the role engineer.
void revert_table(Client& client, const Output& output, const std::string& joint);

/// Injects a fault into a simulated drive, or ends all of them (kNone).
struct InjectArguments {
  std::string joint;
  InjectedFault kind = InjectedFault::kNone;
  double amount = 0.0;
  double for_s = 0.0;  ///< 0: until the fault is ended
};
void inject(Client& client, const Output& output, const InjectArguments& arguments);
/// Throws ClientError (usage) that names the allowed values: unknown kind, or amount missing, not allowed or out of range.
InjectArguments parse_injection(const std::string& joint, const std::string& kind, double amount,
                                double for_s);

/// Prints every digital line of a daemon's configuration, its level and its holder, without touching outputs.
/// Throws when a line cannot be used. strainwaved does the work; no daemon has to run.
void gpio_check(const Output& output, const std::filesystem::path& config);

/// Makes a key pair: the secret key in `out`, its public line in `out`.pub. Neither file may exist.
struct KeygenArguments {
  std::filesystem::path out;
  Role role = Role::kOperator;
  std::optional<std::string> comment;  ///< no value: user@host
};
void keygen(const Output& output, const KeygenArguments& arguments);

/// Lists the nodes that answer on a CAN bus. It only reads.
void can_scan(const Output& output, const std::string& interface_name);
/// Runs the daemon's start-up of the drives of `config`, without enabling any.
void can_check(const Output& output, const std::filesystem::path& config,
               const std::filesystem::path& data_sheet);

}  // namespace strainwave
