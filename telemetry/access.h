// SPDX-License-Identifier: BSD-3-Clause
// Who may see telemetry: where the server listens, and what a request must show. Not real-time.
// Without a token it listens on loopback alone, and answers nothing to web pages that the operator's browser happens to visit. A page's
// origin must be a viewer's, and the requested host name this machine's, as a page could give its own name our address.
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

  std::string token;                 ///< empty: none is asked for
  std::vector<std::string> origins;  ///< web pages that may show telemetry
};

/// Reads the first line of `file`. Throws InputError: it cannot be read, everybody can read it, or the token is too short or has
/// characters that do not fit into an address.
std::string read_token(const std::string& file);

/// What a request says of itself; empty: nothing.
struct RequestFacts {
  std::string_view target;         ///< "/metrics?token=..."
  std::string_view authorization;  ///< "Bearer ..."
  std::string_view origin;
  std::string_view host;  ///< "localhost:8765"
};

enum class Access { kGranted, kNoToken, kForeignPage };

/// With a token the request must have it, as a header or in its target. Without one, see above.
Access judge(const RequestFacts& request, const AccessRules& rules);

/// Whether a browser sends it for the page of this server: the page's origin is the address that was asked for, by a name of this machine.
bool is_from_own_page(const RequestFacts& request);

/// Takes as long whatever differs, so that time tells nothing about the token.
bool equal_in_constant_time(std::string_view given, std::string_view token);

/// The target without what stands behind the question mark.
std::string_view path_of(std::string_view target);

}  // namespace strainwave
