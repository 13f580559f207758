#include "daemon/instance_lock.h"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstring>
#include <system_error>
#include <utility>

#include "base/input_error.h"

namespace strainwave {

InstanceLock::InstanceLock(const std::string& name, const std::string& remedy)
    : socket_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
  if (socket_ < 0) throw std::system_error(errno, std::generic_category(), "creating a socket");
  // An abstract address (leading zero byte) needs no file and is freed by the kernel, however the process ends.
  const std::string path = "strainwave/" + name;
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path + 1, path.data(), std::min(path.size(), sizeof address.sun_path - 1));
  const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + path.size());
  if (::bind(socket_, reinterpret_cast<const sockaddr*>(&address), length) == 0) return;
  const int error = errno;
  ::close(socket_);
  if (error == EADDRINUSE) throw InputError("another strainwaved already runs with " + name + ": " + remedy);
  throw std::system_error(error, std::generic_category(), "taking the lock " + name);
}

InstanceLock::InstanceLock(InstanceLock&& other) noexcept : socket_(std::exchange(other.socket_, -1)) {}

InstanceLock::~InstanceLock() {
  if (socket_ >= 0) ::close(socket_);
}

}  // namespace strainwave
