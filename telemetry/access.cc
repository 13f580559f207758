// SPDX-License-Identifier: BSD-3-Clause
#include "telemetry/access.h"

#include <arpa/inet.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>

#include "base/input_error.h"
#include "base/printable.h"
#include "base/text_file.h"

namespace strainwave {

namespace {

constexpr std::string_view kBearer = "Bearer ";
constexpr std::string_view kTokenKey = "token=";

[[noreturn]] void refuse_address(const std::string& text) {
  throw InputError("--listen: '" + text +
                   "' is not ADDRESS:PORT: an IP address of this machine and a port from 0 to 65535, as "
                   "127.0.0.1:8765 or [::1]:8765");
}

bool is_address(const std::string& host) {
  std::array<unsigned char, sizeof(in6_addr)> bytes{};
  return ::inet_pton(AF_INET, host.c_str(), bytes.data()) == 1 ||
         ::inet_pton(AF_INET6, host.c_str(), bytes.data()) == 1;
}

/// Host and port of "a:1", "[::1]:1" and "a".
std::pair<std::string_view, std::string_view> split(std::string_view text) {
  if (text.starts_with('[')) {
    const std::size_t end = text.find(']');
    if (end == std::string_view::npos) return {"", ""};
    const std::string_view rest = text.substr(end + 1);
    return {text.substr(1, end - 1), rest.starts_with(':') ? rest.substr(1) : ""};
  }
  const std::size_t colon = text.rfind(':');
  if (colon == std::string_view::npos) return {text, ""};
  return {text.substr(0, colon), text.substr(colon + 1)};
}

std::string_view token_in(const RequestFacts& request) {
  // Names of schemes are case-insensitive (RFC 9110, 11.1).
  const std::string_view scheme = request.authorization.substr(0, kBearer.size());
  const auto same = [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); };
  if (std::equal(scheme.begin(), scheme.end(), kBearer.begin(), kBearer.end(), same))
    return request.authorization.substr(kBearer.size());
  std::string_view rest = request.target.substr(path_of(request.target).size());
  while (!rest.empty()) {
    rest.remove_prefix(1);  // ? or &
    const std::string_view option = rest.substr(0, rest.find('&'));
    if (option.starts_with(kTokenKey)) return option.substr(kTokenKey.size());
    rest.remove_prefix(option.size());
  }
  return "";
}

bool is_this_machine(std::string_view host) {
  const std::string name(split(host).first);
  return name == "localhost" || is_loopback(name);
}

/// The origin of the server's own page is the requested address.
bool has_own_origin(const RequestFacts& request) {
  return request.origin == "http://" + std::string(request.host);
}

}  // namespace

ListenAddress parse_listen_address(const std::string& text) {
  const auto [host, port] = split(text);
  ListenAddress address{std::string(host), 0};
  const auto [last, error] = std::from_chars(port.data(), port.data() + port.size(), address.port);
  if (port.empty() || error != std::errc() || last != port.data() + port.size() || !is_address(address.host))
    refuse_address(text);
  return address;
}

bool is_loopback(const std::string& host) {
  constexpr std::uint32_t kLoopbackNet = 127;
  in_addr four{};
  if (::inet_pton(AF_INET, host.c_str(), &four) == 1) return ntohl(four.s_addr) >> 24U == kLoopbackNet;
  in6_addr six{};
  return ::inet_pton(AF_INET6, host.c_str(), &six) == 1 && IN6_IS_ADDR_LOOPBACK(&six);
}

std::string read_token(const std::string& file) {
  const auto refuse = [&](const std::string& why) { throw InputError("--token-file: " + file + ": " + why); };
  const std::string text = read_text_file(file);
  struct stat facts {};
  if (::stat(file.c_str(), &facts) == 0 && (facts.st_mode & (S_IROTH | S_IWOTH)) != 0)
    refuse("everybody may read or write it: chmod o-rw " + file);
  std::string token = text.substr(0, text.find_first_of("\r\n"));
  if (token.size() < AccessRules::kShortestToken)
    refuse("its first line has " + counted(token.size(), "character") + ": a token has at least " +
           std::to_string(AccessRules::kShortestToken));
  const auto fits = [](unsigned char c) { return std::isalnum(c) != 0 || c == '-' || c == '_'; };
  if (!std::all_of(token.begin(), token.end(), fits)) refuse("a token consists of A-Z a-z 0-9 - and _");
  return token;
}

Access judge(const RequestFacts& request, const AccessRules& rules) {
  if (!rules.token.empty())
    return equal_in_constant_time(token_in(request), rules.token) ? Access::kGranted : Access::kNoToken;
  const bool known_page =
      request.origin.empty() || has_own_origin(request) ||
      std::find(rules.origins.begin(), rules.origins.end(), request.origin) != rules.origins.end();
  return known_page && is_this_machine(request.host) ? Access::kGranted : Access::kForeignPage;
}

bool is_from_own_page(const RequestFacts& request) {
  return has_own_origin(request) && is_this_machine(request.host);
}

bool equal_in_constant_time(std::string_view given, std::string_view token) {
  if (given.size() != token.size()) return false;
  unsigned int difference = 0;
  for (std::size_t i = 0; i < given.size(); ++i)
    difference |= static_cast<unsigned int>(static_cast<unsigned char>(given[i]) ^
                                            static_cast<unsigned char>(token[i]));
  return difference == 0;
}

std::string_view path_of(std::string_view target) {
  return target.substr(0, target.find('?'));
}

}  // namespace strainwave
