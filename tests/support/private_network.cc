// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/private_network.h"

#include <fcntl.h>
#include <sched.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

namespace strainwave::testing {

namespace {

bool write_file(const char* path, const std::string& text) {
  const int descriptor = ::open(path, O_WRONLY);
  if (descriptor < 0) return false;
  const bool done = ::write(descriptor, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  ::close(descriptor);
  return done;
}

bool unshare_network() {
  if (::unshare(CLONE_NEWNET) == 0) return true;
  const uid_t user = ::getuid();
  const gid_t group = ::getgid();
  if (::unshare(CLONE_NEWUSER | CLONE_NEWNET) != 0) return false;
  return write_file("/proc/self/setgroups", "deny") &&
         write_file("/proc/self/uid_map", "0 " + std::to_string(user) + " 1") &&
         write_file("/proc/self/gid_map", "0 " + std::to_string(group) + " 1");
}

}  // namespace

bool enter_private_network(bool with_route) {
  if (!unshare_network()) return false;
  const std::string path = "PATH=$PATH:/usr/sbin:/sbin; ";
  std::string commands = path + "ip link set lo up";
  if (with_route)
    commands += " && ip link set lo multicast on && ip route add 239.255.76.67/32 dev lo src 127.0.0.1";
  return std::system(commands.c_str()) == 0;  // NOLINT(concurrency-mt-unsafe): before threads
}

}  // namespace strainwave::testing
