// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/gateway/descriptor_message.h"

#include <poll.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstring>
#include <system_error>

namespace strainwave {

namespace {

constexpr int kWait_ms = 1000;
constexpr std::size_t kBytes = sizeof(int) * kPassedDescriptors;

/// A message of one byte that carries descriptors.
struct Parcel {
  Parcel() {
    message.msg_iov = &part;
    message.msg_iovlen = 1;
    message.msg_control = control;
    message.msg_controllen = sizeof control;
  }
  char byte = 0;
  alignas(cmsghdr) char control[CMSG_SPACE(kBytes)] = {};
  iovec part{&byte, 1};
  msghdr message{};
};

[[noreturn]] void fail(int error, const char* what) {
  throw std::system_error(error, std::generic_category(), what);
}

}  // namespace

void send_descriptors(int socket, const std::array<int, kPassedDescriptors>& descriptors) {
  Parcel parcel;
  cmsghdr* header = CMSG_FIRSTHDR(&parcel.message);
  header->cmsg_level = SOL_SOCKET;
  header->cmsg_type = SCM_RIGHTS;
  header->cmsg_len = CMSG_LEN(kBytes);
  std::memcpy(CMSG_DATA(header), descriptors.data(), kBytes);
  if (::sendmsg(socket, &parcel.message, MSG_NOSIGNAL) != 1) fail(errno, "sending descriptors");
}

std::array<int, kPassedDescriptors> receive_descriptors(int socket) {
  pollfd ready{socket, POLLIN, 0};
  if (::poll(&ready, 1, kWait_ms) != 1) fail(ETIMEDOUT, "waiting for descriptors");
  Parcel parcel;
  if (::recvmsg(socket, &parcel.message, 0) != 1) fail(errno == 0 ? EPROTO : errno, "receiving descriptors");
  const cmsghdr* header = CMSG_FIRSTHDR(&parcel.message);
  if (header == nullptr || header->cmsg_level != SOL_SOCKET || header->cmsg_type != SCM_RIGHTS ||
      header->cmsg_len != CMSG_LEN(kBytes))
    fail(EPROTO, "receiving descriptors");
  std::array<int, kPassedDescriptors> descriptors{};
  std::memcpy(descriptors.data(), CMSG_DATA(header), kBytes);
  return descriptors;
}

}  // namespace strainwave
