// SPDX-License-Identifier: BSD-3-Clause
// The instant at which a message was sent, on our clock, from the sender's clock and the usual transport delay. The sender's clock must run
// at about our rate. Delayed and lost messages do not change the result. Real-time safe.
//
//   sent on our clock = sent on the sender's clock + offset
//   offset   mean of arrival - sent over forty messages. Messages that are late by more than 6 ms do not count. A message that is early by
//            more than that restarts the mean; so do late messages alone for 0.12 s
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

  /// The next message counts as the first.
  void forget() noexcept { messages_ = 0; }
  /// Takes a message that was sent at `sent_us` > 0 of the sender's clock and arrives in `period` of ours.
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
  /// Periods between the sending of the first and of the last message. Changes of the offset do not affect it.
  double sent() const noexcept { return sent_; }
  /// sent() + offset(): the period of ours in which a message with the usual delay would have arrived.
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
  int messages_ = 0;      ///< in the mean offset_, at most kAveraged
  bool held_up_ = false;  ///< the last message was late, and all since ...
  double since_ = 0.0;    ///< ... this period
};

}  // namespace strainwave
