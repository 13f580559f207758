// SPDX-License-Identifier: BSD-3-Clause
// Access control of telemetry: the listening address, and the proof that a request needs. Not real-time. Without a token the
// server listens on loopback only. It also refuses requests of foreign web pages in the operator's browser: the origin must be an
// allowed page. The requested host name must belong to this machine, because a page could map its own name to our address.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace strainwave {

/// An IP address of this machine, and a port; 0: any free one.
struct ListenAddress {
  std::string host = "127.0.0.1";
  std::uint16_t port = 8765;
};

/// "127.0.0.1:8765", "[::1]:8765". Throws InputError.
ListenAddress parse_listen_address(const std::string& text);
bool is_loopback(const std::string& host);

struct AccessRules {
  static constexpr std::size_t kShortestToken = 16;

  std::string token;                 ///< empty: none is required
  std::vector<std::string> origins;  ///< web pages that may show telemetry
};

/// Reads the first line of `file`. Throws InputError if it is unreadable, other users may read or write it,
/// or the token is unusable: too short, or with characters that do not fit into an address.
std::string read_token(const std::string& file);

/// The relevant parts of a request. A missing part is empty.
struct RequestFacts {
  std::string_view target;         ///< "/metrics?token=..."
  std::string_view authorization;  ///< "Bearer ..."
  std::string_view origin;
  std::string_view host;  ///< "localhost:8765"
};

enum class Access { kGranted, kNoToken, kForeignPage };

/// With a token, the request must have it in a header or in its target. Without one, the rules at the top of this file apply.
Access judge(const RequestFacts& request, const AccessRules& rules);

/// Whether the page of this server sent the request: the page's origin is the requested address, under a name of this machine.
bool is_from_own_page(const RequestFacts& request);

/// The time for equal lengths does not depend on the contents, so that it reveals nothing about the token.
bool equal_in_constant_time(std::string_view given, std::string_view token);

/// The target without the question mark and the part after it.
std::string_view path_of(std::string_view target);

}  // namespace strainwave
