// SPDX-License-Identifier: BSD-3-Clause
// The receiver delivers only messages whose every byte their own sender sent, and none longer than allowed. Datagrams are raw bytes, or
// fragments with similar fields, so that they often belong together.
#include <array>
#include <vector>

#include "tests/fuzz/fuzz_input.h"
#include "transport/lcm_reassembly.h"

namespace strainwave::fuzz {
namespace {

constexpr std::size_t kLargestMessage = 300;

using Bytes = std::vector<std::uint8_t>;

struct Sent {
  LcmSource from;
  Bytes datagram;
};

void put(Bytes& bytes, std::uint64_t value, std::size_t size) {
  for (std::size_t i = size; i-- > 0;) bytes.push_back(static_cast<std::uint8_t>(value >> (8U * i)));
}

void put_some(Bytes& bytes, FuzzInput& input, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) bytes.push_back(input.byte());
}

Bytes raw(FuzzInput& input) {
  Bytes datagram;
  put_some(datagram, input, input.byte());
  return datagram;
}

Bytes short_message(FuzzInput& input) {
  Bytes datagram;
  put(datagram, 0x4c433032, 4);
  put(datagram, input.byte(), 4);
  put_some(datagram, input, input.number(2) % (2 * kLargestMessage));
  return datagram;
}

// Most offsets are those of a valid message: all parts but the last are as long as the first.
Bytes fragment(FuzzInput& input) {
  Bytes datagram;
  const std::uint8_t shape = input.byte();
  const std::uint8_t number = input.byte() % 8;
  const std::uint8_t part = input.byte() % 64;
  put(datagram, 0x4c433033, 4);
  put(datagram, shape % 4U, 4);
  put(datagram, (shape & 0x80U) != 0 ? input.number(4) : input.byte(), 4);
  put(datagram, (shape & 0x40U) != 0 ? input.number(4) : std::uint64_t{number} * part, 4);
  put(datagram, number, 2);
  put(datagram, (shape & 0x20U) != 0 ? input.number(2) : input.byte() % 9U, 2);
  if (number == 0 && (shape & 0x10U) == 0) {
    put_some(datagram, input, input.byte() % 4);
    put(datagram, 0, 1);
  }
  put_some(datagram, input, part);
  return datagram;
}

Bytes next_datagram(FuzzInput& input) {
  switch (input.byte() % 8) {
    case 0:
      return raw(input);
    case 1:
      return short_message(input);
    default:
      return fragment(input);
  }
}

// Whether the sender of `last` sent a fragment of the same message with this byte at this place.
bool was_sent(const std::vector<Sent>& sent, const Sent& last, std::size_t at, std::uint8_t byte) {
  const LcmDatagram of = parse_lcm_datagram(last.datagram);
  for (const Sent& candidate : sent) {
    if (!(candidate.from == last.from)) continue;
    const LcmDatagram part = parse_lcm_datagram(candidate.datagram);
    if (part.kind != LcmDatagram::Kind::kFragment || part.sequence != of.sequence ||
        part.message_bytes != of.message_bytes || part.count != of.count)
      continue;
    if (at >= part.offset && at - part.offset < part.part.size() && part.part[at - part.offset] == byte)
      return true;
  }
  return false;
}

void check(const LcmMessage& message, const std::vector<Sent>& sent) {
  STRAINWAVE_FUZZ_CHECK(message.bytes.size() <= kLargestMessage);
  STRAINWAVE_FUZZ_CHECK(message.channel.size() <= kMaxChannelLength);
  STRAINWAVE_FUZZ_CHECK(message.channel.find('\0') == std::string_view::npos);
  const Sent& last = sent.back();
  if (parse_lcm_datagram(last.datagram).kind == LcmDatagram::Kind::kShort) return;
  STRAINWAVE_FUZZ_CHECK(message.bytes.size() == parse_lcm_datagram(last.datagram).message_bytes);
  for (std::size_t at = 0; at < message.bytes.size(); ++at)
    STRAINWAVE_FUZZ_CHECK(was_sent(sent, last, at, message.bytes[at]));
}

}  // namespace
}  // namespace strainwave::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace strainwave::fuzz;
  FuzzInput input(data, size);
  strainwave::LcmReassembly reassembly(kLargestMessage);
  std::vector<Sent> sent;
  while (!input.empty() && sent.size() < 200) {
    const std::uint8_t source = input.byte();
    sent.push_back(
        {{0x7f000001U + source / 16U, static_cast<std::uint16_t>(source % 16U)}, next_datagram(input)});
    const auto message = reassembly.take(sent.back().from, sent.back().datagram);
    if (message) check(*message, sent);
  }
  const auto& counts = reassembly.counts();
  STRAINWAVE_FUZZ_CHECK(counts.malformed + counts.too_long + counts.interrupted <= 2 * sent.size());
  return 0;
}
