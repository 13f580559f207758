#include "control/path_return.h"

#include <algorithm>
#include <limits>

namespace strainwave {

namespace {

// Of a time that is a second away from the usual one: a few counts of a fine encoder, so that no reading of a joint that moves is outweighed.
constexpr double kUsual_rad_s = 1e-4;
// Places that are looked at before the nearest of them is looked around.
constexpr int kPlaces = 200;
// Each leaves two thirds of what is looked at: of two places a hundred-thousandth.
constexpr int kNarrowings = 28;
// The rate moves joints that are behind by a little more or less: a second round finds what the first one left.
constexpr int kRounds = 2;
// Slower than this the path rests.
constexpr double kRests_rad_s = 1e-6;

double late_time_s(const StrayJoint& joint, double time_s, double rate) noexcept {
  return std::max(0.0, time_s - joint.late_s * rate);
}

/// A search with the joints' readers at one time or before.
class Nearness {
 public:
  Nearness(std::span<StrayJoint> joints, const PathWindow& window, double rate) noexcept
      : joints_(joints), window_(window), rate_(rate) {}

  /// Looks are at this time or later from now on.
  void begin_at(double time_s) noexcept {
    for (StrayJoint& joint : joints_) {
      joint.reader = {};
      (void)joint.reader.at(*joint.path, late_time_s(joint, time_s, rate_));
    }
  }
  /// The sum of the squares; `goes_on`: the next look is no earlier.
  double at(double time_s, bool goes_on = false) noexcept {
    const double usual_rad = kUsual_rad_s * (time_s - window_.last.time_s);
    double sum_rad2 = usual_rad * usual_rad;
    for (StrayJoint& joint : joints_) {
      PathReader reader = joint.reader;
      const PathPoint point = reader.at(*joint.path, late_time_s(joint, time_s, rate_));
      const double off_rad = point.position_rad - joint.position_rad;
      sum_rad2 += off_rad * off_rad;
      if (goes_on) joint.reader = reader;
    }
    return sum_rad2;
  }
  /// With the readers at this time or before.
  double rate_at(double time_s) const noexcept {
    double along = 0.0;
    double size = 0.0;
    for (const StrayJoint& joint : joints_) {
      PathReader reader = joint.reader;
      const double path_rad_s = reader.at(*joint.path, late_time_s(joint, time_s, rate_)).velocity_rad_s;
      along += path_rad_s * joint.velocity_rad_s;
      size += path_rad_s * path_rad_s;
    }
    return size > kRests_rad_s * kRests_rad_s ? std::clamp(along / size, 0.0, 1.0) : window_.last.rate;
  }

 private:
  std::span<StrayJoint> joints_;
  const PathWindow& window_;
  double rate_;
};

// The nearest of places that lie evenly.
double nearest_place_s(Nearness& nearness, const PathWindow& window, double step_s) noexcept {
  nearness.begin_at(window.begin_s);
  double nearest_s = window.last.time_s;
  double least_rad2 = std::numeric_limits<double>::infinity();
  for (int place = 0; place <= kPlaces; ++place) {
    const double time_s = window.begin_s + place * step_s;
    const double sum_rad2 = nearness.at(time_s, true);
    if (sum_rad2 >= least_rad2) continue;
    least_rad2 = sum_rad2;
    nearest_s = time_s;
  }
  return nearest_s;
}

}  // namespace

PathTime nearest_time(std::span<StrayJoint> joints, const PathWindow& window) noexcept {
  PathTime found{window.last.time_s, window.last.rate, 0.0};
  if (joints.empty()) return found;
  const double step_s = (window.end_s - window.begin_s) / kPlaces;
  Nearness first(joints, window, found.rate);
  double place_s = nearest_place_s(first, window, step_s);
  for (int round = 0; round < kRounds; ++round) {
    Nearness nearness(joints, window, found.rate);
    double low_s = std::max(window.begin_s, place_s - step_s);
    double high_s = std::min(window.end_s, place_s + step_s);
    nearness.begin_at(low_s);
    for (int i = 0; i < kNarrowings; ++i) {
      const double third_s = (high_s - low_s) / 3.0;
      if (nearness.at(low_s + third_s) <= nearness.at(high_s - third_s))
        high_s -= third_s;
      else
        low_s += third_s;
    }
    found.time_s = place_s = 0.5 * (low_s + high_s);
    found.rate = nearness.rate_at(found.time_s);
  }
  return found;
}

void WayBack::begin(double off_rad, double off_rad_s, double duration_s) noexcept {
  off_rad_ = off_rad;
  off_rad_s_ = off_rad_s;
  duration_s_ = duration_s;
  since_s_ = 0.0;
}

PathPoint WayBack::step(double elapsed_s) noexcept {
  since_s_ = std::min(duration_s_, since_s_ + elapsed_s);
  if (since_s_ == duration_s_) return {};
  const double T = duration_s_;
  const double u = since_s_ / T;
  const double way = off_rad_s_ * T;
  const double u2 = u * u;
  return {
      off_rad_ * (1.0 + u2 * u * (-10.0 + u * (15.0 - 6.0 * u))) +
          way * u * (1.0 + u2 * (-6.0 + u * (8.0 - 3.0 * u))),
      (off_rad_ * u2 * (-30.0 + u * (60.0 - 30.0 * u)) + way * (1.0 + u2 * (-18.0 + u * (32.0 - 15.0 * u)))) /
          T,
      (off_rad_ * u * (-60.0 + u * (180.0 - 120.0 * u)) + way * u * (-36.0 + u * (96.0 - 60.0 * u))) /
          (T * T)};
}

}  // namespace strainwave
