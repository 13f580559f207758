// What strainwavectl can do, one function per command. Each returns when it is done and throws ClientError
// (or InputError for a file's content) when it is not. None knows the command line. Not real-time.
#pragma once

#include <filesystem>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "client/client.h"
#include "lcmtypes/key_text.h"

namespace strainwave {

/// Where a command writes what it found; errors travel as exceptions.
struct Output {
  std::ostream& stream;
  bool terminal = false;  ///< a person looks at it: lines may be rewritten in place
};

/// All joints as a table, or every field of one.
struct StatusArguments {
  std::optional<std::string> joint;
  bool json = false;
};
void show_status(Client& client, const Output& output, const StatusArguments& arguments);

/// The daemon's timing totals: real time or not, overruns, worst cases, refused messages.
void show_timing(Client& client, const Output& output);

/// Joints over time: on a terminal one line each, rewritten in place; otherwise (or plain) a new line each
/// interval.
struct WatchArguments {
  std::vector<std::string> joints;  ///< empty: all of the prefix
  double interval_s = 0.2;
  std::optional<double> duration_s;  ///< nothing: until interrupted
  bool plain = false;
};
void watch(Client& client, const Output& output, const WatchArguments& arguments);

/// Writes every received state of `joints` to a CSV file, see state_csv.h.
struct RecordArguments {
  std::vector<std::string> joints;
  std::filesystem::path file;
  std::optional<double> duration_s;  ///< nothing: until interrupted
  bool overwrite = false;
};
void record(Client& client, const Output& output, const RecordArguments& arguments);

/// Draws a flight record (docs/flight-recorder.md) with gnuplot.
struct PlotRecordArguments {
  std::filesystem::path file;
  std::optional<std::filesystem::path> out;  ///< nothing: beside the file
  std::optional<double> around_s;            ///< nothing: the whole record
};
void plot_record(const Output& output, const PlotRecordArguments& arguments);

/// Orders to one joint. enable() and disable() return once the joint holds or is off.
void enable(Client& client, const Output& output, const std::string& joint);
void disable(Client& client, const Output& output, const std::string& joint);
void hold(Client& client, const Output& output, const std::string& joint);
void clear_fault(Client& client, const Output& output, const std::string& joint);

/// Moves to `position_rad`; with `wait`, returns once the joint holds there.
struct MoveArguments {
  std::string joint;
  double position_rad = 0.0;
  bool wait = false;
};
void move(Client& client, const Output& output, const MoveArguments& arguments);

/// Offers a gain table to one joint, or to every joint of the prefix. A refusal by one does not keep it from
/// the others.
struct LoadTableArguments {
  std::optional<std::string> joint;
  std::filesystem::path file;
};
void load_table(Client& client, const Output& output, const LoadTableArguments& arguments);

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
void can_check(const Output& output, const std::filesystem::path& config);

/// Throws ClientError (refused) with the reason unless `answer` accepts what `what` names.
void require_accepted(const Answer& answer, const std::string& joint, const std::string& what,
                      const std::string& hint = "");

}  // namespace strainwave
