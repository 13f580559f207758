// SPDX-License-Identifier: BSD-3-Clause
#include "lcmtypes/multicast_check.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstring>
#include <system_error>
#include <thread>
#include <vector>

#include "base/unique_fd.h"

namespace strainwave {

namespace {

constexpr std::string_view kScheme = "udpm://";
constexpr std::chrono::milliseconds kLookAgain{200};
constexpr int kEcho_ms = 500;  // a datagram within one PC takes well under a millisecond

sockaddr* as_sockaddr(sockaddr_in& address) {
  return static_cast<sockaddr*>(static_cast<void*>(&address));
}

std::string last_error() {
  return std::system_category().message(errno);
}

/// Returns why a datagram to `group` does not come back, or an empty text.
std::string echo_failure(in_addr group) {
  const UniqueFd receiver(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  const UniqueFd sender(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  if (!receiver || !sender) return last_error();
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr = group;
  socklen_t length = sizeof(address);
  if (::bind(receiver.get(), as_sockaddr(address), length) != 0) return last_error();
  if (::getsockname(receiver.get(), as_sockaddr(address), &length) != 0) return last_error();
  const ip_mreq membership{group, {htonl(INADDR_ANY)}};
  if (::setsockopt(receiver.get(), IPPROTO_IP, IP_ADD_MEMBERSHIP, &membership, sizeof(membership)) != 0) {
    return last_error();
  }
  const unsigned char stay_here = 0;
  if (::setsockopt(sender.get(), IPPROTO_IP, IP_MULTICAST_TTL, &stay_here, sizeof(stay_here)) != 0) {
    return last_error();
  }
  const std::array<char, 4> probe{'p', 'i', 'n', 'g'};
  if (::sendto(sender.get(), probe.data(), probe.size(), 0, as_sockaddr(address), length) < 0)
    return last_error();
  pollfd waiting{receiver.get(), POLLIN, 0};
  if (::poll(&waiting, 1, kEcho_ms) == 1) return "";
  return "a datagram sent to the group did not come back; a firewall may drop it";
}

constexpr int kNoNumber = -1;

/// Returns all of `text` as a number, or kNoNumber.
int whole_number(std::string_view text) {
  int number = 0;
  const char* const end = text.data() + text.size();
  const auto [last, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && last == end ? number : kNoNumber;
}

/// Returns the options behind the URL's question mark, each of the form "KEY=VALUE".
std::vector<std::string_view> options_of(std::string_view lcm_url) {
  std::vector<std::string_view> options;
  std::string_view rest = lcm_url.substr(std::min(lcm_url.find('?'), lcm_url.size()));
  while (!rest.empty()) {
    rest.remove_prefix(1);  // ? or &
    options.push_back(rest.substr(0, rest.find('&')));
    rest.remove_prefix(options.back().size());
  }
  return options;
}

constexpr std::string_view kTtl = "ttl=";
constexpr std::string_view kReceiveBuffer = "recv_buf_size=";

// Reads the ttl as LCM does: the last of several counts, and a text that is no number is 0.
int ttl_of(std::string_view lcm_url) {
  int ttl = 0;
  for (const std::string_view option : options_of(lcm_url))
    if (option.starts_with(kTtl)) ttl = std::max(0, whole_number(option.substr(kTtl.size())));
  return ttl;
}

std::optional<std::string> find_option_defect(std::string_view option) {
  constexpr int kMaxTtl = 255;
  if (option.starts_with(kTtl)) {
    const int ttl = whole_number(option.substr(kTtl.size()));
    if (ttl >= 0 && ttl <= kMaxTtl) return std::nullopt;
    return "'" + std::string(option) + "': ttl must be a number of hops from 0 (this machine alone) to 255";
  }
  if (option.starts_with(kReceiveBuffer) && whole_number(option.substr(kReceiveBuffer.size())) > 0)
    return std::nullopt;
  return "'" + std::string(option) +
         "' is not a valid option of LCM: ttl=N and recv_buf_size=BYTES (above 0) are allowed";
}

}  // namespace

std::optional<MulticastAddress> parse_udpm_url(std::string_view lcm_url) {
  if (!lcm_url.starts_with(kScheme)) return std::nullopt;
  lcm_url.remove_prefix(kScheme.size());
  MulticastAddress address{"239.255.76.67", 7667, ttl_of(lcm_url)};
  lcm_url = lcm_url.substr(0, lcm_url.find('?'));
  const std::size_t colon = lcm_url.find(':');
  if (const std::string_view group = lcm_url.substr(0, colon); !group.empty()) address.group = group;
  if (colon != std::string_view::npos) address.port = std::max(0, whole_number(lcm_url.substr(colon + 1)));
  return address;
}

std::optional<std::string> find_udpm_defect(std::string_view lcm_url) {
  const std::optional<MulticastAddress> address = parse_udpm_url(lcm_url);
  if (!address)
    return "'" + std::string(lcm_url) +
           "' does not have the form udpm://GROUP:PORT?ttl=N; the usual URL is " + kUsualLcmUrl;
  in_addr group{};
  if (::inet_pton(AF_INET, address->group.c_str(), &group) != 1 || !IN_MULTICAST(ntohl(group.s_addr))) {
    return "'" + address->group +
           "' is not an IPv4 multicast group (224.0.0.0 to 239.255.255.255); the usual URL is " +
           kUsualLcmUrl;
  }
  if (address->port < 1 || address->port > 65535) {
    return std::string("the port must be a number from 1 to 65535; the usual URL is ") + kUsualLcmUrl;
  }
  for (const std::string_view option : options_of(lcm_url))
    if (auto defect = find_option_defect(option)) return defect;
  return std::nullopt;
}

std::optional<std::string> find_multicast_problem(std::string_view lcm_url) {
  const std::optional<MulticastAddress> address = parse_udpm_url(lcm_url);
  if (!address) return std::nullopt;
  if (auto defect = find_udpm_defect(lcm_url)) return defect;
  in_addr group{};
  ::inet_pton(AF_INET, address->group.c_str(), &group);
  const std::string failure = echo_failure(group);
  if (failure.empty()) return std::nullopt;
  return "multicast to " + address->group + " does not work here (" + failure +
         "). To keep LCM on this PC, run as root:\n"
         "  ip link set lo up multicast on\n"
         "  ip route add " +
         address->group + "/32 dev lo src 127.0.0.1";
}

bool wait_for_multicast(std::string_view lcm_url, const std::function<void(const std::string&)>& explain,
                        const std::function<bool()>& go_on) {
  for (bool said = false; const auto problem = find_multicast_problem(lcm_url); said = true) {
    if (!said) explain(*problem);
    if (!go_on()) return false;
    std::this_thread::sleep_for(kLookAgain);
  }
  return true;
}

}  // namespace strainwave
