// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/can_nodes/sdo_server.h"

#include <algorithm>

namespace strainwave::can_nodes {

namespace {

constexpr std::size_t kSegmentBytes = 7;
constexpr std::size_t kExpeditedBytes = 4;

Key key_of(const Frame& request) {
  return {static_cast<std::uint16_t>(little_endian(request.bytes().subspan(1, 2))), request.data[3]};
}

}  // namespace

std::optional<Frame> SdoServer::answer(const Frame& request) {
  // An SDO always has eight bytes; anything else is no SDO and gets no answer.
  if (request.length != 8 || request.remote) return std::nullopt;
  switch (request.data[0] >> 5) {
    case 0:
      return download_segment(request);
    case 1:
      return begin_download(request);
    case 2:
      return begin_upload(request);
    case 3:
      return upload_segment(request);
    case 4:
      reset();
      return std::nullopt;
    default:
      return abort(key_of(request), Abort::kUnknownCommand);
  }
}

void SdoServer::refuse(Key key, Abort code) {
  if (code == Abort::kNone)
    refused_.erase(key);
  else
    refused_[key] = code;
}

Abort SdoServer::refused(Key key) const {
  const auto found = refused_.find(key);
  return found == refused_.end() ? Abort::kNone : found->second;
}

Frame SdoServer::reply(std::uint8_t specifier, Key key, std::uint32_t data) const {
  std::vector<std::uint8_t> bytes{specifier};
  append_little_endian(bytes, key.index, 2);
  bytes.push_back(key.sub);
  append_little_endian(bytes, data, 4);
  return {0x580U + node_id_, bytes};
}

Frame SdoServer::abort(Key key, Abort code) {
  reset();
  return reply(0x80, key, static_cast<std::uint32_t>(code));
}

Frame SdoServer::store(Key key, std::span<const std::uint8_t> bytes, std::uint8_t specifier) {
  reset();
  const Abort code = dictionary_.write(key, bytes);
  if (code != Abort::kNone) return abort(key, code);
  return specifier == 0x60 ? reply(0x60, key, 0) : Frame(0x580U + node_id_, {specifier, 0, 0, 0, 0, 0, 0, 0});
}

Frame SdoServer::begin_download(const Frame& request) {
  const Key key = key_of(request);
  const bool expedited = (request.data[0] & 0x02) != 0;
  const bool sized = (request.data[0] & 0x01) != 0;
  if (const Abort code = refused(key); code != Abort::kNone) return abort(key, code);
  if (expedited) {
    // Without a given size, the object's size decides how many of the four bytes count.
    const Object* object = dictionary_.find(key);
    const std::size_t natural = object != nullptr ? size_of(object->type) : kExpeditedBytes;
    const std::size_t size = sized ? kExpeditedBytes - ((request.data[0] >> 2) & 0x03) : natural;
    return store(key, request.bytes().subspan(4, std::min(size, kExpeditedBytes)), 0x60);
  }
  const Object* object = dictionary_.find(key);
  const std::size_t announced =
      sized ? static_cast<std::size_t>(little_endian(request.bytes().subspan(4, 4))) : 0;
  if (object != nullptr && sized && announced > size_of(object->type))
    return abort(key, Abort::kLengthTooHigh);
  transfer_ = Transfer{Direction::kDownload, key, {}, announced, 0, false};
  return reply(0x60, key, 0);
}

Frame SdoServer::download_segment(const Frame& request) {
  if (transfer_.direction != Direction::kDownload) return abort(transfer_.key, Abort::kUnknownCommand);
  const bool toggle = (request.data[0] & 0x10) != 0;
  if (toggle != transfer_.toggle) return abort(transfer_.key, Abort::kToggleBit);
  const std::size_t size = kSegmentBytes - ((request.data[0] >> 1) & 0x07);
  const auto bytes = request.bytes().subspan(1, size);
  transfer_.bytes.insert(transfer_.bytes.end(), bytes.begin(), bytes.end());
  const auto specifier = static_cast<std::uint8_t>(toggle ? 0x30 : 0x20);
  const bool last = (request.data[0] & 0x01) != 0;
  if (last) {
    const Transfer done = transfer_;
    if (done.announced_size != 0 && done.bytes.size() != done.announced_size)
      return abort(done.key, Abort::kLength);
    return store(done.key, done.bytes, specifier);
  }
  // No object here is longer than four bytes.
  if (transfer_.bytes.size() > kExpeditedBytes) return abort(transfer_.key, Abort::kLengthTooHigh);
  transfer_.toggle = !transfer_.toggle;
  return {0x580U + node_id_, {specifier, 0, 0, 0, 0, 0, 0, 0}};
}

Frame SdoServer::begin_upload(const Frame& request) {
  const Key key = key_of(request);
  if (const Abort code = refused(key); code != Abort::kNone) return abort(key, code);
  std::vector<std::uint8_t> bytes;
  if (const Abort code = dictionary_.read(key, bytes); code != Abort::kNone) return abort(key, code);
  if (!bytes.empty() && bytes.size() <= kExpeditedBytes) {
    reset();
    const auto unused = static_cast<unsigned>(kExpeditedBytes - bytes.size());
    return reply(static_cast<std::uint8_t>(0x43 | (unused << 2)), key,
                 static_cast<std::uint32_t>(little_endian(bytes)));
  }
  transfer_ = Transfer{Direction::kUpload, key, std::move(bytes), 0, 0, false};
  return reply(0x41, key, static_cast<std::uint32_t>(transfer_.bytes.size()));
}

Frame SdoServer::upload_segment(const Frame& request) {
  if (transfer_.direction != Direction::kUpload) return abort(transfer_.key, Abort::kUnknownCommand);
  const bool toggle = (request.data[0] & 0x10) != 0;
  if (toggle != transfer_.toggle) return abort(transfer_.key, Abort::kToggleBit);
  const std::size_t size = std::min(kSegmentBytes, transfer_.bytes.size() - transfer_.sent);
  const bool last = transfer_.sent + size == transfer_.bytes.size();
  std::vector<std::uint8_t> bytes{
      static_cast<std::uint8_t>((toggle ? 0x10U : 0U) | ((kSegmentBytes - size) << 1) | (last ? 1U : 0U))};
  for (std::size_t i = 0; i < kSegmentBytes; ++i)
    bytes.push_back(i < size ? transfer_.bytes[transfer_.sent + i] : std::uint8_t{0});
  transfer_.sent += size;
  transfer_.toggle = !transfer_.toggle;
  if (last) reset();
  return {0x580U + node_id_, bytes};
}

}  // namespace strainwave::can_nodes
