// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/gateway/gateway_user.h"

#include <pwd.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <optional>
#include <system_error>

#include "base/input_error.h"
#include "daemon/gateway/sanitized.h"

namespace strainwave {

namespace {

constexpr const char* kOwnUser = "strainwave-gateway";
constexpr const char* kLeastUser = "nobody";

// In a user namespace only some ids exist; a process cannot take another one.
bool is_mapped(std::int64_t id, const char* map_path) {
  std::ifstream map(map_path);
  std::int64_t inside = 0;
  std::int64_t outside = 0;
  std::int64_t count = 0;
  while (map >> inside >> outside >> count)
    if (id >= inside && id < inside + count) return true;
  return false;
}

std::optional<GatewayUser> find_user(const std::string& name) {
  const passwd* entry = ::getpwnam(name.c_str());  // NOLINT(concurrency-mt-unsafe): at start, one thread
  if (entry == nullptr) return std::nullopt;
  return GatewayUser{entry->pw_uid, entry->pw_gid, name};
}

bool can_become(const GatewayUser& user) {
  return is_mapped(user.uid, "/proc/self/uid_map") && is_mapped(user.gid, "/proc/self/gid_map");
}

}  // namespace

GatewayUser gateway_user_named(const std::string& name) {
  const auto user = find_user(name);
  if (!user) throw InputError("there is no such user: make it with adduser --system " + name);
  if (user->uid == 0) throw InputError("a user without privileges is allowed");
  if (::geteuid() == static_cast<uid_t>(user->uid)) return {};
  if (::geteuid() != 0)
    throw InputError("only root can start the gateway as another user: leave the key out");
  if (!can_become(*user))
    throw InputError("this user does not exist inside this user namespace: leave the key out");
  return *user;
}

GatewayUser default_gateway_user() {
  if (::geteuid() != 0) return {};
  for (const char* name : {kOwnUser, kLeastUser}) {
    const auto user = find_user(name);
    if (user && user->uid != 0 && can_become(*user)) return *user;
  }
  return {};
}

void hide_memory_from_own_user() {
  // The sanitizers' leak search traces its own process.
  if (!kSanitized && ::prctl(PR_SET_DUMPABLE, 0, 0, 0, 0) != 0)
    throw std::system_error(errno, std::generic_category(), "hiding the daemon's memory");
}

}  // namespace strainwave
