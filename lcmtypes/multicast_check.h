// SPDX-License-Identifier: BSD-3-Clause
// Where LCM's datagrams go, and whether one that this PC sends comes back to it. LCM needs that, and its own test of it
// takes ten seconds and says little. The check uses the group of the LCM URL and a port of its own, so that it disturbs no other program,
// and reads nothing that comes. Not real-time.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace strainwave {

/// Where daemon and programs meet by default: LCM's own group, on this machine alone.
inline constexpr char kUsualLcmUrl[] = "udpm://239.255.76.67:7667?ttl=0";

/// Group and port of an LCM URL "udpm://GROUP:PORT?..."; LCM's own defaults for what is left out. Nothing for
/// another kind of URL. The group is text as the URL has it.
struct MulticastAddress {
  std::string group;
  int port = 0;
  int ttl = 0;  ///< hops that a datagram may make; 0: it stays on its machine
};
std::optional<MulticastAddress> parse_udpm_url(std::string_view lcm_url);

/// What is wrong with such a URL's text (group, port, options), and what is allowed; or nothing. Of another kind of URL: that.
std::optional<std::string> find_udpm_defect(std::string_view lcm_url);

/// What is wrong and what to do about it, or nothing when multicast works or the URL is not of the kind udpm.
std::optional<std::string> find_multicast_problem(std::string_view lcm_url);

/// Returns once multicast works; says to `explain` once what is missing, and asks `go_on` five times a second. False: that said no. `lcm_url`
/// must have passed find_udpm_defect().
bool wait_for_multicast(std::string_view lcm_url, const std::function<void(const std::string&)>& explain,
                        const std::function<bool()>& go_on);

}  // namespace strainwave
