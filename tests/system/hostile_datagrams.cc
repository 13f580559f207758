// SPDX-License-Identifier: BSD-3-Clause
#include "tests/system/hostile_datagrams.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <strainwave/command_v1.hpp>
#include <strainwave/gain_table_v1.hpp>
#include <strainwave/setpoint_v1.hpp>
#include <thread>

#include "lcmtypes/wire.h"
#include "strainwave/vocabulary.h"
#include "tests/support/lcm_datagrams.h"

namespace strainwave::testing {

namespace {

constexpr std::uint32_t kShortMagic = 0x4c433032;
constexpr std::uint32_t kFragmentMagic = 0x4c433033;
constexpr std::size_t kLargestDatagram = 65507;
constexpr std::uint16_t kPort = 7667;
/// One in this number begins a pair of fragments that crashes LCM's library. The tests' clients are safe: the
/// library looks only at fragments of channels with a subscriber.
constexpr std::uint64_t kCrashEvery = 100;

sockaddr_in address_of(const char* host) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(kPort);
  ::inet_pton(AF_INET, host, &address.sin_addr);
  return address;
}

}  // namespace

void HostileDatagrams::put_u16(std::uint16_t value) {
  bytes_.push_back(static_cast<std::uint8_t>(value >> 8));
  bytes_.push_back(static_cast<std::uint8_t>(value));
}

void HostileDatagrams::put_u32(std::uint32_t value) {
  put_u16(static_cast<std::uint16_t>(value >> 16));
  put_u16(static_cast<std::uint16_t>(value));
}

void HostileDatagrams::put_text(const std::string& text, bool terminated) {
  bytes_.insert(bytes_.end(), text.begin(), text.end());
  if (terminated) bytes_.push_back(0);
}

void HostileDatagrams::put_random(std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) bytes_.push_back(static_cast<std::uint8_t>(random_()));
}

std::string HostileDatagrams::some_channel() {
  static const std::array<const char*, 8> kChannels{
      "SW.elbow.SETPOINT", "SW.elbow.COMMAND",  "SW.elbow.TABLE", "SW.elbow.STATE",
      "SW.elbow.ACK",      "SW.nobody.COMMAND", "SW.TIMING",      "LCM_SELF_TEST"};
  if (random_() % 8 == 0) return std::string(random_() % 200, static_cast<char>('!' + random_() % 90));
  return kChannels[random_() % kChannels.size()];
}

std::uint32_t HostileDatagrams::some_size() {
  static const std::array<std::uint32_t, 10> kSizes{0,     1,        100,        1400,       8120,
                                                    65535, 1U << 20, (1U << 28), 0x7fffffff, 0xffffffff};
  return kSizes[random_() % kSizes.size()];
}

void HostileDatagrams::noise() {
  put_random(random_() % 64);
}

void HostileDatagrams::short_message() {
  put_u32(random_() % 16 == 0 ? static_cast<std::uint32_t>(random_()) : kShortMagic);
  put_u32(++sequence_);
  put_text(some_channel(), random_() % 4 != 0);
  put_random(random_() % 200 == 0 ? 40'000 : random_() % 300);
  if (random_() % 4 == 0) bytes_.resize(random_() % (bytes_.size() + 1));
}

void HostileDatagrams::fragment() {
  put_u32(kFragmentMagic);
  put_u32(random_() % 2 == 0 ? sequence_ : ++sequence_);
  put_u32(some_size());
  // A small offset: larger ones crash LCM's library, and crashing_fragment() has them.
  put_u32(static_cast<std::uint32_t>(random_() % 3000));
  put_u16(static_cast<std::uint16_t>(random_() % 4));
  put_u16(random_() % 2 == 0 ? static_cast<std::uint16_t>(random_() % 4)
                             : static_cast<std::uint16_t>(random_()));
  if (random_() % 2 == 0) put_text(some_channel(), random_() % 4 != 0);
  put_random(random_() % 1400);
}

// LCM 1.3.1 adds offset and size in 32 bits. The sum wraps, and LCM copies 4 GiB beyond its buffer. The next
// call returns the second fragment.
void HostileDatagrams::crashing_fragment() {
  const std::vector<Bytes> pair = crashing_fragments("SW.elbow.COMMAND", ++sequence_);
  bytes_ = pair[0];
  second_ = pair[1];
}

void HostileDatagrams::order_with_random_fields() {
  put_u32(kShortMagic);
  put_u32(++sequence_);
  std::vector<std::uint8_t> order;
  switch (random_() % 3) {
    case 0:
      put_text("SW.elbow.SETPOINT", true);
      order = encode(setpoint_v1{});
      break;
    case 1:
      put_text("SW.elbow.COMMAND", true);
      order = encode(command_v1{});
      break;
    default:
      put_text("SW.elbow.TABLE", true);
      order = encode(gain_table_v1{});
      break;
  }
  // Any client may send a stop (action 2). A random action is a stop once in four thousand million.
  for (std::size_t i = 8; i < order.size(); ++i) order[i] = static_cast<std::uint8_t>(random_());
  bytes_.insert(bytes_.end(), order.begin(), order.end());
}

const std::vector<std::uint8_t>& HostileDatagrams::next() {
  bytes_.clear();
  if (!second_.empty()) {
    bytes_.swap(second_);
  } else if (random_() % kCrashEvery == 0) {
    crashing_fragment();
  } else {
    switch (random_() % 8) {
      case 0:
        noise();
        break;
      case 1:
      case 2:
      case 3:
        short_message();
        break;
      case 4:
      case 5:
        fragment();
        break;
      default:
        order_with_random_fields();
        break;
    }
  }
  if (bytes_.size() > kLargestDatagram) bytes_.resize(kLargestDatagram);
  return bytes_;
}

std::int64_t send_hostile_datagrams(std::int64_t count, std::uint64_t seed, double per_s) {
  constexpr std::int64_t kBatch = 200;
  const int socket = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  const std::array<sockaddr_in, 2> targets{address_of("239.255.76.67"), address_of("127.0.0.1")};
  HostileDatagrams datagrams(seed);
  std::int64_t sent = 0;
  const auto start = std::chrono::steady_clock::now();
  for (std::int64_t i = 0; i < count; ++i) {
    if (i % kBatch == 0)
      std::this_thread::sleep_until(
          start + std::chrono::microseconds(static_cast<std::int64_t>(static_cast<double>(i) / per_s * 1e6)));
    const auto& bytes = datagrams.next();
    const sockaddr_in& target = targets[static_cast<std::size_t>(i / 2 % 2)];
    if (::sendto(socket, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&target),
                 sizeof target) == static_cast<ssize_t>(bytes.size()))
      ++sent;
  }
  ::close(socket);
  return sent;
}

}  // namespace strainwave::testing
