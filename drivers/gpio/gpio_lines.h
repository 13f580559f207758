// SPDX-License-Identifier: BSD-3-Clause
// The digital lines of a joint by what they are for, wherever they are wired. Names are looked up once, and lines
// of one chip with the same settings are requested together. Real-time safe are read() and write() alone.
//
// True is active, whatever the polarity. Every output is inactive when it is requested and when this object
// ends: wire them so that inactive is safe.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/gpio/line_request.h"

namespace strainwave {

/// Outputs first.
enum class LineRole {
  kEnable,        ///< out: the amplifier may drive
  kDirection,     ///< out: negative torque
  kBrakeRelease,  ///< out: the brake is open
  kAlive,         ///< out: changes every period, for a hardware watchdog
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
/// Key in the configuration.
std::string_view to_text(LineRole role) noexcept;

struct LineOptions {
  std::string chip;  ///< "gpiochip0", a path, or the chip's label
  std::string line;  ///< its name, or its number on the chip
  LineBias bias = LineBias::kAsIs;
  bool active_low = false;
  double debounce_s = 0.0;  ///< of an input: it must be steady for so long; 0: believed at once
};
using JointLines = std::array<std::optional<LineOptions>, kLineRoles>;

/// Where a line is.
struct LinePlace {
  std::string chip_path;
  unsigned offset = 0;
  LineInfo info;
};
/// Throws InputError that names `where`: no such chip, no such line, several of that name.
LinePlace find_line(const LineOptions& options, const std::string& where);
/// What holds a line that could not be requested, and what to do.
std::string describe_holder(const LineInfo& info);

/// The seam that tests stand in for.
class DigitalLines {
 public:
  virtual ~DigitalLines() = default;
  /// Bits by role. False when the kernel refuses.
  virtual bool read(std::uint32_t& active) noexcept = 0;
  /// All outputs; those that changed are written.
  virtual bool write(std::uint32_t active) noexcept = 0;
};

class GpioLines final : public DigitalLines {
 public:
  /// Requests every line of `lines` but edge inputs. Throws InputError before anything is driven: missing
  /// chip, unknown or repeated line, a line that is held. `where` is how messages name the section.
  GpioLines(const JointLines& lines, const std::string& consumer, const std::string& where);
  /// Outputs inactive, then released.
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
