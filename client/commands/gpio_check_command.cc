// gpio-check: what the daemon itself says of the lines of a configuration.
#include "client/commands/commands.h"
#include "client/commands/sibling_program.h"
#include "client/link/exit_status.h"

namespace strainwave {

void gpio_check(const Output& output, const std::filesystem::path& config) {
  output.stream.flush();
  if (run_sibling("strainwaved", {"--config", config.string(), "--check-lines"}) != 0)
    throw ClientError(ExitStatus::kUsage, config.string() + ": not every line can be used, see above");
}

}  // namespace strainwave
