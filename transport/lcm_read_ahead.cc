// SPDX-License-Identifier: BSD-3-Clause
#include "transport/lcm_read_ahead.h"

#include <poll.h>
#include <pthread.h>
#include <sys/eventfd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>

#include "base/utime.h"

namespace strainwave {

namespace {

UniqueFd make_event() {
  UniqueFd event(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK));
  if (!event) throw std::system_error(errno, std::generic_category(), "making an event");
  return event;
}

void signal(const UniqueFd& event) noexcept {
  ::eventfd_write(event.get(), 1);
}

void clear(const UniqueFd& event) noexcept {
  eventfd_t count = 0;
  ::eventfd_read(event.get(), &count);
}

/// While it lives, new threads start with all signals blocked, so that signals go to the threads that wait for them.
class WithoutSignals {
 public:
  WithoutSignals() {
    sigset_t all;
    ::sigfillset(&all);
    ::pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~WithoutSignals() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  WithoutSignals(const WithoutSignals&) = delete;
  WithoutSignals& operator=(const WithoutSignals&) = delete;

 private:
  sigset_t before_{};
};

}  // namespace

LcmReadAhead::LcmReadAhead(LcmSocket& socket, std::size_t room_bytes)
    : socket_(socket), room_bytes_(room_bytes), filled_(make_event()), stop_(make_event()) {
  filling_.reserve(room_bytes_);
  taking_.reserve(room_bytes_);
  const WithoutSignals masked;
  thread_ = std::jthread([this](const std::stop_token& stop) { read(stop); });
}

LcmReadAhead::~LcmReadAhead() {
  thread_.request_stop();
  signal(stop_);
}

void LcmReadAhead::read(const std::stop_token& stop) {
  std::array<pollfd, 2> descriptors{{{socket_.descriptor(), POLLIN, 0}, {stop_.get(), POLLIN, 0}}};
  while (!stop.stop_requested()) {
    if (::poll(descriptors.data(), descriptors.size(), LcmSocket::kLookEvery_ms) < 0) continue;
    const std::int64_t received_us = utime_now();
    socket_.follow_route();
    const std::scoped_lock lock(mutex_);
    const bool waiting = !filling_.empty();
    socket_.receive([&](const LcmSource& from, std::span<const std::uint8_t> datagram) {
      put({from, static_cast<std::uint32_t>(datagram.size()), received_us}, datagram);
    });
    if (!waiting && !filling_.empty()) signal(filled_);
  }
}

// Stores a datagram completely, or drops it.
void LcmReadAhead::put(const Head& head, std::span<const std::uint8_t> datagram) {
  const std::size_t begin = filling_.size();
  if (begin + sizeof head + datagram.size() > room_bytes_) {
    dropped_.fetch_add(1, std::memory_order_relaxed);
    return;
  }
  filling_.resize(begin + sizeof head);
  std::memcpy(filling_.data() + begin, &head, sizeof head);
  filling_.insert(filling_.end(), datagram.begin(), datagram.end());
}

void LcmReadAhead::fetch() {
  taking_.clear();
  taken_bytes_ = 0;
  const std::scoped_lock lock(mutex_);
  clear(filled_);
  filling_.swap(taking_);
}

std::size_t LcmReadAhead::receive(const Take& take) {
  if (taken_bytes_ == taking_.size()) fetch();
  std::size_t count = 0;
  for (; count < LcmSocket::kBatch && taken_bytes_ < taking_.size(); ++count) {
    Head head;
    std::memcpy(&head, taking_.data() + taken_bytes_, sizeof head);
    taken_bytes_ += sizeof head;
    const auto datagram = std::span(taking_).subspan(taken_bytes_, head.bytes);
    taken_bytes_ += head.bytes;
    take(head.from, head.received_us, datagram);
  }
  return count;
}

}  // namespace strainwave
