// SPDX-License-Identifier: BSD-3-Clause
// What takes stops goes before other programs of ordinary priority: the gateway, and the thread of the core that judges what comes. Else
// a stop waits behind all who compute. The loop, of real-time priority, goes before both whatever they do. Not real-time.
#pragma once

#include <sys/resource.h>

#include <cerrno>
#include <string>
#include <system_error>

namespace strainwave {

/// As LimitNICE= of the daemon's unit allows it, and Nice= of the gateway's says it.
inline constexpr int kPreferredNice = -10;

/// Of the calling thread, and of those that it starts from then on. Empty when granted, else what was refused and what to do.
inline std::string prefer_this_thread() {
  // In Linux the nice value is a thread's own.
  if (::setpriority(PRIO_PROCESS, 0, kPreferredNice) == 0) return "";
  const std::string nice = std::to_string(kPreferredNice);
  return "nice " + nice + " is refused (" + std::generic_category().message(errno) +
         "): under load, orders and stops wait behind other programs; the process needs CAP_SYS_NICE "
         "(container: "
         "--cap-add SYS_NICE) or RLIMIT_NICE: run under the service, or after `ulimit -e " +
         std::to_string(20 - kPreferredNice) + "`";
}

}  // namespace strainwave
