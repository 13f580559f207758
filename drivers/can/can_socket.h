// SPDX-License-Identifier: BSD-3-Clause
// A raw SocketCAN socket behind CanPort: non-blocking, exact filters set before it hears anything, error
// frames, the kernel's count of lost frames, software timestamps. send() and receive() are real-time safe and
// make one system call each; the constructor is not. Source: Linux Documentation/networking/can.rst.
#pragma once

#include <array>
#include <string>

#include "base/unique_fd.h"
#include "drivers/can/can_port.h"

namespace strainwave {

/// The CanTrouble bits of an error frame: `can_id` with its flag taken off, and its eight bytes. 0: nothing
/// that matters.
std::uint32_t troubles_of(std::uint32_t can_id, std::span<const std::uint8_t, kMaxCanBytes> bytes) noexcept;

class CanSocket final : public CanPort {
 public:
  /// Opens `interface_name`. Throws InputError that says what to do: no CAN in the kernel, no such interface,
  /// not a CAN interface, too many filters.
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
