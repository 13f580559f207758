#include "daemon/log.h"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/sinks/systemd_sink.h>
#include <spdlog/spdlog.h>

#include <cstdlib>
#include <memory>

namespace strainwave {

void start_logging() {
  // systemd tells by this variable that stderr is the journal's.
  const bool under_systemd = std::getenv("JOURNAL_STREAM") != nullptr;  // NOLINT(concurrency-mt-unsafe): before threads
  auto logger = under_systemd ? std::make_shared<spdlog::logger>(
                                    "strainwaved", std::make_shared<spdlog::sinks::systemd_sink_mt>("strainwaved"))
                              : spdlog::stderr_color_mt("strainwaved");
  logger->set_pattern(under_systemd ? "%v" : "%H:%M:%S.%e strainwaved %^%l%$: %v");
  spdlog::set_default_logger(std::move(logger));
}

}  // namespace strainwave
