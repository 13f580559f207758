// SPDX-License-Identifier: BSD-3-Clause
// What the CAN drivers need of a bus: to send, to take what has arrived, and, before the loop runs, to wait.
// CanSocket is the real one; tests script another in virtual time. send() and receive() are real-time safe;
// wait() and now_ns() are for start-up and background threads only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "drivers/can/can_frame.h"

namespace strainwave {

/// What a port lets through, and what it tells about itself.
struct CanPortOptions {
  std::vector<std::uint32_t> receive_ids;  ///< exactly these; own frames need their id here as well
  bool error_frames = false;               ///< the controller's troubles arrive as frames of kind kTrouble
  bool own_frames = false;  ///< every frame sent comes back, as kind kOwn, once it is on the bus
  bool urgent = false;      ///< overtakes other processes' frames in the interface's queue
};

/// Troubles of controller and bus, a bit set. Source: linux/can/error.h.
enum class CanTrouble : std::uint32_t {
  kBusOff = 1U << 0,           ///< the controller has left the bus after too many errors
  kErrorPassive = 1U << 1,     ///< more than 127 errors counted
  kErrorWarning = 1U << 2,     ///< more than 96
  kReceiveOverflow = 1U << 3,  ///< the controller lost frames
  kNoAcknowledge = 1U << 4,    ///< nobody else hears
  kTransmitTimeout = 1U << 5,  ///< the interface's driver gave a frame up
  kRestarted = 1U << 6,        ///< back on the bus after bus-off
  kErrorActive = 1U << 7,      ///< recovered from error-passive or warning
};

struct ReceivedFrame {
  enum class Kind : std::uint8_t { kData, kOwn, kTrouble };
  CanFrame frame;              ///< of no meaning when kTrouble
  std::uint32_t troubles = 0;  ///< CanTrouble bits when kTrouble
  Kind kind = Kind::kData;
  /// When the kernel saw it, CLOCK_REALTIME: for differences between frames only. 0: unknown.
  std::int64_t kernel_time_ns = 0;
};

enum class CanLink : std::uint8_t {
  kUp,
  kDown,  ///< the interface is down; it may come back
  kGone,  ///< the device has vanished
};

enum class SendResult : std::uint8_t { kSent, kQueueFull, kLinkDown };

struct ReceiveResult {
  std::size_t count = 0;        ///< frames written
  CanLink link = CanLink::kUp;  ///< kDown or kGone in the call that learns of it
};

class CanPort {
 public:
  virtual ~CanPort() = default;
  CanPort() = default;
  CanPort(const CanPort&) = delete;
  CanPort& operator=(const CanPort&) = delete;

  /// Queues `frame` or drops it; never waits.
  virtual SendResult send(const CanFrame& frame) noexcept = 0;
  /// Takes up to `frames.size()` frames that have arrived; never waits.
  virtual ReceiveResult receive(std::span<ReceivedFrame> frames) noexcept = 0;
  /// Frames that the kernel lost because they were not taken, since the port was opened.
  virtual std::uint32_t overflows() const noexcept = 0;

  /// Waits until a frame has arrived (true) or `timeout_ns` has passed.
  virtual bool wait(std::int64_t timeout_ns) = 0;
  /// The clock of wait(), monotonic.
  virtual std::int64_t now_ns() = 0;
};

/// Opens another port on the same bus. Throws InputError.
using CanPortFactory = std::function<std::unique_ptr<CanPort>(const CanPortOptions& options)>;

}  // namespace strainwave
