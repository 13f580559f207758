// When a reference that the joint could not follow begins anew from where the joint is: once for each time that this is asked for, in the next
// period, and not for ever. A joint that is blocked uses its plans up, keeps its reference, and its following error grows until someone
// notices. Real-time safe.
//
//   Kept ---- asked for, of kMost not one too many ----> Due
//   Due ----- the plan begins, or is not wanted -------> Kept
#pragma once

#include <utility>

namespace strainwave {

class NewPlans {
 public:
  /// Of one order, in one phase of its motion.
  static constexpr int kMost = 50;

  /// A new start.
  void reset() noexcept { *this = {}; }
  void new_phase() noexcept { asked_ = 0; }
  void new_order() noexcept {
    asked_ = 0;
    last_side_ = 0;
  }

  void ask() noexcept {
    if (asked_ >= kMost) return;
    ++asked_;
    due_ = true;
  }
  bool due() const noexcept { return due_; }
  void cancel() noexcept { due_ = false; }
  /// The plan that is due begins on `side` of its target, 1 or -1; 0: the target moves, and has no sides. True where that of the order's last one was
  /// the other.
  bool begin(int side) noexcept {
    due_ = false;
    return side != 0 && std::exchange(last_side_, side) == -side;
  }

 private:
  int asked_ = 0;
  int last_side_ = 0;  ///< 0: none yet
  bool due_ = false;
};

}  // namespace strainwave
