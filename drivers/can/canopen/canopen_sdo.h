// SPDX-License-Identifier: BSD-3-Clause
// One SDO transfer as a state machine without I/O: the frames to send and the meaning of the answers.
// Expedited and segmented, both ways. Real-time safe except for the vector of the value. Only start-up and
// background threads use it. Source: CiA 301 v4.2.0, section 7.2.4.3.
#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/can/can_frame.h"

namespace strainwave::canopen {

/// An entry of a drive's object dictionary.
struct Entry {
  std::uint16_t index = 0;
  std::uint8_t sub_index = 0;
  // clang-tidy 14 mistakes the 0 in the generated comparison for a pointer.
  auto operator<=>(const Entry&) const = default;  // NOLINT(modernize-use-nullptr)
};
/// "6076h:00"
std::string to_text(Entry entry);

/// Longer values are refused: device names are the longest values that are read.
inline constexpr std::size_t kMaxSdoBytes = 1024;

/// Abort codes that we use (CiA 301 table 22).
enum class SdoAbort : std::uint32_t {
  kToggle = 0x05030000,
  kTimeout = 0x05040000,
  kBadCommand = 0x05040001,
  kReadOnly = 0x06010002,
  kOutOfMemory = 0x05040005,
  kNoObject = 0x06020000,
  kLengthMismatch = 0x06070010,
  kNoSubIndex = 0x06090011,
  kGeneral = 0x08000000,
};
/// Returns the text of an abort code; knows every code of the standard.
std::string_view sdo_abort_text(std::uint32_t code) noexcept;

/// Returns the request that writes the lowest `bytes` (1 to 4) of `value` in one frame. Real-time safe.
CanFrame expedited_download(std::uint8_t node, Entry entry, std::uint32_t value, std::size_t bytes) noexcept;

class SdoTransfer {
 public:
  enum class State { kBusy, kDone, kAborted };
  enum class Action {
    kSend,    ///< send request() and wait for the next answer
    kIgnore,  ///< ignore the frame, which belongs to another transfer; wait on
    kFinish,  ///< state() is kDone, or the drive aborted
    kAbort,   ///< the answer was invalid: send request(), which tells the drive
  };

  /// Starts to read `entry` of `node`.
  static SdoTransfer upload(std::uint8_t node, Entry entry);
  /// Starts to write `value` of 1..kMaxSdoBytes bytes.
  static SdoTransfer download(std::uint8_t node, Entry entry, std::span<const std::uint8_t> value);

  /// The frame to send at the start, and after each kSend or kAbort.
  const CanFrame& request() const noexcept { return request_; }
  /// Takes a frame from the drive's SDO identifier.
  Action answer(const CanFrame& frame);
  /// Aborts the transfer; request() then tells the drive.
  void abort(SdoAbort reason) noexcept;

  State state() const noexcept { return state_; }
  Entry entry() const noexcept { return entry_; }
  /// The reason, when kAborted.
  std::uint32_t abort_code() const noexcept { return abort_code_; }
  /// The value read, when an upload is kDone.
  const std::vector<std::uint8_t>& value() const noexcept { return value_; }

 private:
  enum class Step { kUploadInitiate, kUploadSegment, kDownloadInitiate, kDownloadSegment };
  SdoTransfer(std::uint8_t node, Entry entry, Step step);

  Action answer_upload_initiate(const CanFrame& frame);
  Action answer_upload_segment(const CanFrame& frame);
  Action answer_download_initiate(const CanFrame& frame);
  Action answer_download_segment(const CanFrame& frame);
  Action finish() noexcept;
  Action refuse(SdoAbort reason) noexcept;
  Action ask_next_segment() noexcept;
  Action send_next_segment() noexcept;
  bool names_our_entry(const CanFrame& frame) const noexcept;
  void start_request(std::uint8_t command) noexcept;

  Entry entry_;
  Step step_;
  State state_ = State::kBusy;
  CanFrame request_;
  std::vector<std::uint8_t> value_;
  std::size_t sent_ = 0;       ///< bytes sent of a segmented download
  std::size_t announced_ = 0;  ///< length of a segmented upload; 0: unknown
  bool toggle_ = false;
  std::uint32_t abort_code_ = 0;
};

}  // namespace strainwave::canopen
