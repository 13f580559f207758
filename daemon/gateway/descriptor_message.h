// SPDX-License-Identifier: BSD-3-Clause
// Passes descriptors from one process to another over a local stream socket. Not real-time.
#pragma once

#include <array>

namespace strainwave {

/// The core passes these to a gateway that it does not start itself: outbound, inbound, wake, the gateway's program.
inline constexpr int kPassedDescriptors = 4;

/// Throws std::system_error.
void send_descriptors(int socket, const std::array<int, kPassedDescriptors>& descriptors);
/// Waits at most one second. The caller must close the descriptors. Throws std::system_error, also for any other message.
std::array<int, kPassedDescriptors> receive_descriptors(int socket);

}  // namespace strainwave
