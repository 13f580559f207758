// SPDX-License-Identifier: BSD-3-Clause
// load-table: sends a gain table from its file to the daemon. The client checks the form of the file. The
// daemon decides whether the table suits the joint and is certified for it.
#include <fmt/format.h>

#include "client/commands/commands.h"
#include "client/commands/each_joint.h"
#include "client/protocol/orders.h"
#include "control/table/gain_table_json.h"
#include "lcmtypes/gain_table_message.h"

namespace strainwave {

void load_table(Client& client, const Output& output, const LoadTableArguments& arguments) {
  const GainTable table = read_gain_table(arguments.file);
  const gain_table_v1 message = to_message(table);
  const std::vector<std::string> named =
      arguments.joint ? std::vector<std::string>{*arguments.joint} : std::vector<std::string>{};
  Failures failures;
  for (const std::string& joint : joints_or_all(client, named))
    failures.attempt(joint, [&] {
      const Answer answer = client.request(joint, channel_kind::kTable, message);
      require_accepted(answer, joint, fmt::format("table '{}'", table.name.view()));
      say(output, fmt::format("{}: table '{}' loaded", joint, table.name.view()),
          {{"joint", joint}, {"loaded", true}, {"table", std::string(table.name.view())}});
    });
  failures.rethrow();
}

}  // namespace strainwave
