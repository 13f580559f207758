// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/gateway/service_watchdog.h"

#include <stdlib.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <cerrno>
#include <cstddef>
#include <cstring>
#include <string_view>
#include <system_error>

namespace strainwave {

namespace {

/// Several notifications within any WatchdogSec= that a unit would set.
constexpr std::int64_t kEvery_ns = 200'000'000;

}  // namespace

// Replaces sd_notify(3), which opens a socket for each message: the filter forbids that.
ServiceWatchdog::ServiceWatchdog() {
  const char* path = ::getenv("NOTIFY_SOCKET");  // NOLINT(concurrency-mt-unsafe): one thread
  if (path == nullptr) return;
  const std::string_view name(path);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (name.empty() || name.size() >= sizeof address.sun_path)
    throw std::system_error(EINVAL, std::generic_category(), "NOTIFY_SOCKET");
  std::memcpy(address.sun_path, name.data(), name.size());
  if (name.front() == '@') address.sun_path[0] = '\0';
  socket_.reset(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
  if (!socket_ || ::connect(socket_.get(), reinterpret_cast<const sockaddr*>(&address), size) != 0)
    throw std::system_error(errno, std::generic_category(), "reaching the service manager");
}

void ServiceWatchdog::alive(std::int64_t now_ns) noexcept {
  if (!socket_ || now_ns < due_ns_) return;
  due_ns_ = now_ns + kEvery_ns;
  send("WATCHDOG=1");
}

void ServiceWatchdog::send(const char* text) noexcept {
  if (!socket_) return;
  iovec part{const_cast<char*>(text), std::strlen(text)};
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  // The filter allows only sendmsg. A lost notification is harmless, since the next one follows.
  (void)::sendmsg(socket_.get(), &message, MSG_NOSIGNAL);
}

}  // namespace strainwave
