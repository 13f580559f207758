// SPDX-License-Identifier: BSD-3-Clause
// The instant at which a message was sent, on our clock: from the sender's clock, which runs at about our rate, and the shortest recent
// transport delay. Delayed and lost messages change nothing. Real-time safe.
//
//   sent on our clock = sent on the sender's + offset
//   offset   mean of arrival - sent over forty messages, without those that are later than it by more than 6 ms. A message that is
//            earlier by more than that begins the mean anew; so do late messages alone for 0.12 s
//   a clock that was set, or stands still: the message counts as sent at its arrival less the usual delay
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace strainwave {

class SenderClock {
 public:
  /// `period_s` > 0: the unit of our clock.
  explicit SenderClock(double period_s) noexcept : period_us_(period_s * 1e6) {}

  /// The next message is the first.
  void forget() noexcept { messages_ = 0; }
  /// A message of `sent_us` > 0 on the sender's clock comes in this period of ours.
  void take(std::int64_t sent_us, double period) noexcept {
    if (messages_ == 0) {
      last_us_ = sent_us;
      sent_ = 0.0;
      offset_ = period;
      return begin_mean();
    }
    const double since = static_cast<double>(sent_us - last_us_) / period_us_;
    const double late = period - (sent_ + since + offset_);
    last_us_ = sent_us;
    if (since <= 0.0 || std::abs(late) * period_us_ > kClockSet_us) {
      sent_ = std::max(sent_, period - offset_);
      return;
    }
    sent_ += since;
    if (std::abs(late) * period_us_ > kJitter_us) {
      if (late > 0.0 && !std::exchange(held_up_, true)) since_ = period;
      if (late > 0.0 && (period - since_) * period_us_ <= kInARow_us) return;
      offset_ += late;
      return begin_mean();
    }
    messages_ = std::min(messages_ + 1, kAveraged);
    offset_ += late / messages_;
    held_up_ = false;
  }
  /// Periods from the first message's sending to the last one's; rises with the sender's clock, whatever is learned of the way.
  double sent() const noexcept { return sent_; }
  /// sent() + offset(): the period of ours in which one that takes as long as most do would have come.
  double offset() const noexcept { return offset_; }

 private:
  static constexpr int kAveraged = 40;
  static constexpr double kJitter_us = 6e3;      ///< usual jitter of a network
  static constexpr double kInARow_us = 120e3;    ///< longer than a network delays every message
  static constexpr double kClockSet_us = 250e3;  ///< longer than any delay: the sender's clock was set

  void begin_mean() noexcept {
    messages_ = 1;
    held_up_ = false;
  }

  double period_us_;
  std::int64_t last_us_ = 0;
  double sent_ = 0.0;
  double offset_ = 0.0;
  int messages_ = 0;      ///< that offset_ is the mean of, at most
  bool held_up_ = false;  ///< the last, and all since ...
  double since_ = 0.0;    ///< ... this period
};

}  // namespace strainwave
