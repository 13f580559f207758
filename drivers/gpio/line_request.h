// SPDX-License-Identifier: BSD-3-Clause
// Lines of one GPIO chip, requested together with the same settings. It hides libgpiod, which has two
// incompatible APIs: line_request_v1.cc is for 1.6 (Debian 12), line_request_v2.cc for 2.x (Debian 13). The
// build selects one with pkg-config. Only read() and write() are real-time safe; each makes one system call.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace strainwave {

enum class LineBias { kAsIs, kOff, kPullUp, kPullDown };
enum class LineDirection { kAsIs, kInput, kOutput };

/// What the kernel reports about a line that is not requested.
struct LineInfo {
  unsigned offset = 0;
  std::string name;      ///< empty: none
  std::string consumer;  ///< name of the holder; empty: no holder, or one without a name
  bool held = false;
  bool output = false;
  bool active_low = false;
};

/// Label of the chip at `path`, such as "gpio-0-31". Throws std::system_error.
std::string chip_label(const std::string& path);
/// Every line of the chip at `path`. Throws std::system_error.
std::vector<LineInfo> list_lines(const std::string& path);

class LineRequest {
 public:
  struct Settings {
    std::string chip_path;
    std::string consumer;
    LineDirection direction = LineDirection::kInput;  ///< the request itself sets outputs inactive
    LineBias bias = LineBias::kAsIs;
    bool active_low = false;
    std::vector<unsigned> offsets;  ///< 1 to 32
  };

  /// Throws std::system_error: EBUSY when another process holds a line.
  explicit LineRequest(const Settings& settings);
  LineRequest(LineRequest&&) noexcept;
  ~LineRequest();
  LineRequest(const LineRequest&) = delete;
  LineRequest& operator=(const LineRequest&) = delete;
  LineRequest& operator=(LineRequest&&) = delete;

  /// Bit i: line i of the settings is active. Returns false when the kernel refuses.
  bool read(std::uint32_t& active) noexcept;
  /// Sets the outputs, bits as in read(). Returns false when the kernel refuses.
  bool write(std::uint32_t active) noexcept;

 private:
  struct Handle;
  std::unique_ptr<Handle> handle_;
};

}  // namespace strainwave
