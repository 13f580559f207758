// SPDX-License-Identifier: BSD-3-Clause
// Gives threads that handle stops precedence over ordinary programs: the gateway, and the core's thread that judges messages. Otherwise
// stops wait behind programs that compute. The loop has real-time priority and precedes both in any case. Not real-time.
#pragma once

#include <sys/resource.h>

#include <cerrno>
#include <string>
#include <system_error>

namespace strainwave {

/// Must match LimitNICE= of the daemon's unit and Nice= of the gateway's.
inline constexpr int kPreferredNice = -10;

/// Applies to the calling thread and to threads that it starts later. Empty when granted, else what was refused and what to do.
inline std::string prefer_this_thread() {
  // On Linux each thread has its own nice value.
  if (::setpriority(PRIO_PROCESS, 0, kPreferredNice) == 0) return "";
  const std::string nice = std::to_string(kPreferredNice);
  return "nice " + nice + " is refused (" + std::generic_category().message(errno) +
         "): under load, orders and stops wait behind other programs. The process needs CAP_SYS_NICE "
         "(container: --cap-add SYS_NICE) or RLIMIT_NICE: run it as the service, or after `ulimit -e " +
         std::to_string(20 - kPreferredNice) + "`";
}

}  // namespace strainwave
