// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/can/canopen/canopen_sdo.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdio>

#include "drivers/can/canopen/canopen.h"

namespace strainwave::canopen {

namespace {

// Command specifiers in bits 7..5 of the first byte: client is this daemon, server is the drive.
constexpr unsigned kSpecifierShift = 5;
constexpr std::uint8_t kClientDownloadSegment = 0;
constexpr std::uint8_t kClientDownload = 1;
constexpr std::uint8_t kClientUpload = 2;
constexpr std::uint8_t kClientUploadSegment = 3;
constexpr std::uint8_t kServerUploadSegment = 0;
constexpr std::uint8_t kServerDownloadSegment = 1;
constexpr std::uint8_t kServerUpload = 2;
constexpr std::uint8_t kServerDownload = 3;
constexpr std::uint8_t kAbort = 4;

constexpr std::uint8_t kExpedited = 0x02;
constexpr std::uint8_t kSizeTold = 0x01;
constexpr std::uint8_t kToggleBit = 0x10;
constexpr std::uint8_t kLastSegment = 0x01;
constexpr std::size_t kExpeditedBytes = 4;
constexpr std::size_t kSegmentBytes = 7;

constexpr std::uint8_t command(std::uint8_t specifier) noexcept {
  return static_cast<std::uint8_t>(specifier << kSpecifierShift);
}
constexpr std::uint8_t specifier_of(const CanFrame& frame) noexcept {
  return static_cast<std::uint8_t>(frame.bytes[0] >> kSpecifierShift);
}

}  // namespace

std::string to_text(Entry entry) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "%04Xh:%02X", static_cast<unsigned>(entry.index),
                static_cast<unsigned>(entry.sub_index));
  return text.data();
}

CanFrame expedited_download(std::uint8_t node, Entry entry, std::uint32_t value, std::size_t bytes) noexcept {
  assert(bytes >= 1 && bytes <= kExpeditedBytes);
  CanFrame frame;
  frame.id = cob_id(CobId::kSdoRequest, node);
  frame.size = kMaxCanBytes;
  frame.bytes[0] = static_cast<std::uint8_t>(command(kClientDownload) | (kExpeditedBytes - bytes) << 2U |
                                             kExpedited | kSizeTold);
  put_little_endian(&frame.bytes[1], 2, entry.index);
  frame.bytes[3] = entry.sub_index;
  put_little_endian(&frame.bytes[4], bytes, value);
  return frame;
}

SdoTransfer::SdoTransfer(std::uint8_t node, Entry entry, Step step) : entry_(entry), step_(step) {
  request_.id = cob_id(CobId::kSdoRequest, node);
  request_.size = kMaxCanBytes;
}

void SdoTransfer::start_request(std::uint8_t first_byte) noexcept {
  request_.bytes = {};
  request_.bytes[0] = first_byte;
  put_little_endian(&request_.bytes[1], 2, entry_.index);
  request_.bytes[3] = entry_.sub_index;
}

SdoTransfer SdoTransfer::upload(std::uint8_t node, Entry entry) {
  SdoTransfer transfer(node, entry, Step::kUploadInitiate);
  transfer.start_request(command(kClientUpload));
  return transfer;
}

SdoTransfer SdoTransfer::download(std::uint8_t node, Entry entry, std::span<const std::uint8_t> value) {
  assert(!value.empty() && value.size() <= kMaxSdoBytes);
  SdoTransfer transfer(node, entry, Step::kDownloadInitiate);
  transfer.value_.assign(value.begin(), value.end());
  if (value.size() <= kExpeditedBytes) {
    const auto number = static_cast<std::uint32_t>(little_endian(value.data(), value.size()));
    transfer.request_ = expedited_download(node, entry, number, value.size());
  } else {
    transfer.start_request(static_cast<std::uint8_t>(command(kClientDownload) | kSizeTold));
    put_little_endian(&transfer.request_.bytes[4], 4, value.size());
  }
  return transfer;
}

SdoTransfer::Action SdoTransfer::answer(const CanFrame& frame) {
  if (state_ != State::kBusy) return Action::kIgnore;
  if (frame.size != kMaxCanBytes) return Action::kIgnore;
  if (specifier_of(frame) == kAbort) {
    // The abort of an earlier transfer, which we gave up, carries another entry.
    if (!names_our_entry(frame)) return Action::kIgnore;
    state_ = State::kAborted;
    abort_code_ = static_cast<std::uint32_t>(little_endian(&frame.bytes[4], 4));
    return Action::kFinish;
  }
  switch (step_) {
    case Step::kUploadInitiate:
      return answer_upload_initiate(frame);
    case Step::kUploadSegment:
      return answer_upload_segment(frame);
    case Step::kDownloadInitiate:
      return answer_download_initiate(frame);
    case Step::kDownloadSegment:
      return answer_download_segment(frame);
  }
  return Action::kIgnore;
}

bool SdoTransfer::names_our_entry(const CanFrame& frame) const noexcept {
  return little_endian(&frame.bytes[1], 2) == entry_.index && frame.bytes[3] == entry_.sub_index;
}

SdoTransfer::Action SdoTransfer::answer_upload_initiate(const CanFrame& frame) {
  // A late answer to a transfer that was given up has another entry or specifier.
  if (specifier_of(frame) != kServerUpload || !names_our_entry(frame)) return Action::kIgnore;
  const std::uint8_t first = frame.bytes[0];
  const bool size_told = (first & kSizeTold) != 0;
  if ((first & kExpedited) != 0) {
    const std::size_t unused = size_told ? (first >> 2U) & 3U : 0U;
    value_.assign(&frame.bytes[4], &frame.bytes[4] + kExpeditedBytes - unused);
    return finish();
  }
  announced_ = size_told ? static_cast<std::size_t>(little_endian(&frame.bytes[4], 4)) : 0;
  if (announced_ > kMaxSdoBytes) return refuse(SdoAbort::kOutOfMemory);
  step_ = Step::kUploadSegment;
  return ask_next_segment();
}

SdoTransfer::Action SdoTransfer::ask_next_segment() noexcept {
  request_.bytes = {};
  request_.bytes[0] = static_cast<std::uint8_t>(command(kClientUploadSegment) | (toggle_ ? kToggleBit : 0));
  return Action::kSend;
}

SdoTransfer::Action SdoTransfer::answer_upload_segment(const CanFrame& frame) {
  const std::uint8_t first = frame.bytes[0];
  if (specifier_of(frame) != kServerUploadSegment) return refuse(SdoAbort::kBadCommand);
  if (((first & kToggleBit) != 0) != toggle_) return refuse(SdoAbort::kToggle);
  const std::size_t count = kSegmentBytes - ((first >> 1U) & 7U);
  if (value_.size() + count > kMaxSdoBytes) return refuse(SdoAbort::kOutOfMemory);
  value_.insert(value_.end(), &frame.bytes[1], &frame.bytes[1] + count);
  if ((first & kLastSegment) != 0) {
    if (announced_ != 0 && value_.size() != announced_) return refuse(SdoAbort::kLengthMismatch);
    return finish();
  }
  if (announced_ != 0 && value_.size() >= announced_) return refuse(SdoAbort::kLengthMismatch);
  // Empty segments could make the transfer endless.
  if (count == 0) return refuse(SdoAbort::kLengthMismatch);
  toggle_ = !toggle_;
  return ask_next_segment();
}

SdoTransfer::Action SdoTransfer::answer_download_initiate(const CanFrame& frame) {
  if (specifier_of(frame) != kServerDownload || !names_our_entry(frame)) return Action::kIgnore;
  if (value_.size() <= kExpeditedBytes) return finish();
  step_ = Step::kDownloadSegment;
  return send_next_segment();
}

SdoTransfer::Action SdoTransfer::send_next_segment() noexcept {
  const std::size_t count = std::min(kSegmentBytes, value_.size() - sent_);
  const bool last = sent_ + count == value_.size();
  request_.bytes = {};
  const auto unused = static_cast<std::uint8_t>((kSegmentBytes - count) << 1U);
  request_.bytes[0] = static_cast<std::uint8_t>(command(kClientDownloadSegment) | (toggle_ ? kToggleBit : 0) |
                                                unused | (last ? kLastSegment : 0));
  std::copy_n(value_.begin() + static_cast<std::ptrdiff_t>(sent_), count, request_.bytes.begin() + 1);
  sent_ += count;
  return Action::kSend;
}

SdoTransfer::Action SdoTransfer::answer_download_segment(const CanFrame& frame) {
  if (specifier_of(frame) != kServerDownloadSegment) return refuse(SdoAbort::kBadCommand);
  if (((frame.bytes[0] & kToggleBit) != 0) != toggle_) return refuse(SdoAbort::kToggle);
  if (sent_ == value_.size()) return finish();
  toggle_ = !toggle_;
  return send_next_segment();
}

SdoTransfer::Action SdoTransfer::finish() noexcept {
  state_ = State::kDone;
  return Action::kFinish;
}

SdoTransfer::Action SdoTransfer::refuse(SdoAbort reason) noexcept {
  abort(reason);
  return Action::kAbort;
}

void SdoTransfer::abort(SdoAbort reason) noexcept {
  state_ = State::kAborted;
  abort_code_ = static_cast<std::uint32_t>(reason);
  start_request(command(kAbort));
  put_little_endian(&request_.bytes[4], 4, abort_code_);
}

}  // namespace strainwave::canopen
