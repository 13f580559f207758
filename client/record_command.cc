// record: received states to a CSV file.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <map>

#include "client/commands.h"
#include "client/exit_status.h"
#include "client/state_csv.h"
#include "lcmtypes/wire.h"

namespace strainwave {

namespace {

/// Writes each state of the chosen joints as it comes.
class Recorder {
 public:
  Recorder(Client& client, const RecordArguments& arguments, std::ostream& file)
      : file_(file),
        subscription_(client.connection().subscribe(
            channel_pattern(client.options().prefix, channel_kind::kState), &Recorder::on_state, this)) {
    for (const std::string& joint : arguments.joints) counts_[joint] = 0;
  }
  const std::map<std::string, long>& counts() const noexcept { return counts_; }

 private:
  void on_state(const lcm::ReceiveBuffer* buffer, const std::string& channel) {
    const auto parts = parse_channel(channel);
    if (!parts || !counts_.contains(parts->joint)) return;
    const auto state = decode_exactly<state_v1>(payload(*buffer));
    if (!state) return;
    file_ << csv_row(parts->joint, *state) << '\n';
    ++counts_[parts->joint];
  }

  std::ostream& file_;
  std::map<std::string, long> counts_;
  Subscription subscription_;
};

/// Waits until the recording is over; an interrupt is a normal end.
void wait_for_end(Client& client, const std::ostream& file, const Deadline& end) {
  try {
    client.wait_until([&] { return !file.good(); }, end);
  } catch (const ClientError& error) {
    if (error.status() != ExitStatus::kInterrupted) throw;
  }
}

}  // namespace

void record(Client& client, const Output& output, const RecordArguments& arguments) {
  for (const std::string& joint : arguments.joints) client.wait_for_joint(joint);
  const std::string name = arguments.file.string();
  if (!arguments.overwrite && std::filesystem::exists(arguments.file)) {
    throw ClientError(ExitStatus::kFile, name + " exists: choose another name, or say --overwrite");
  }
  std::ofstream file(arguments.file);
  file << csv_header() << '\n';
  file.flush();
  if (!file)
    throw ClientError(ExitStatus::kFile, name + " cannot be written: does its folder exist, is it yours?");
  Recorder recorder(client, arguments, file);
  constexpr double kNoEnd_s = 1e9;
  wait_for_end(client, file, Deadline(arguments.duration_s.value_or(kNoEnd_s)));
  file.flush();
  if (!file) throw ClientError(ExitStatus::kFile, name + " is incomplete: writing failed; is the disk full?");
  for (const auto& [joint, count] : recorder.counts()) {
    output.stream << fmt::format("{}: {} states in {}\n", joint, count, name);
  }
}

}  // namespace strainwave
