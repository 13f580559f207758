// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/can/can_socket.h"

#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <ctime>
#include <system_error>

#include "base/durations.h"
#include "base/input_error.h"

namespace strainwave {

namespace {

/// Number of frames that one system call receives.
constexpr std::size_t kBatch = 32;
/// The highest priority that needs no privilege (TC_PRIO_INTERACTIVE).
constexpr int kUrgentPriority = 6;
constexpr can_err_mask_t kWantedErrors =
    CAN_ERR_TX_TIMEOUT | CAN_ERR_CRTL | CAN_ERR_ACK | CAN_ERR_BUSOFF | CAN_ERR_RESTARTED;

constexpr std::uint32_t bit(CanTrouble trouble) noexcept {
  return static_cast<std::uint32_t>(trouble);
}

[[noreturn]] void fail(const std::string& what) {
  throw std::system_error(errno, std::generic_category(), what);
}

template <typename Value>
void set_option(int descriptor, int level, int name, const Value& value, const char* what) {
  if (::setsockopt(descriptor, level, name, &value, sizeof value) != 0) fail(what);
}

int open_socket() {
  const int descriptor = ::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW);
  if (descriptor >= 0) return descriptor;
  if (errno == EAFNOSUPPORT || errno == EPROTONOSUPPORT)
    throw InputError(
        "this kernel offers no CAN sockets (or this process may not open them): load the module can_raw, "
        "and allow AF_CAN in the service's RestrictAddressFamilies");
  fail("opening a CAN socket");
}

CanLink link_of(int error) noexcept {
  switch (error) {
    case ENETDOWN:
      return CanLink::kDown;
    case ENODEV:
    case ENXIO:
      return CanLink::kGone;
    default:
      return CanLink::kUp;
  }
}

/// Buffers of one recvmmsg().
struct Batch {
  std::array<can_frame, kBatch> frames;
  std::array<iovec, kBatch> vectors;
  std::array<mmsghdr, kBatch> messages;
  static constexpr std::size_t kControlBytes =
      CMSG_SPACE(sizeof(timespec)) + CMSG_SPACE(sizeof(std::uint32_t));
  struct alignas(cmsghdr) Control {
    std::array<char, kControlBytes> bytes;
  };
  std::array<Control, kBatch> controls;
};

void prepare(Batch& batch, std::size_t count) noexcept {
  for (std::size_t i = 0; i < count; ++i) {
    batch.vectors[i] = {&batch.frames[i], sizeof(can_frame)};
    batch.messages[i] = {};
    batch.messages[i].msg_hdr.msg_iov = &batch.vectors[i];
    batch.messages[i].msg_hdr.msg_iovlen = 1;
    batch.messages[i].msg_hdr.msg_control = batch.controls[i].bytes.data();
    batch.messages[i].msg_hdr.msg_controllen = batch.controls[i].bytes.size();
  }
}

void read_control(msghdr& header, ReceivedFrame& frame, std::uint32_t& overflows) noexcept {
  for (cmsghdr* control = CMSG_FIRSTHDR(&header); control != nullptr;
       control = CMSG_NXTHDR(&header, control)) {
    if (control->cmsg_level != SOL_SOCKET) continue;
    if (control->cmsg_type == SO_TIMESTAMPNS) {
      timespec time{};
      std::memcpy(&time, CMSG_DATA(control), sizeof time);
      frame.kernel_time_ns = nanoseconds(time);
    } else if (control->cmsg_type == SO_RXQ_OVFL) {
      std::memcpy(&overflows, CMSG_DATA(control), sizeof overflows);
    }
  }
}

/// Returns whether `raw` is a frame that a driver can use.
bool translate(const can_frame& raw, int flags, ReceivedFrame& frame) noexcept {
  if ((raw.can_id & CAN_ERR_FLAG) != 0) {
    frame.kind = ReceivedFrame::Kind::kTrouble;
    frame.troubles = troubles_of(raw.can_id & CAN_ERR_MASK, raw.data);
    return frame.troubles != 0;
  }
  if ((raw.can_id & (CAN_EFF_FLAG | CAN_RTR_FLAG)) != 0 || raw.can_dlc > CAN_MAX_DLEN) return false;
  frame.kind = (flags & MSG_CONFIRM) != 0 ? ReceivedFrame::Kind::kOwn : ReceivedFrame::Kind::kData;
  frame.frame.id = raw.can_id & CAN_SFF_MASK;
  frame.frame.size = raw.can_dlc;
  std::copy_n(raw.data, raw.can_dlc, frame.frame.bytes.begin());
  return true;
}

}  // namespace

std::uint32_t troubles_of(std::uint32_t can_id, std::span<const std::uint8_t, kMaxCanBytes> bytes) noexcept {
  std::uint32_t troubles = 0;
  if ((can_id & CAN_ERR_BUSOFF) != 0) troubles |= bit(CanTrouble::kBusOff);
  if ((can_id & CAN_ERR_RESTARTED) != 0) troubles |= bit(CanTrouble::kRestarted);
  if ((can_id & CAN_ERR_ACK) != 0) troubles |= bit(CanTrouble::kNoAcknowledge);
  if ((can_id & CAN_ERR_TX_TIMEOUT) != 0) troubles |= bit(CanTrouble::kTransmitTimeout);
  if ((can_id & CAN_ERR_CRTL) != 0) {
    const unsigned controller = bytes[1];
    if ((controller & (CAN_ERR_CRTL_RX_PASSIVE | CAN_ERR_CRTL_TX_PASSIVE)) != 0)
      troubles |= bit(CanTrouble::kErrorPassive);
    if ((controller & (CAN_ERR_CRTL_RX_WARNING | CAN_ERR_CRTL_TX_WARNING)) != 0)
      troubles |= bit(CanTrouble::kErrorWarning);
    if ((controller & (CAN_ERR_CRTL_RX_OVERFLOW | CAN_ERR_CRTL_TX_OVERFLOW)) != 0)
      troubles |= bit(CanTrouble::kReceiveOverflow);
    if ((controller & CAN_ERR_CRTL_ACTIVE) != 0) troubles |= bit(CanTrouble::kErrorActive);
  }
  return troubles;
}

CanSocket::CanSocket(const std::string& interface_name, const CanPortOptions& options)
    : descriptor_(open_socket()) {
  configure(interface_name, options);
}

// The filters come before bind(): an unbound socket receives nothing, and afterwards only the filtered frames.
void CanSocket::configure(const std::string& interface_name, const CanPortOptions& options) {
  std::vector<can_filter> filters;
  for (const std::uint32_t id : options.receive_ids)
    filters.push_back({id, CAN_SFF_MASK | CAN_EFF_FLAG | CAN_RTR_FLAG});
  if (filters.size() > CAN_RAW_FILTER_MAX)
    throw InputError(interface_name + ": " + std::to_string(filters.size()) +
                     " identifiers are too many for one socket: put the joints on several buses");
  const auto bytes = static_cast<socklen_t>(filters.size() * sizeof(can_filter));
  if (::setsockopt(descriptor_.get(), SOL_CAN_RAW, CAN_RAW_FILTER, filters.data(), bytes) != 0)
    fail("setting CAN filters");
  const can_err_mask_t errors = options.error_frames ? kWantedErrors : 0U;
  set_option(descriptor_.get(), SOL_CAN_RAW, CAN_RAW_ERR_FILTER, errors, "asking for CAN error frames");
  set_option(descriptor_.get(), SOL_CAN_RAW, CAN_RAW_RECV_OWN_MSGS, options.own_frames ? 1 : 0,
             "asking for own CAN frames");
  set_option(descriptor_.get(), SOL_SOCKET, SO_TIMESTAMPNS, 1, "asking for timestamps");
  set_option(descriptor_.get(), SOL_SOCKET, SO_RXQ_OVFL, 1, "asking for the count of lost frames");
  if (options.urgent)
    set_option(descriptor_.get(), SOL_SOCKET, SO_PRIORITY, kUrgentPriority, "raising the priority");
  bind_to(interface_name);
}

void CanSocket::bind_to(const std::string& interface_name) {
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = static_cast<int>(::if_nametoindex(interface_name.c_str()));
  if (address.can_ifindex == 0)
    throw InputError(interface_name + ": there is no such interface: see `ip link`, and plug the adapter in");
  if (::bind(descriptor_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) return;
  if (errno == ENODEV) throw InputError(interface_name + ": is not a CAN interface");
  fail("binding to " + interface_name);
}

SendResult CanSocket::send(const CanFrame& frame) noexcept {
  can_frame raw{};
  raw.can_id = frame.id | (frame.remote ? CAN_RTR_FLAG : 0U);
  raw.can_dlc = std::min<std::uint8_t>(frame.size, CAN_MAX_DLEN);
  std::copy_n(frame.bytes.begin(), raw.can_dlc, raw.data);
  if (::send(descriptor_.get(), &raw, sizeof raw, MSG_DONTWAIT) == sizeof raw) return SendResult::kSent;
  // ENOBUFS: the interface's queue is full. EAGAIN: the socket's queue is full. Any other error of a working
  // link is a lost frame as well.
  return link_of(errno) == CanLink::kUp ? SendResult::kQueueFull : SendResult::kLinkDown;
}

ReceiveResult CanSocket::receive(std::span<ReceivedFrame> frames) noexcept {
  ReceiveResult result;
  Batch batch;
  // The limit counts all received frames, also useless ones, so that a flooded bus cannot keep the loop here.
  for (std::size_t taken = 0; taken < frames.size();) {
    const std::size_t wanted = std::min(kBatch, frames.size() - taken);
    prepare(batch, wanted);
    const int got = ::recvmmsg(descriptor_.get(), batch.messages.data(), static_cast<unsigned>(wanted),
                               MSG_DONTWAIT, nullptr);
    if (got < 0) {
      result.link = link_of(errno);
      return result;
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(got); ++i) {
      ReceivedFrame& frame = frames[result.count] = {};
      read_control(batch.messages[i].msg_hdr, frame, overflows_);
      if (batch.messages[i].msg_len != sizeof(can_frame)) continue;
      if (translate(batch.frames[i], batch.messages[i].msg_hdr.msg_flags, frame)) ++result.count;
    }
    taken += static_cast<std::size_t>(got);
    if (static_cast<std::size_t>(got) < wanted) return result;
  }
  return result;
}

bool CanSocket::wait(std::int64_t timeout_ns) {
  const timespec timeout = to_timespec(std::max<std::int64_t>(timeout_ns, 0));
  pollfd waited{descriptor_.get(), POLLIN, 0};
  return ::ppoll(&waited, 1, &timeout, nullptr) > 0;
}

std::int64_t CanSocket::now_ns() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return nanoseconds(now);
}

}  // namespace strainwave
