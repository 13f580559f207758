// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/log.h"

#include <poll.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/ansicolor_sink.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <memory>
#include <string>

#include "base/printable.h"

namespace strainwave {

namespace {

bool takes_a_line(int file) {
  pollfd descriptor{file, POLLOUT, 0};
  return ::poll(&descriptor, 1, 0) > 0 && (descriptor.revents & POLLOUT) != 0;
}

/// Writes to stderr without ever waiting for its reader. A pager that stands still, or a journal that hangs, must
/// not keep the supervisor from passing on a stop. Lines that stderr does not take at once are lost; the log
/// reports their number before its next line.
class NeverWaitingSink final : public spdlog::sinks::ansicolor_stderr_sink_mt {
 public:
  /// Many lines quote text from outside. Such text must not end its line, begin another with a priority of its own, or
  /// control a terminal.
  void log(const spdlog::details::log_msg& raw) override {
    const std::string text = printable({raw.payload.data(), raw.payload.size()});
    spdlog::details::log_msg message = raw;
    message.payload = text;
    if (!takes_a_line(STDERR_FILENO)) {
      lost_.fetch_add(1, std::memory_order_relaxed);
      return;
    }
    if (const std::int64_t lost = lost_.exchange(0, std::memory_order_relaxed); lost > 0) {
      const std::string loss = counted(lost, "line") + " of this log lost: its reader was too slow";
      Base::log({message.logger_name, spdlog::level::warn, loss});
    }
    Base::log(message);
  }

 private:
  using Base = spdlog::sinks::ansicolor_stderr_sink_mt;
  std::atomic<std::int64_t> lost_ = 0;
};

/// "%*": the level as the journal reads it at the start of a line, "<3>" for an error (sd-daemon(3)).
class JournalLevel final : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& message, const std::tm& /*time*/,
              spdlog::memory_buf_t& out) override {
    const char level = message.level >= spdlog::level::critical ? '2'
                       : message.level == spdlog::level::err    ? '3'
                       : message.level == spdlog::level::warn   ? '4'
                       : message.level == spdlog::level::info   ? '6'
                                                                : '7';
    for (const char character : {'<', level, '>'}) out.push_back(character);
  }
  std::unique_ptr<custom_flag_formatter> clone() const override { return std::make_unique<JournalLevel>(); }
};

}  // namespace

void start_logging() {
  auto logger = std::make_shared<spdlog::logger>("strainwaved", std::make_shared<NeverWaitingSink>());
  // systemd sets this variable if stderr goes to the journal.
  if (std::getenv("JOURNAL_STREAM") != nullptr) {  // NOLINT(concurrency-mt-unsafe): before any thread
    auto formatter = std::make_unique<spdlog::pattern_formatter>();
    formatter->add_flag<JournalLevel>('*').set_pattern("%*%v");
    logger->set_formatter(std::move(formatter));
  } else {
    logger->set_pattern("%H:%M:%S.%e strainwaved %^%l%$: %v");
  }
  spdlog::set_default_logger(std::move(logger));
}

}  // namespace strainwave
