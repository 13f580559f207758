// SPDX-License-Identifier: BSD-3-Clause
// Blocking SDO transfers and network management with one node. For start-up, background threads and tools,
// never for the loop. Source: CiA 301 v4.2.0, sections 7.2.4 and 7.3.2.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/input_error.h"
#include "drivers/can/can_port.h"
#include "drivers/can/canopen/canopen.h"
#include "drivers/can/canopen/canopen_pdo.h"
#include "drivers/can/canopen/canopen_sdo.h"

namespace strainwave::canopen {

/// A failed transfer: aborted by the drive, or not answered. what() contains node, entry and reason.
class SdoError : public InputError {
 public:
  SdoError(const std::string& message, std::uint32_t code) : InputError(message), code_(code) {}
  std::uint32_t code() const noexcept { return code_; }
  /// Returns whether the drive reported that it has no such entry.
  bool no_such_entry() const noexcept;
  /// Returns whether the drive reported that the entry is read-only.
  bool read_only() const noexcept;
  /// Returns whether the drive did not answer at all.
  bool no_answer() const noexcept;

 private:
  std::uint32_t code_;
};

class SdoClient {
 public:
  /// `port` must receive the node's SDO answers and, for reset_communication(), its heartbeat. Every message
  /// begins with `who` ("elbow").
  SdoClient(CanPort& port, std::uint8_t node, std::string who, std::int64_t timeout_ns = kDefaultTimeout_ns);

  std::vector<std::uint8_t> upload(Entry entry);
  /// Reads a number of `bytes` bytes; throws SdoError for another length. Four bytes are accepted for a shorter number.
  std::uint64_t upload_number(Entry entry, std::size_t bytes);
  /// Like upload_number(), but returns nothing when the drive has no such entry.
  std::optional<std::uint64_t> upload_if_there(Entry entry, std::size_t bytes);
  /// Reads text up to the first zero; unprintable characters become '?'.
  std::string upload_text(Entry entry);

  void download(Entry entry, std::uint64_t value, std::size_t bytes);
  /// Writes and reads back; throws InputError when the drive kept another value. Its errors contain the
  /// purpose of the write.
  void write_verified(const SdoWrite& write);
  /// Returns whether the entry then has the value: false when it is missing, or read-only with another value.
  bool write_if_writable(const SdoWrite& write);

  void send_nmt(NmtCommand command);
  /// Resets the node's communication and waits for its boot-up message; false when none came.
  bool reset_communication(std::int64_t timeout_ns);
  /// Waits for a heartbeat with `state`; false when none came.
  bool wait_for_state(NmtState state, std::int64_t timeout_ns);
  /// Reads `entry` and returns whether a second node answers within `wait_ns`.
  bool two_answer(Entry entry, std::int64_t wait_ns);

  CanPort& port() noexcept { return port_; }
  std::uint8_t node() const noexcept { return node_; }
  const std::string& who() const noexcept { return who_; }

  static constexpr std::int64_t kDefaultTimeout_ns = 500'000'000;

 private:
  void run(SdoTransfer& transfer);
  /// Returns the next frame with this identifier, or nothing at `deadline_ns`. Throws InputError when the link ends.
  std::optional<CanFrame> next_frame(std::uint32_t id, std::int64_t deadline_ns);
  void forget_arrived();
  void send(const CanFrame& frame);
  std::string failure(const SdoTransfer& transfer, const char* doing) const;

  CanPort& port_;
  std::uint8_t node_;
  std::string who_;
  std::int64_t timeout_ns_;
  std::vector<ReceivedFrame> arrived_;  ///< received; those from next_ on are not examined yet
  std::size_t next_ = 0;
};

}  // namespace strainwave::canopen
