#include "lcmtypes/multicast_check.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <system_error>

namespace strainwave {

namespace {

constexpr std::string_view kScheme = "udpm://";
constexpr int kEcho_ms = 500;  // a datagram within one PC takes well under a millisecond

class Socket {
 public:
  Socket() : descriptor_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {}
  ~Socket() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
  int get() const noexcept { return descriptor_; }

 private:
  int descriptor_;
};

sockaddr* as_sockaddr(sockaddr_in& address) {
  return static_cast<sockaddr*>(static_cast<void*>(&address));
}

std::string last_error() {
  return std::system_category().message(errno);
}

/// Why a datagram to `group` does not come back, or an empty text.
std::string echo_failure(in_addr group) {
  const Socket receiver;
  const Socket sender;
  if (receiver.get() < 0 || sender.get() < 0) return last_error();
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

// As LCM reads it: the last of several counts, and what is no number is 0.
int ttl_of(std::string_view options) {
  int ttl = 0;
  while (!options.empty()) {
    options.remove_prefix(1);  // ? or &
    const std::string_view option = options.substr(0, options.find('&'));
    options.remove_prefix(option.size());
    constexpr std::string_view kKey = "ttl=";
    if (!option.starts_with(kKey)) continue;
    ttl = 0;
    std::from_chars(option.data() + kKey.size(), option.data() + option.size(), ttl);
  }
  return ttl;
}

}  // namespace

std::optional<MulticastAddress> parse_udpm_url(std::string_view lcm_url) {
  if (!lcm_url.starts_with(kScheme)) return std::nullopt;
  lcm_url.remove_prefix(kScheme.size());
  const std::string_view options = lcm_url.substr(std::min(lcm_url.find('?'), lcm_url.size()));
  lcm_url = lcm_url.substr(0, lcm_url.find('?'));
  MulticastAddress address{"239.255.76.67", 7667, ttl_of(options)};
  const std::size_t colon = lcm_url.find(':');
  if (const std::string_view group = lcm_url.substr(0, colon); !group.empty()) address.group = group;
  if (colon != std::string_view::npos) {
    const std::string_view port = lcm_url.substr(colon + 1);
    if (std::from_chars(port.data(), port.data() + port.size(), address.port).ec != std::errc())
      address.port = 0;
  }
  return address;
}

std::optional<std::string> find_multicast_problem(std::string_view lcm_url) {
  const std::optional<MulticastAddress> address = parse_udpm_url(lcm_url);
  if (!address) return std::nullopt;
  in_addr group{};
  if (::inet_pton(AF_INET, address->group.c_str(), &group) != 1 || !IN_MULTICAST(ntohl(group.s_addr))) {
    return "'" + address->group +
           "' is not an IPv4 multicast group (224.0.0.0 to 239.255.255.255); the usual URL is "
           "udpm://239.255.76.67:7667?ttl=0";
  }
  if (address->port < 1 || address->port > 65535) {
    return std::string(
        "the port must be a number from 1 to 65535; the usual URL is udpm://239.255.76.67:7667?ttl=0");
  }
  const std::string failure = echo_failure(group);
  if (failure.empty()) return std::nullopt;
  return "multicast to " + address->group + " does not work here (" + failure +
         "). To keep LCM on this PC, run as root:\n"
         "  ip link set lo up multicast on\n"
         "  ip route add " +
         address->group + "/32 dev lo src 127.0.0.1";
}

}  // namespace strainwave
