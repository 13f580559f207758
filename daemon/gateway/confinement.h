// SPDX-License-Identifier: BSD-3-Clause
// Removes every privilege that the gateway does not need. give_up_privileges() drops user and capabilities before anything is
// opened. confine() limits the system calls once all is open and bound, before the first datagram is read. Then the gateway can
// only receive and send on its sockets. Both throw std::system_error when the system refuses: no gateway is better than an
// unconfined one. Not real-time.
#pragma once

#include <cstdint>

namespace strainwave {

/// Whether the filter of system calls is part of this build. The sanitizers' runtime needs calls it forbids.
bool has_system_call_filter() noexcept;

/// Becomes user `uid` and group `gid` without further groups (unless -1), gives up every capability for good, and closes
/// every descriptor from `first_descriptor` on. One thread only.
void give_up_privileges(std::int64_t uid, std::int64_t gid, unsigned int first_descriptor);

/// Silences the standard streams (an attacker in the gateway writes no line into a log), forbids new processes and
/// growing files, and bounds memory. Any system call except those for receiving and sending ends the process. Affects all threads.
void confine();

/// Writes the filter of system calls to `descriptor`, as a program of struct sock_filter for `architecture` (AUDIT_ARCH_...),
/// which may differ from this machine's.
void export_system_call_filter(std::uint32_t architecture, int descriptor);

}  // namespace strainwave
