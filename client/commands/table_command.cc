// load-table: a gain table from its file to the daemon. The file is checked here for its form; whether the
// table suits the joint and is certified for it, the daemon decides.
#include <fmt/format.h>

#include <optional>

#include "client/commands/commands.h"
#include "client/link/exit_status.h"
#include "control/gain_table_json.h"
#include "lcmtypes/gain_table_message.h"

namespace strainwave {

void load_table(Client& client, const Output& output, const LoadTableArguments& arguments) {
  const GainTable table = read_gain_table(arguments.file);
  const gain_table_v1 message = to_message(table);
  const std::vector<std::string> joints =
      arguments.joint ? std::vector<std::string>{*arguments.joint} : client.wait_for_joints();
  std::optional<ClientError> failure;
  for (const std::string& joint : joints) {
    try {
      const Answer answer = client.request(joint, channel_kind::kTable, message);
      require_accepted(answer, joint, fmt::format("table '{}'", table.name.view()));
      say(output, fmt::format("{}: table '{}' loaded", joint, table.name.view()),
          {{"joint", joint}, {"loaded", true}, {"table", std::string(table.name.view())}});
    } catch (const ClientError& error) {
      if (error.status() == ExitStatus::kInterrupted) throw;
      failure.emplace(failure ? failure->status() : error.status(),
                      failure ? std::string(failure->what()) + "\n" + error.what() : error.what());
    }
  }
  if (failure) throw *failure;
}

}  // namespace strainwave
