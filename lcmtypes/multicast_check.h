// SPDX-License-Identifier: BSD-3-Clause
// Reads where LCM's datagrams go, and checks whether a datagram that this PC sends comes back to it. LCM needs this; its own test takes
// ten seconds and reports little. The check uses the group of the LCM URL and a port of its own, so that it disturbs no other program. It
// does not read the datagrams that arrive. Not real-time.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace strainwave {

/// Default URL of daemon and programs: LCM's own group, on this machine alone.
inline constexpr char kUsualLcmUrl[] = "udpm://239.255.76.67:7667?ttl=0";

/// Group, port and ttl of an LCM URL "udpm://GROUP:PORT?...". Missing parts get LCM's own defaults; the group is the URL's
/// text. parse_udpm_url() returns nothing for another kind of URL.
struct MulticastAddress {
  std::string group;
  int port = 0;
  int ttl = 0;  ///< hops that a datagram may make; 0: it stays on its machine
};
std::optional<MulticastAddress> parse_udpm_url(std::string_view lcm_url);

/// Returns what is wrong with the URL's text (kind, group, port, options) and what is allowed, or nothing.
std::optional<std::string> find_udpm_defect(std::string_view lcm_url);

/// Returns the problem and its remedy, or nothing when multicast works or the URL is not of the kind udpm.
std::optional<std::string> find_multicast_problem(std::string_view lcm_url);

/// Waits until multicast works. Calls `explain` once with the problem, and `go_on` at most five times a second. Returns false as soon as
/// `go_on` does. `lcm_url` must have passed find_udpm_defect().
bool wait_for_multicast(std::string_view lcm_url, const std::function<void(const std::string&)>& explain,
                        const std::function<bool()>& go_on);

}  // namespace strainwave
