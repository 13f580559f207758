// SPDX-License-Identifier: BSD-3-Clause
// Takes from the gateway everything it does not need, in two steps: who it is, before it opens anything; and what it may ask of
// the system, when all is open and bound and before it reads the first datagram. What remains is to receive and send on
// the sockets it has. Both steps throw std::system_error when the system refuses: better no gateway than an
// open one. Not real-time.
#pragma once

#include <cstdint>

namespace strainwave {

/// Whether the filter of system calls is part of this build. The sanitizers' runtime needs calls it forbids.
bool has_system_call_filter() noexcept;

/// Becomes user `uid` and group `gid` without further groups (unless -1), gives up every capability for good, and closes
/// every descriptor from `first_descriptor` on. One thread only.
void give_up_privileges(std::int64_t uid, std::int64_t gid, unsigned int first_descriptor);

/// Silences the standard streams (an attacker in the gateway writes no line into a log), forbids new processes and
/// growing files, and bounds memory. Of the system calls those of receiving and sending remain; any other ends the process. All threads.
void confine();

/// Writes that filter, as a program of struct sock_filter, to `descriptor`: for `architecture` (AUDIT_ARCH_...), which
/// need not be this machine's.
void export_system_call_filter(std::uint32_t architecture, int descriptor);

}  // namespace strainwave
