// SPDX-License-Identifier: BSD-3-Clause
// Checks of the fields of a gain table, with words for the first defect. Not real-time.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/fixed_string.h"
#include "base/printable.h"

namespace strainwave {

/// Collects the first defect only: every check after it is skipped.
class TableInspector {
 public:
  /// low <= value <= high, not NaN.
  void in_range(const std::string& key, double value, double low, double high) {
    if (found_ || (value >= low && value <= high)) return;
    found_ =
        key + " = " + number_text(value) + ": must be from " + number_text(low) + " to " + number_text(high);
  }
  /// 0 < value <= high.
  void positive(const std::string& key, double value, double high) {
    if (found_ || (value > 0.0 && value <= high)) return;
    found_ = key + " = " + number_text(value) + ": must be above 0 and at most " + number_text(high);
  }
  void require(bool condition, const std::string& message) {
    if (!found_ && !condition) found_ = message;
  }
  /// Printable ASCII, terminated, zeros after it: the bytes are compared and printed as they are.
  template <std::size_t N>
  void text(const std::string& key, const FixedString<N>& value, bool may_be_empty) {
    if (found_) return;
    const std::string_view view = value.view();
    bool good = view.size() < N && (may_be_empty || !view.empty());
    for (const char c : view) good = good && c >= ' ' && c <= '~';
    for (std::size_t i = view.size(); i < N; ++i) good = good && value.bytes[i] == '\0';
    require(good, key + ": must be " + (may_be_empty ? "0" : "1") + " to " + std::to_string(N - 1) +
                      " printable ASCII characters, zero padded");
  }
  bool ok() const { return !found_; }
  std::optional<std::string> defect() const { return found_; }

 private:
  std::optional<std::string> found_;
};

}  // namespace strainwave
