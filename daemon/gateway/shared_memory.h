// SPDX-License-Identifier: BSD-3-Clause
// The memory that the core and the gateway share, and which of them may write it.
//
// Two anonymous memory files: `outbound`, written by the core and mapped read-only by the gateway (the kernel enforces
// it), and `inbound`, written by the gateway. The core treats every byte of `inbound` as hostile: it copies first and
// looks at its own copy. Plain data only. Writing a state record is real-time safe.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <strainwave/state_v1.hpp>
#include <utility>

#include "base/broadcast_ring.h"
#include "base/fixed_string.h"
#include "base/unique_fd.h"
#include "lcmtypes/wire.h"

namespace strainwave {

inline constexpr std::size_t kMaxJoints = 64;
inline constexpr std::uint64_t kSharedMemoryMagic = 0x53574d454d303130;  // "SWMEM010"

/// One joint in one cycle, from the real-time thread.
struct StateRecord {
  state_v1 state;
  double temperature_measured_C = 0.0;
  double temperature_age_s = -1.0;
  std::int64_t joint_index = 0;
  std::int64_t friction_rules_id = 0;  ///< digest of the active table's friction rules; 0: none
};

/// A message in wire form with its channel: an acknowledgement on its way out, or a command on its way in.
struct WireMessage {
  static constexpr std::size_t kMaxBytes = kLargestMessageBytes;
  FixedString<64> channel;
  std::uint64_t source = 0;  ///< on its way in: sender's address and port as a number
  std::uint64_t size = 0;
  std::array<std::uint8_t, kMaxBytes> bytes{};
};

/// Ownership of a joint, from the core; the gateway adds it to every published state.
struct JointLease {
  std::atomic<std::int64_t> owner_id{0};
  std::atomic<double> lease_s{0.0};
};

/// Written by the core only. joint_count and the names are set before the gateway starts.
struct OutboundMemory {
  static constexpr std::size_t kStateRecords = 8192;
  static constexpr std::size_t kMessages = 256;

  std::uint64_t magic = kSharedMemoryMagic;
  FixedString<32> prefix;
  FixedString<256> lcm_url;
  std::int64_t session_id = 0;
  std::int64_t gateway_uid = -1;  ///< user that the gateway becomes; -1: no change
  std::int64_t gateway_gid = -1;
  std::uint64_t joint_count = 0;
  std::array<FixedString<32>, kMaxJoints> joint_names{};
  std::atomic<std::int64_t> challenge{0};  ///< orders must quote it
  std::array<JointLease, kMaxJoints> leases{};
  BroadcastRing<StateRecord, kStateRecords> states;
  BroadcastRing<WireMessage, kMessages> messages;
  std::atomic<std::uint64_t> stops_taken{0};   ///< how many messages the core has taken from inbound.stops
  std::atomic<std::uint64_t> orders_taken{0};  ///< likewise from inbound.orders
};

/// Messages on their way to the core. The lane is short, so that most messages wait in an OrderQueue, where sources take turns.
struct InboundLane {
  static constexpr std::size_t kMessages = 32;

  std::atomic<std::uint64_t> written{0};  ///< number of messages put in so far
  std::array<WireMessage, kMessages> messages{};
};

/// Written by the gateway only.
struct InboundMemory {
  std::atomic<std::uint64_t> ready{0};  ///< 1 once LCM works
  std::atomic<std::uint64_t> turns{0};  ///< rises while the gateway runs
  InboundLane stops;                    ///< the core empties this one before it looks at the other
  InboundLane orders;
  // Counts of losses and disturbances.
  std::atomic<std::uint64_t> malformed{0};  ///< datagrams that are not LCM's, and fragments that do not match
  std::atomic<std::uint64_t> too_long{0};   ///< datagrams of messages longer than any of ours
  std::atomic<std::uint64_t> interrupted{0};  ///< fragmented messages that were given up
  std::atomic<std::uint64_t> crowded_out{0};  ///< messages for which the queue had no room
  std::atomic<std::uint64_t> state_records_dropped{0};
  std::atomic<std::uint64_t> deaf{0};  ///< gateways that ended because what they published did not come back
  std::atomic<std::uint64_t> foreign_states{0};  ///< STATE messages on our channels from another session
};

/// An anonymous memory file, mapped. Throws std::system_error. Not real-time.
class MemoryFile {
 public:
  /// A new file of `size` bytes, mapped writable; with `seal_writes` no other process can map it writable afterwards.
  static MemoryFile create(const char* name, std::size_t size, bool seal_writes);
  /// Takes over the descriptor of an existing file and maps it read-only or writable. Refuses a file smaller than `size`.
  static MemoryFile open(int descriptor, std::size_t size, bool writable);

  MemoryFile(MemoryFile&& other) noexcept;
  MemoryFile& operator=(MemoryFile&&) = delete;
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile();

  void* address() const noexcept { return address_; }
  int descriptor() const noexcept { return descriptor_.get(); }

 private:
  MemoryFile(UniqueFd descriptor, void* address, std::size_t size) noexcept
      : descriptor_(std::move(descriptor)), address_(address), size_(size) {}
  UniqueFd descriptor_;
  void* address_;
  std::size_t size_;
};

}  // namespace strainwave
