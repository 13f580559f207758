// SPDX-License-Identifier: BSD-3-Clause
// Descriptors from one process to another, over a local stream socket. Not real-time.
#pragma once

#include <array>

namespace strainwave {

/// What the core hands to a gateway that it does not start itself: outbound, inbound, wake, the gateway's program.
inline constexpr int kPassedDescriptors = 4;

/// Throws std::system_error.
void send_descriptors(int socket, const std::array<int, kPassedDescriptors>& descriptors);
/// Waits for them, one second at most. They are the caller's to close. Throws std::system_error, also when something else came.
std::array<int, kPassedDescriptors> receive_descriptors(int socket);

}  // namespace strainwave
