// SPDX-License-Identifier: BSD-3-Clause
// A raw SocketCAN socket as a CanPort. It is non-blocking, sets exact filters before it receives, and
// provides error frames, the kernel's count of lost frames, and software timestamps. send() and receive() are
// real-time safe; the constructor is not. Source: Linux Documentation/networking/can.rst.
#pragma once

#include <array>
#include <string>

#include "base/unique_fd.h"
#include "drivers/can/can_port.h"

namespace strainwave {

/// Returns the CanTrouble bits of an error frame from its `can_id` without the error flag, and its eight
/// bytes. 0: nothing relevant.
std::uint32_t troubles_of(std::uint32_t can_id, std::span<const std::uint8_t, kMaxCanBytes> bytes) noexcept;

class CanSocket final : public CanPort {
 public:
  /// Opens `interface_name`. Throws InputError with the remedy: no CAN in the kernel, no such interface, not
  /// a CAN interface, too many filters.
  CanSocket(const std::string& interface_name, const CanPortOptions& options);

  SendResult send(const CanFrame& frame) noexcept override;
  ReceiveResult receive(std::span<ReceivedFrame> frames) noexcept override;
  std::uint32_t overflows() const noexcept override { return overflows_; }
  bool wait(std::int64_t timeout_ns) override;
  std::int64_t now_ns() override;

  int descriptor() const noexcept { return descriptor_.get(); }

 private:
  void configure(const std::string& interface_name, const CanPortOptions& options);
  void bind_to(const std::string& interface_name);

  UniqueFd descriptor_;
  std::uint32_t overflows_ = 0;
};

}  // namespace strainwave
