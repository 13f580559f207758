// SPDX-License-Identifier: BSD-3-Clause
// The digital lines of a joint, by role. Names are looked up once, and lines of one chip with the same
// settings share one request. Only read() and write() are real-time safe.
//
// True means active, whatever the polarity. Every output is inactive when it is requested and when this
// object is destroyed: wire the outputs so that inactive is safe.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/gpio/line_request.h"

namespace strainwave {

/// Outputs come first, edge inputs last.
enum class LineRole {
  kEnable,        ///< out: the amplifier may drive
  kDirection,     ///< out: active for negative torque
  kBrakeRelease,  ///< out: active opens the brake
  kAlive,         ///< out: toggles in every period, for a hardware watchdog
  kAmplifierFault,
  kEmergencyStop,
  kNegativeLimit,
  kPositiveLimit,
  kHome,
  kIndex,        ///< edges, see edge_events.h
  kQuadratureA,  ///< edges
  kQuadratureB,  ///< edges
};
inline constexpr std::size_t kLineRoles = 12;
constexpr bool is_output(LineRole role) noexcept {
  return role <= LineRole::kAlive;
}
constexpr bool is_edge_input(LineRole role) noexcept {
  return role >= LineRole::kIndex;
}
constexpr std::uint32_t bit(LineRole role) noexcept {
  return 1U << static_cast<unsigned>(role);
}
/// Returns the key in the configuration.
std::string_view to_text(LineRole role) noexcept;

struct LineOptions {
  std::string chip;  ///< "gpiochip0", a path, or the chip's label
  std::string line;  ///< name of the line, or its number on the chip
  LineBias bias = LineBias::kAsIs;
  bool active_low = false;
  double debounce_s = 0.0;  ///< time for which an input must be steady; 0: accepted at once
};
using JointLines = std::array<std::optional<LineOptions>, kLineRoles>;

/// Location of a line.
struct LinePlace {
  std::string chip_path;
  unsigned offset = 0;
  LineInfo info;
};
/// Throws InputError with `where`: chip or line missing, or several lines with this name.
LinePlace find_line(const LineOptions& options, const std::string& where);
/// Returns the holder of a line that could not be requested, and the remedy.
std::string describe_holder(const LineInfo& info);

/// Interface that tests replace.
class DigitalLines {
 public:
  virtual ~DigitalLines() = default;
  /// Reads the inputs, bits by role. Returns false when the kernel refuses.
  virtual bool read(std::uint32_t& active) noexcept = 0;
  /// Sets all outputs; only changed lines are written.
  virtual bool write(std::uint32_t active) noexcept = 0;
};

class GpioLines final : public DigitalLines {
 public:
  /// Requests every line of `lines` except edge inputs. Throws InputError before it drives any output:
  /// missing chip, unknown or repeated line, a line that is held. `where` names the section in messages.
  GpioLines(const JointLines& lines, const std::string& consumer, const std::string& where);
  /// Sets the outputs inactive, then releases the lines.
  ~GpioLines() override;
  GpioLines(const GpioLines&) = delete;
  GpioLines& operator=(const GpioLines&) = delete;

  bool read(std::uint32_t& active) noexcept override;
  bool write(std::uint32_t active) noexcept override;

 private:
  struct Group {
    LineRequest::Settings settings;
    std::vector<LineRole> roles;
  };
  struct Requested {
    LineRequest request;
    std::vector<LineRole> roles;
    bool output;
    std::uint32_t written = 0;
  };
  static std::vector<Group> group(const JointLines& lines, const std::string& consumer,
                                  const std::string& where);

  std::vector<Requested> requests_;
};

}  // namespace strainwave
