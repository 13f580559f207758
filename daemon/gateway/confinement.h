// Takes from the gateway everything it does not need, in two steps: before LCM is set up (user, capabilities,
// descriptors) and after it (new processes, files, memory, system calls). What remains is to receive and send
// datagrams on the sockets it has. Both steps throw std::system_error when the system refuses: better no
// gateway than an open one. Not real-time.
#pragma once

#include <cstdint>

namespace strainwave {

/// Whether the filter of system calls is part of this build. The sanitizers' runtime needs calls it forbids.
bool has_system_call_filter() noexcept;

/// Becomes user `uid` and group `gid` without further groups (unless -1), gives up every capability for good,
/// closes every descriptor from `first_descriptor` on, and can from now on neither reach nor start another process.
/// One thread only.
void confine_before_setup(std::int64_t uid, std::int64_t gid, unsigned int first_descriptor);

/// Silences the standard streams (LCM writes a line for each malformed datagram: nobody may fill a log this
/// way), forbids new processes and growing files, bounds memory, and leaves the system calls of receiving and
/// sending. All threads.
void confine_after_setup();

}  // namespace strainwave
