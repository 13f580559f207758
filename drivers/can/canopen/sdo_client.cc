// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/can/canopen/sdo_client.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "base/printable.h"
#include "drivers/can/hexadecimal.h"

namespace strainwave::canopen {

namespace {

constexpr std::size_t kBatch = 16;
/// Waiting time for a full queue, per attempt.
constexpr std::int64_t kQueueWait_ns = 1'000'000;
constexpr int kSendAttempts = 50;
constexpr int kForgottenBatches = 1000;

}  // namespace

bool SdoError::no_such_entry() const noexcept {
  return code_ == static_cast<std::uint32_t>(SdoAbort::kNoObject) ||
         code_ == static_cast<std::uint32_t>(SdoAbort::kNoSubIndex);
}

bool SdoError::read_only() const noexcept {
  return code_ == static_cast<std::uint32_t>(SdoAbort::kReadOnly);
}

bool SdoError::no_answer() const noexcept {
  return code_ == static_cast<std::uint32_t>(SdoAbort::kTimeout);
}

SdoClient::SdoClient(CanPort& port, std::uint8_t node, std::string who, std::int64_t timeout_ns)
    : port_(port), node_(node), who_(std::move(who)), timeout_ns_(timeout_ns) {}

std::string SdoClient::failure(const SdoTransfer& transfer, const char* doing) const {
  return who_ + ": node " + std::to_string(node_) + ": " + doing + " " + to_text(transfer.entry()) + ": " +
         std::string(sdo_abort_text(transfer.abort_code())) + " (" + hexadecimal(transfer.abort_code(), 8) +
         ")";
}

void SdoClient::send(const CanFrame& frame) {
  for (int attempt = 0; attempt < kSendAttempts; ++attempt) {
    const SendResult result = port_.send(frame);
    if (result == SendResult::kSent) return;
    if (result == SendResult::kLinkDown) throw InputError(who_ + ": the CAN interface is down or gone");
    (void)port_.wait(kQueueWait_ns);
  }
  throw InputError(
      who_ +
      ": the CAN interface's queue stays full: no node acknowledges; check cable, termination, bit rate "
      "and the drives' supply");
}

std::optional<CanFrame> SdoClient::next_frame(std::uint32_t id, std::int64_t deadline_ns) {
  for (;;) {
    for (; next_ < arrived_.size(); ++next_) {
      const ReceivedFrame& frame = arrived_[next_];
      if (frame.kind == ReceivedFrame::Kind::kData && frame.frame.id == id) return arrived_[next_++].frame;
    }
    arrived_.resize(kBatch);
    const ReceiveResult result = port_.receive(arrived_);
    arrived_.resize(result.count);
    next_ = 0;
    if (result.link != CanLink::kUp) throw InputError(who_ + ": the CAN interface is down or gone");
    if (result.count > 0) continue;
    const std::int64_t left_ns = deadline_ns - port_.now_ns();
    if (left_ns <= 0) return std::nullopt;
    (void)port_.wait(left_ns);
  }
}

// The number of batches is limited so that a flooded bus cannot keep this thread here. An earlier link loss is skipped as well.
void SdoClient::forget_arrived() {
  for (int batch = 0; batch < kForgottenBatches; ++batch) {
    arrived_.resize(kBatch);
    const ReceiveResult result = port_.receive(arrived_);
    if (result.count == 0 && result.link == CanLink::kUp) break;
  }
  arrived_.clear();
  next_ = 0;
}

void SdoClient::run(SdoTransfer& transfer) {
  // Late answers of transfers that were given up must not count for this one.
  forget_arrived();
  send(transfer.request());
  std::int64_t deadline_ns = port_.now_ns() + timeout_ns_;
  while (transfer.state() == SdoTransfer::State::kBusy) {
    const auto frame = next_frame(cob_id(CobId::kSdoAnswer, node_), deadline_ns);
    if (!frame) {
      transfer.abort(SdoAbort::kTimeout);
      send(transfer.request());
      return;
    }
    switch (transfer.answer(*frame)) {
      case SdoTransfer::Action::kSend:
        send(transfer.request());
        deadline_ns = port_.now_ns() + timeout_ns_;
        break;
      case SdoTransfer::Action::kAbort:
        send(transfer.request());
        break;
      case SdoTransfer::Action::kIgnore:
      case SdoTransfer::Action::kFinish:
        break;
    }
  }
}

std::vector<std::uint8_t> SdoClient::upload(Entry entry) {
  SdoTransfer transfer = SdoTransfer::upload(node_, entry);
  run(transfer);
  if (transfer.state() == SdoTransfer::State::kAborted)
    throw SdoError(failure(transfer, "reading"), transfer.abort_code());
  return transfer.value();
}

std::uint64_t SdoClient::upload_number(Entry entry, std::size_t bytes) {
  const std::vector<std::uint8_t> value = upload(entry);
  // Some drives answer with four bytes for a small number and do not say how many are valid.
  const bool padded = value.size() == 4 && bytes < 4;
  if (value.size() != bytes && !padded)
    throw SdoError(who_ + ": node " + std::to_string(node_) + ": reading " + to_text(entry) + ": " +
                       counted(value.size(), "byte") + " came instead of " + std::to_string(bytes),
                   static_cast<std::uint32_t>(SdoAbort::kLengthMismatch));
  return little_endian(value.data(), bytes);
}

std::optional<std::uint64_t> SdoClient::upload_if_there(Entry entry, std::size_t bytes) {
  try {
    return upload_number(entry, bytes);
  } catch (const SdoError& error) {
    if (error.no_such_entry()) return std::nullopt;
    throw;
  }
}

std::string SdoClient::upload_text(Entry entry) {
  const std::vector<std::uint8_t> value = upload(entry);
  std::string text(value.begin(), std::find(value.begin(), value.end(), std::uint8_t{0}));
  for (char& letter : text)
    if (std::isprint(static_cast<unsigned char>(letter)) == 0) letter = '?';
  return text;
}

void SdoClient::download(Entry entry, std::uint64_t value, std::size_t bytes) {
  std::array<std::uint8_t, 8> payload{};
  put_little_endian(payload.data(), bytes, value);
  SdoTransfer transfer = SdoTransfer::download(node_, entry, std::span(payload).first(bytes));
  run(transfer);
  if (transfer.state() == SdoTransfer::State::kAborted)
    throw SdoError(failure(transfer, "writing"), transfer.abort_code());
}

void SdoClient::write_verified(const SdoWrite& write) {
  const std::uint64_t mask =
      write.bytes >= 4 ? write.verified : write.verified & ((1U << 8U * write.bytes) - 1U);
  // The abort may concern the value (an object that cannot be mapped), not the entry that is written, so the purpose is added.
  const std::uint64_t kept = [&] {
    try {
      download(write.entry, write.value, write.bytes);
      return upload_number(write.entry, write.bytes);
    } catch (const SdoError& error) {
      throw SdoError(error.what() + (", for " + write.purpose), error.code());
    }
  }();
  if ((kept & mask) == (write.value & mask)) return;
  throw InputError(who_ + ": node " + std::to_string(node_) + ": " + write.purpose + ": " +
                   to_text(write.entry) + " was set to " + hexadecimal(write.value, 2 * write.bytes) +
                   " but reads " + hexadecimal(kept, 2 * write.bytes) +
                   ": the drive does not take this value");
}

bool SdoClient::write_if_writable(const SdoWrite& write) {
  try {
    write_verified(write);
    return true;
  } catch (const SdoError& error) {
    if (error.no_such_entry()) return false;
    if (!error.read_only()) throw;
    return upload_number(write.entry, write.bytes) == write.value;
  }
}

void SdoClient::send_nmt(NmtCommand command) {
  send(nmt_frame(command, node_));
}

bool SdoClient::wait_for_state(NmtState state, std::int64_t timeout_ns) {
  const std::int64_t deadline_ns = port_.now_ns() + timeout_ns;
  while (const auto frame = next_frame(cob_id(CobId::kHeartbeat, node_), deadline_ns))
    if (decode_heartbeat(*frame) == state) return true;
  return false;
}

bool SdoClient::two_answer(Entry entry, std::int64_t wait_ns) {
  (void)upload(entry);
  const std::int64_t deadline_ns = port_.now_ns() + wait_ns;
  while (const auto frame = next_frame(cob_id(CobId::kSdoAnswer, node_), deadline_ns))
    if (little_endian(&frame->bytes[1], 2) == entry.index && frame->bytes[3] == entry.sub_index) return true;
  return false;
}

bool SdoClient::reset_communication(std::int64_t timeout_ns) {
  // A boot-up message of an earlier restart must not count.
  forget_arrived();
  send_nmt(NmtCommand::kResetCommunication);
  const std::int64_t deadline_ns = port_.now_ns() + timeout_ns;
  while (const auto frame = next_frame(cob_id(CobId::kHeartbeat, node_), deadline_ns))
    if (decode_heartbeat(*frame) == NmtState::kBootUp) return true;
  return false;
}

}  // namespace strainwave::canopen
