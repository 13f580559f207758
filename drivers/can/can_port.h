// SPDX-License-Identifier: BSD-3-Clause
// What the CAN drivers need from a bus: to send, to receive, and, outside the loop, to wait. CanSocket is the
// real port; tests use a scripted one in virtual time. send() and receive() are real-time safe. Only start-up
// and background threads may call wait() and now_ns().
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "drivers/can/can_frame.h"

namespace strainwave {

/// Which frames a port receives, and how it sends.
struct CanPortOptions {
  std::vector<std::uint32_t> receive_ids;  ///< only these; own frames need their identifier here as well
  bool error_frames = false;               ///< the controller's errors arrive as frames of kind kTrouble
  bool own_frames = false;  ///< every frame sent comes back, as kind kOwn, once it is on the bus
  bool urgent = false;      ///< overtakes other processes' frames in the interface's queue
};

/// Errors of controller and bus, as a bit set. Source: linux/can/error.h.
enum class CanTrouble : std::uint32_t {
  kBusOff = 1U << 0,           ///< the controller has left the bus after too many errors
  kErrorPassive = 1U << 1,     ///< more than 127 errors counted
  kErrorWarning = 1U << 2,     ///< more than 96
  kReceiveOverflow = 1U << 3,  ///< the controller lost frames
  kNoAcknowledge = 1U << 4,    ///< no other node acknowledges
  kTransmitTimeout = 1U << 5,  ///< the interface's driver gave up a frame
  kRestarted = 1U << 6,        ///< back on the bus after bus-off
  kErrorActive = 1U << 7,      ///< recovered from error-passive or warning
};

struct ReceivedFrame {
  enum class Kind : std::uint8_t { kData, kOwn, kTrouble };
  CanFrame frame;              ///< meaningless for kTrouble
  std::uint32_t troubles = 0;  ///< CanTrouble bits when kTrouble
  Kind kind = Kind::kData;
  /// CLOCK_REALTIME of the kernel when it saw the frame; use only differences between frames. 0: unknown.
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
  CanLink link = CanLink::kUp;  ///< kDown or kGone in the call that detects it
};

class CanPort {
 public:
  virtual ~CanPort() = default;
  CanPort() = default;
  CanPort(const CanPort&) = delete;
  CanPort& operator=(const CanPort&) = delete;

  /// Queues `frame` or drops it; never waits.
  virtual SendResult send(const CanFrame& frame) noexcept = 0;
  /// Takes up to `frames.size()` frames from the queue; never waits.
  virtual ReceiveResult receive(std::span<ReceivedFrame> frames) noexcept = 0;
  /// Number of frames lost since the port was opened, because the kernel's buffer was full.
  virtual std::uint32_t overflows() const noexcept = 0;

  /// Waits until a frame has arrived (true) or `timeout_ns` has passed.
  virtual bool wait(std::int64_t timeout_ns) = 0;
  /// The clock of wait(), monotonic.
  virtual std::int64_t now_ns() = 0;
};

/// Opens another port on the same bus. Throws InputError.
using CanPortFactory = std::function<std::unique_ptr<CanPort>(const CanPortOptions& options)>;

}  // namespace strainwave
