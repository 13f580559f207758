// Streams as motions, and the reference that follows them: a sine at every rate with all that a network does to it. Above 300 lines: so is
// what senders and networks do.
#include "control/trajectory/stream_target.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include "control/trajectory/reference_shaper.h"

namespace strainwave {
namespace {

constexpr double kPeriod_s = 0.001;
constexpr double kAmplitude_rad = 0.5;
constexpr double kOmega_rad_s = 2.0 * std::numbers::pi * 0.5;
constexpr MotionLimits kLimits{8.0, 60.0, 80.0};
constexpr StreamTarget::Reach kReach{8.0, 60.0};

StreamSample sine(double t_s, int derivatives) {
  return {
      kAmplitude_rad * std::sin(kOmega_rad_s * t_s),
      derivatives >= 1 ? kAmplitude_rad * kOmega_rad_s * std::cos(kOmega_rad_s * t_s) : 0.0,
      derivatives >= 2 ? -kAmplitude_rad * kOmega_rad_s * kOmega_rad_s * std::sin(kOmega_rad_s * t_s) : 0.0,
      derivatives};
}

/// What is sent: `at_s` for `of_s`.
struct Sent {
  double at_s = 0.0;
  double of_s = 0.0;
};

/// A reference that follows a stream, period by period.
class Following {
 public:
  explicit Following(const MotionLimits& limits = kLimits, const StreamTarget::Reach& reach = kReach)
      : reach_(reach) {
    shaper_.set_limits(limits);
  }
  void begin(double position_rad) {
    shaper_.reset(position_rad, 0.0);
    target_.begin(position_rad, 0.0, 0.0);
  }
  /// Another stream from where this one is, in the middle of the motion.
  void begin_anew() {
    target_.begin(shaper_.position_rad(), shaper_.velocity_rad_s(), 0.0);
    confined_ = 0;
  }
  void take(const StreamSample& sample) {
    if (target_.ended()) target_.resume(shaper_.position_rad(), shaper_.velocity_rad_s(), {});
    target_.take(sample, reach_);
  }
  Reference step(const PositionRange& range = {}) {
    if (target_.ended()) {
      shaper_.stop();
      target_.wait(1);
      return shaper_.step();
    }
    const MovingTarget target = target_.step();
    return shaper_.follow(
        target_.confined(target, shaper_.position_rad(), shaper_.velocity_rad_s(), confined_), range);
  }
  const StreamTarget& target() const { return target_; }

 private:
  StreamTarget::Reach reach_;
  StreamTarget target_{kPeriod_s, 0.05};
  ReferenceShaper shaper_{kPeriod_s};
  StreamTarget::Confinement confined_ = 0;
};

struct Tracked {
  double rms_error_rad = 0.0;  ///< from the sine, `lag_s` ago
  double largest_error_rad = 0.0;
  double rms_acceleration = 0.0;     ///< over the sine's own
  double largest_step_rad_s2 = 0.0;  ///< of the acceleration, between two periods, beyond the sine's own
};

/// Follows `sent` for 6 s and judges the last 4.
Tracked track(const std::vector<Sent>& sent, int derivatives, double lag_s) {
  Following following;
  following.begin(0.0);
  Tracked result;
  double squares = 0.0;
  double accelerations = 0.0;
  double last_rad_s2 = 0.0;
  int counted = 0;
  std::size_t next = 0;
  for (int k = 0; k < 6000; ++k) {
    const double t_s = k * kPeriod_s;
    for (; next < sent.size() && sent[next].at_s <= t_s + 1e-12; ++next)
      following.take(sine(sent[next].of_s, derivatives));
    const Reference reference = following.step();
    if (t_s >= 2.0) {
      const double error_rad = reference.position_rad - sine(t_s - lag_s, 0).position_rad;
      squares += error_rad * error_rad;
      accelerations += reference.acceleration_rad_s2 * reference.acceleration_rad_s2;
      result.largest_error_rad = std::max(result.largest_error_rad, std::abs(error_rad));
      result.largest_step_rad_s2 =
          std::max(result.largest_step_rad_s2, std::abs(reference.acceleration_rad_s2 - last_rad_s2));
      ++counted;
    }
    last_rad_s2 = reference.acceleration_rad_s2;
  }
  result.rms_error_rad = std::sqrt(squares / counted);
  result.rms_acceleration = std::sqrt(accelerations / counted) /
                            (kAmplitude_rad * kOmega_rad_s * kOmega_rad_s / std::numbers::sqrt2);
  return result;
}

std::vector<Sent> regular(double rate_Hz) {
  std::vector<Sent> sent;
  for (int i = 0; i / rate_Hz < 6.0; ++i) sent.push_back({i / rate_Hz, i / rate_Hz});
  return sent;
}

TEST(StreamTarget, FollowsASineWithoutLagWhereItsVelocityIsGiven) {
  for (const double rate_Hz : {20.0, 50.0, 100.0, 200.0, 333.0, 500.0}) {
    const Tracked tracked = track(regular(rate_Hz), 1, 0.0);
    EXPECT_LT(tracked.rms_error_rad, 1e-3) << rate_Hz << " Hz";
    EXPECT_LT(tracked.rms_acceleration, 1.05) << rate_Hz << " Hz";
    EXPECT_LT(tracked.largest_step_rad_s2, 2.5) << rate_Hz << " Hz";
  }
}

TEST(StreamTarget, LagsOneSampleWhereOnlyPositionsAreGiven) {
  for (const double rate_Hz : {20.0, 50.0, 100.0, 200.0, 333.0, 500.0}) {
    const Tracked tracked = track(regular(rate_Hz), 0, 1.0 / rate_Hz);
    EXPECT_LT(tracked.rms_error_rad, 1e-3) << rate_Hz << " Hz";
    EXPECT_LT(tracked.rms_acceleration, 1.1) << rate_Hz << " Hz";
    EXPECT_LT(tracked.largest_step_rad_s2, 2.5) << rate_Hz << " Hz";
  }
}

TEST(StreamTarget, BridgesLostSamplesAndGaps) {
  for (const int derivatives : {0, 1, 2}) {
    std::mt19937 random(17);
    std::vector<Sent> sent;
    for (const Sent& one : regular(100.0)) {
      const bool gap = std::fmod(one.at_s, 1.0) > 0.5 && std::fmod(one.at_s, 1.0) < 0.53;
      if (!gap && random() % 10 != 0) sent.push_back(one);
    }
    const Tracked tracked = track(sent, derivatives, derivatives == 0 ? 0.01 : 0.0);
    EXPECT_LT(tracked.largest_error_rad, 5e-3) << derivatives;
    EXPECT_LT(tracked.rms_acceleration, 1.5) << derivatives;
  }
}

/// What becomes of a sine whose samples, `ahead` periods before their time (0: not stamped), do not come for a while.
struct Recovery {
  double largest_rad_s2 = 0.0;       ///< from the first sample on that comes again
  double largest_step_rad_s2 = 0.0;  ///< of the acceleration, between two periods, from the second on
  double left_rad = 0.0;             ///< error from 0.3 s after it on
};

Recovery recover(int begins, int lasts, int every, int ahead, int derivatives) {
  constexpr MotionLimits limits{6.0, 150.0, 150.0};
  Following following(limits, {6.0, 150.0});
  following.begin(0.0);
  Recovery result;
  double last_rad_s2 = 0.0;
  for (int k = begins - 1000, again = 0; k < begins + lasts + 800; ++k) {
    if (k % every == 0 && (k < begins || k >= begins + lasts)) {
      StreamSample sample = sine((k + ahead) * kPeriod_s, derivatives);
      sample.in_periods = ahead;
      following.take(sample);
      if (k >= begins && again == 0) again = k;
    }
    const Reference reference = following.step();
    if (again != 0) {
      result.largest_rad_s2 = std::max(result.largest_rad_s2, std::abs(reference.acceleration_rad_s2));
      if (k > again + 1)
        result.largest_step_rad_s2 =
            std::max(result.largest_step_rad_s2, std::abs(reference.acceleration_rad_s2 - last_rad_s2));
      const int lag = derivatives == 0 ? std::clamp(std::max(20, every) - ahead, 0, every) : 0;
      if (k > again + 300)
        result.left_rad = std::max(
            result.left_rad, std::abs(reference.position_rad - sine((k - lag) * kPeriod_s, 0).position_rad));
    }
    last_rad_s2 = reference.acceleration_rad_s2;
  }
  return result;
}

// The sine's own acceleration is 4.9 rad/s^2; at its limits the joint would make 150, and as much again with every turn round.
TEST(StreamTarget, CatchesUpAfterAGapInTheTimeThatWasMissed) {
  for (const int derivatives : {0, 1, 2})
    for (const int every : {10, 25})
      for (const int ahead : {0, 20, 100})
        for (const int lasts : {30, 50, 100, 150, 200, 300}) {
          const bool bridged = lasts <= 50;
          for (int begins = 3000; begins < 4000; begins += 100) {
            const Recovery recovery = recover(begins, lasts, every, ahead, derivatives);
            const auto when = [&] {
              return ::testing::Message() << derivatives << " derivatives every " << every << " ms, " << ahead
                                          << " ms ahead, from " << begins << " for " << lasts << " ms";
            };
            EXPECT_LT(recovery.largest_rad_s2, bridged ? 20.0 : 90.0) << when();
            EXPECT_LT(recovery.largest_step_rad_s2, 10.0) << when();
            EXPECT_LT(recovery.left_rad, 1e-3) << when();
          }
        }
}

// Whoever sends once more and then no more is not waited for any longer than else.
TEST(StreamTarget, EndsAsSoonWhileItCatchesUp) {
  Following following;
  following.begin(0.0);
  int ended_at = -1;
  for (int k = 0; k < 600; ++k) {
    if (k % 10 == 0 && (k <= 200 || k == 400)) following.take({0.001 * k, 1.0, 0.0, 1});
    (void)following.step();
    if (k > 400 && ended_at < 0 && following.target().ended()) ended_at = k;
  }
  EXPECT_NEAR(ended_at, 400 + 20 + 50 + 5, 3) << "half an interval late";
}

// What has nothing to add does not set a motion going again that has ended.
TEST(StreamTarget, StaysEndedWhereTheLastSampleComesAgain) {
  StreamTarget target(kPeriod_s, 0.05);
  target.begin(0.0, 1.0, 80.0);
  const auto take = [&](int in_periods) {
    StreamSample sample{0.001 * in_periods, 1.0, 0.0, 1};
    sample.in_periods = in_periods;
    target.take(sample, kReach);
  };
  take(90);
  take(100);
  int ended_after = 0;
  for (; ended_after < 300 && !target.ended(); ++ended_after) (void)target.step();
  ASSERT_LT(ended_after, 100) << "the last sample's time is not over, but the target is ahead of it";
  target.resume(0.2, 0.5, {});
  take(100 - ended_after);
  (void)target.step();
  EXPECT_TRUE(target.ended());
  target.resume(0.2, 0.5, {});
  take(100 - ended_after);
  (void)target.step();
  EXPECT_FALSE(target.ended());
}

TEST(StreamTarget, AveragesTheJitterOfTheNetwork) {
  for (const int derivatives : {0, 1}) {
    std::mt19937 random(3);
    std::vector<Sent> sent;
    for (Sent one : regular(100.0)) {
      one.at_s += std::uniform_real_distribution<double>(0.0, 0.003)(random);
      sent.push_back(one);
    }
    const Tracked tracked = track(sent, derivatives, derivatives == 0 ? 0.0115 : 0.0015);
    EXPECT_LT(tracked.rms_error_rad, 1e-3) << derivatives;
    EXPECT_LT(tracked.rms_acceleration, 1.6) << derivatives;
  }
}

TEST(StreamTarget, MeetsKnotsAtTheirOwnTime) {
  StreamTarget target(kPeriod_s, 0.05);
  target.begin(0.0, 0.0, 0.0);
  for (int i = 1; i <= 5; ++i) {
    StreamSample sample = sine(0.02 * i, 1);
    sample.in_periods = 20 * i;
    target.take(sample, kReach);
  }
  for (int k = 0; k <= 100; ++k) {
    const MovingTarget now = target.step();
    if (k % 20 == 0) {
      EXPECT_NEAR(now.position_rad, sine(k * kPeriod_s, 0).position_rad, 1e-12) << k;
    }
  }
}

TEST(StreamTarget, EndsSoonAfterTheLastSampleOfAMotion) {
  Following following;
  following.begin(0.0);
  int ended_at = -1;
  for (int k = 0; k < 500 && ended_at < 0; ++k) {
    if (k % 10 == 0 && k <= 200) following.take({0.001 * k, 1.0, 0.0, 1});
    (void)following.step();
    if (following.target().ended()) ended_at = k;
  }
  EXPECT_NEAR(ended_at, 200 + 20 + 50 + 5, 3) << "half an interval late";
}

TEST(StreamTarget, NeverEndsWhereItStandsStill) {
  Following following;
  following.begin(0.0);
  following.take({0.3});
  for (int k = 0; k < 5000; ++k) (void)following.step();
  EXPECT_FALSE(following.target().ended());
}

TEST(StreamTarget, APlaceFarAwayIsReachedAsFastAsTheLimitsAllowAndExactly) {
  Following following;
  following.begin(0.0);
  Reference reference;
  int arrived = -1;
  for (int k = 0; k < 2000 && arrived < 0; ++k) {
    if (k % 10 == 0) following.take({1.0});
    reference = following.step();
    ASSERT_LE(reference.position_rad, 1.0);
    if (reference.position_rad == 1.0 && reference.velocity_rad_s == 0.0) arrived = k;
  }
  ReferenceShaper move(kPeriod_s);
  move.set_limits(kLimits);
  move.set_target(1.0);
  int moved = 0;
  while (!move.at_target()) {
    (void)move.step();
    ++moved;
  }
  EXPECT_NEAR(arrived, moved, 2) << "as a move there";
}

// Steps of positions are places: a velocity that they would need is none, and nobody is thrown past them.
TEST(StreamTarget, IsNeverBeyondTheStepsOfAPositionStream) {
  for (const double step_rad : {0.05, 0.2, 1.0}) {
    Following following;
    following.begin(0.0);
    double highest_rad = 0.0;
    double lowest_rad = 0.0;
    for (int k = 0; k < 4000; ++k) {
      if (k % 10 == 0) following.take({k % 2000 < 1000 ? step_rad : 0.0});
      const Reference reference = following.step();
      highest_rad = std::max(highest_rad, reference.position_rad);
      lowest_rad = std::min(lowest_rad, reference.position_rad);
    }
    EXPECT_LE(highest_rad, step_rad + 1e-5) << "half a count";
    EXPECT_GE(lowest_rad, -1e-5) << step_rad;
    EXPECT_FALSE(following.target().ended());
  }
}

// What follows is later than the target by the lead, and so on time.
TEST(StreamTarget, IsAheadOfItsSamplesByItsLead) {
  for (const double lead : {3.0, 10.5, 33.0})
    for (const int ahead : {0, 10, 60}) {
      StreamTarget target(kPeriod_s, 0.05);
      target.begin(0.0, 0.0, lead);
      double largest_rad = 0.0;
      for (int k = 0; k < 3000; ++k) {
        if (k % 10 == 0) {
          StreamSample sample = sine((k + ahead) * kPeriod_s, 1);
          sample.in_periods = ahead;
          target.take(sample, kReach);
        }
        const MovingTarget now = target.step();
        if (k > 1000)
          largest_rad = std::max(largest_rad,
                                 std::abs(now.position_rad - sine((k + lead) * kPeriod_s, 0).position_rad));
      }
      EXPECT_LT(largest_rad, ahead > lead + 10 ? 1e-5 : 1e-3) << lead << ", " << ahead;
    }
}

// Stamped with less time than they need, samples do no worse than without a stamp.
TEST(StreamTarget, FollowsSmoothlyWhatIsStampedALittleAhead) {
  for (const int every : {100, 50, 20, 10})
    for (const int ahead : {1, 5, 10, 20}) {
      Following following;
      following.begin(0.0);
      double squares = 0.0;
      double largest_step_rad_s2 = 0.0;
      double last_rad_s2 = 0.0;
      for (int k = 0; k < 6000; ++k) {
        if (k % every == 0) {
          StreamSample sample = sine((k + ahead) * kPeriod_s, 1);
          sample.in_periods = ahead;
          following.take(sample);
        }
        const Reference reference = following.step();
        if (k >= 2000) {
          squares += std::pow(reference.position_rad - sine(k * kPeriod_s, 0).position_rad, 2);
          largest_step_rad_s2 =
              std::max(largest_step_rad_s2, std::abs(reference.acceleration_rad_s2 - last_rad_s2));
        }
        last_rad_s2 = reference.acceleration_rad_s2;
      }
      EXPECT_LT(std::sqrt(squares / 4000.0), every > 50 ? 2e-3 : 1e-3) << every << " " << ahead;
      EXPECT_LT(largest_step_rad_s2, 0.5) << every << " " << ahead;
    }
}

// What is told of rest again and again, before the motion is over, is at rest when it would have been, exactly.
TEST(StreamTarget, ComesToRestExactlyWhereSamplesSayItAgainAndAgain) {
  for (const int derivatives : {0, 1, 2}) {
    StreamTarget target(1e-3, 0.05);
    target.begin(0.0, 0.0, 1.0);
    MovingTarget now;
    for (int k = 0; k < 200; ++k) {
      const double position_rad = 1e-3 * std::min(k, 100);
      if (k % 10 == 0) target.take({position_rad, k < 100 ? 1.0 : 0.0, 0.0, derivatives}, kReach);
      now = target.step();
    }
    EXPECT_TRUE(now.rests()) << derivatives << ", " << now.velocity_rad_s;
    EXPECT_EQ(now.position_rad, 0.1) << derivatives;
  }
}

// Of a stream's only sample nobody knows the speed. Who comes to it from a motion goes there as by a move, and no dither is left.
TEST(StreamTarget, ComesToRestExactlyWhereEverySampleBeginsAnotherStream) {
  for (const int interval : {2, 5, 10, 20, 100})
    for (const double speed_rad_s : {0.1, 1.0, 4.0}) {
      Following following;
      following.begin(0.0);
      double last_rad_s = 0.0;
      int turns = 0;
      Reference reference;
      for (int k = 0; k < 2500; ++k) {
        if (k % interval == 0) {
          following.begin_anew();
          following.take({1e-3 * speed_rad_s * std::min(k, 1000)});
        }
        reference = following.step();
        if (k > 1000 && reference.velocity_rad_s * last_rad_s < 0.0) ++turns;
        last_rad_s = reference.velocity_rad_s;
      }
      EXPECT_LE(turns, 12) << "a stream each " << interval << " ms at " << speed_rad_s << " rad/s";
      EXPECT_EQ(reference.position_rad, speed_rad_s) << interval;
      EXPECT_EQ(reference.velocity_rad_s, 0.0) << interval << " " << speed_rad_s;
    }
}

TEST(StreamTarget, LeadsTheLoadAlongALineFromSampleToSample) {
  StreamTarget target(kPeriod_s, 0.05);
  target.begin(0.0, 0.0, 0.0);
  const auto take = [&](int in_periods, const ToldLoad& load) {
    target.take({0.0, 0.0, 0.0, 1, in_periods, load}, kReach);
  };
  take(10, {2.0, 0.1});
  take(30, {-6.0, 0.3});
  double torque_Nm = 0.0;
  for (int k = 1; k <= 100; ++k) {
    const MovingTarget now = target.step();
    EXPECT_LE(std::abs(now.load.torque_Nm - torque_Nm), 0.4 + 1e-9) << k;
    torque_Nm = now.load.torque_Nm;
    if (k == 5) {
      EXPECT_NEAR(now.load.torque_Nm, 1.0, 1e-12);
    }
    if (k == 20) {
      EXPECT_NEAR(now.load.inertia_kgm2, 0.2, 1e-12);
    }
  }
  EXPECT_EQ(torque_Nm, -6.0) << "after the last it stays";
}

// Whatever is sent, at whatever times.
// A sender's mistakes: velocities in degrees, of the other sign, left over, alternating.
TEST(StreamTarget, NeverLeavesThePositionsWhoseVelocitiesAreWrong) {
  struct Mistake {
    const char* name;
    std::function<StreamSample(double t_s, int k)> sample;
  };
  const auto standing = [](double velocity_rad_s) { return StreamSample{1.0, velocity_rad_s, 0.0, 1}; };
  const auto scaled = [](double t_s, double factor) {
    StreamSample sample = sine(t_s, 1);
    sample.velocity_rad_s *= factor;
    return sample;
  };
  const std::vector<Mistake> mistakes = {
      {"left over", [&](double, int) { return standing(4.0); }},
      {"alternating", [&](double, int k) { return standing(k % 2 == 0 ? 4.0 : -4.0); }},
      {"alternating, as the limit of acceleration allows",
       [&](double, int k) { return standing(k % 2 == 0 ? 1.4 : -1.4); }},
      {"alternating, hardly wrong", [&](double, int k) { return standing(k % 2 == 0 ? 0.2 : -0.2); }},
      {"degrees", [&](double t_s, int) { return scaled(t_s, 57.3); }},
      {"other sign", [&](double t_s, int) { return scaled(t_s, -5.0); }},
      {"wild accelerations",
       [&](double t_s, int k) {
         StreamSample sample = sine(t_s, 2);
         sample.acceleration_rad_s2 = k % 3 == 0 ? 1000.0 : -1e6;
         return sample;
       }},
      {"accelerations of the limit's size", [&](double t_s, int k) {
         StreamSample sample = sine(t_s, 2);
         sample.acceleration_rad_s2 = k / 3 % 2 == 0 ? 100.0 : -100.0;
         return sample;
       }}};
  for (const Mistake& mistake : mistakes)
    for (const int rate_Hz : {20, 50, 100, 250, 500}) {
      Following following;
      const double begin_rad = mistake.sample(0.0, 0).position_rad;
      following.begin(begin_rad);
      const int every = 1000 / rate_Hz;
      double farthest_rad = 0.0;
      double lowest_rad = begin_rad, highest_rad = begin_rad;
      for (int k = 0; k < 6000; ++k) {
        if (k % every == 0) {
          const StreamSample sample = mistake.sample(k * kPeriod_s, k / every);
          lowest_rad = std::min(lowest_rad, sample.position_rad);
          highest_rad = std::max(highest_rad, sample.position_rad);
          following.take(sample);
        }
        const double position_rad = following.step().position_rad;
        farthest_rad = std::max({farthest_rad, lowest_rad - position_rad, position_rad - highest_rad});
      }
      EXPECT_LE(farthest_rad, rate_Hz < 50 ? 0.16 : 0.06) << mistake.name << " at " << rate_Hz << " Hz";
    }
}

/// Positions of a reference that follows a sine whose samples are stamped `ahead` periods ahead, and once a second the wrong one besides,
/// `too_far` periods more; 0: none.
std::vector<double> stamped_wrongly(int derivatives, int every, int ahead, int too_far) {
  Following following;
  following.begin(0.0);
  std::vector<double> positions_rad;
  for (int k = 0; k < 6000; ++k) {
    if (k % every == 0) {
      StreamSample sample = sine((k + ahead) * kPeriod_s, derivatives);
      sample.in_periods = ahead + too_far;
      if (k % 1000 == 0 && k > 0 && too_far > 0) following.take(sample);
      sample.in_periods = ahead;
      following.take(sample);
    }
    positions_rad.push_back(following.step().position_rad);
  }
  return positions_rad;
}

// One that is stamped too far ahead must not silence the good ones behind it.
TEST(StreamTarget, TheNewestSampleTakesThePlaceOfThoseForLater) {
  for (const int derivatives : {0, 1, 2})
    for (const int every : {2, 10, 50})
      for (const int ahead : {5, 60, 200}) {
        const std::vector<double> right_rad = stamped_wrongly(derivatives, every, ahead, 0);
        for (const int too_far : {every, 100, 700}) {
          const std::vector<double> positions_rad = stamped_wrongly(derivatives, every, ahead, too_far);
          double farthest_rad = 0.0;
          for (std::size_t k = 0; k < right_rad.size(); ++k)
            farthest_rad = std::max(farthest_rad, std::abs(positions_rad[k] - right_rad[k]));
          EXPECT_LT(farthest_rad, 1e-4) << derivatives << " derivatives, every " << every << " ms, " << ahead
                                        << " ms ahead, one " << too_far << " ms too far";
        }
      }
}

// Now and then a wrong velocity happens to be near the right one: where it is used there alone, it is a jerk.
TEST(StreamTarget, UsesNoneOfTheVelocitiesOfAStreamInWhichMostAreWrong) {
  struct Mistake {
    const char* name;
    std::function<double(double velocity_rad_s)> told_rad_s;
  };
  const std::vector<Mistake> mistakes = {
      {"other sign", [](double velocity_rad_s) { return -velocity_rad_s; }},
      {"degrees", [](double velocity_rad_s) { return 57.3 * velocity_rad_s; }},
      {"a fifth", [](double velocity_rad_s) { return 0.2 * velocity_rad_s; }},
      {"left over, fast", [](double) { return 2.0; }},
      {"left over, slow", [](double) { return 0.5; }},
      {"left over, none", [](double) { return 0.0; }}};
  for (const Mistake& mistake : mistakes)
    for (const bool stamped : {false, true})
      for (const int rate_Hz : {20, 50, 100, 250, 500}) {
        Following following;
        following.begin(0.0);
        const int every = 1000 / rate_Hz;
        double hardest_rad_s2 = 0.0;
        for (int k = 0; k < 6000; ++k) {
          if (k % every == 0) {
            StreamSample sample = sine(k * kPeriod_s, 1);
            sample.velocity_rad_s = mistake.told_rad_s(sample.velocity_rad_s);
            if (stamped) sample.in_periods = 60;
            following.take(sample);
          }
          const double acceleration_rad_s2 = following.step().acceleration_rad_s2;
          if (k > 500) hardest_rad_s2 = std::max(hardest_rad_s2, std::abs(acceleration_rad_s2));
        }
        EXPECT_LT(hardest_rad_s2, 1.1 * kAmplitude_rad * kOmega_rad_s * kOmega_rad_s)
            << mistake.name << " at " << rate_Hz << " Hz" << (stamped ? ", stamped" : "");
      }
}

// Where samples have times of their own, velocities that are a little wrong would be accelerations, to and fro, from sample to sample: the more,
// the faster they come.
TEST(StreamTarget, UsesNoVelocitiesThatAreALittleWrongWherePositionsTell) {
  struct Mistake {
    const char* name;
    std::function<double(double t_s, double interval_s)> told_rad_s;
  };
  const auto true_rad_s = [](double t_s) { return sine(t_s, 1).velocity_rad_s; };
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  const std::vector<Mistake> mistakes = {
      {"none", [&](double t_s, double) { return true_rad_s(t_s); }},
      {"0.5 % too little", [&](double t_s, double) { return 0.995 * true_rad_s(t_s); }},
      {"2 % too much", [&](double t_s, double) { return 1.02 * true_rad_s(t_s); }},
      {"5 % too little", [&](double t_s, double) { return 0.95 * true_rad_s(t_s); }},
      {"20 % too much", [&](double t_s, double) { return 1.2 * true_rad_s(t_s); }},
      {"20 ms late", [&](double t_s, double) { return true_rad_s(t_s - 0.02); }},
      {"0.3 s late", [&](double t_s, double) { return true_rad_s(t_s - 0.3); }},
      {"backward differences",
       [&](double t_s, double interval_s) {
         return (sine(t_s, 0).position_rad - sine(t_s - interval_s, 0).position_rad) / interval_s;
       }},
      {"noise", [&](double t_s, double interval_s) {
         // Of slow streams some are believed: 1.8 mrad at 20 Hz.
         return true_rad_s(t_s) + (interval_s > 0.02 ? 0.0 : 0.05 * normal(random));
       }}};
  for (const Mistake& mistake : mistakes)
    for (const int rate_Hz : {20, 50, 100, 200, 500, 1000}) {
      Following following;
      following.begin(0.0);
      const int every = 1000 / rate_Hz;
      double hardest_rad_s2 = 0.0, farthest_rad = 0.0;
      for (int k = 0; k < 6000; ++k) {
        if (k % every == 0) {
          const double t_s = (k + 60) * kPeriod_s;
          StreamSample sample = sine(t_s, 1);
          sample.velocity_rad_s = mistake.told_rad_s(t_s, kPeriod_s * every);
          sample.in_periods = 60;
          following.take(sample);
        }
        const Reference reference = following.step();
        if (k < 500) continue;
        hardest_rad_s2 = std::max(hardest_rad_s2, std::abs(reference.acceleration_rad_s2));
        farthest_rad =
            std::max(farthest_rad, std::abs(reference.position_rad - sine(k * kPeriod_s, 0).position_rad));
      }
      EXPECT_LT(hardest_rad_s2, 1.5 * kAmplitude_rad * kOmega_rad_s * kOmega_rad_s)
          << mistake.name << " at " << rate_Hz << " Hz";
      EXPECT_LT(farthest_rad, 0.5e-3) << mistake.name << " at " << rate_Hz << " Hz";
    }
}

// Near what the joint can just do, and with a few samples a swing, who follows is always late: it must not chase the sine away.
TEST(StreamTarget, StaysWithTheSamplesOfASineThatItCannotFollow) {
  constexpr MotionLimits limits{4.0, 30.0, 30.0};
  std::mt19937 random(11);
  struct Ride {
    double rate_Hz, samples_a_swing, share, jitter;
    int derivatives;
  };
  for (const Ride ride : {Ride{30, 6, 0.8, 0, 1}, Ride{20, 10, 0.9, 0, 1}, Ride{25, 2.3, 0.9, 0, 1},
                          Ride{25, 3.3, 0.9, 0, 1}, Ride{100, 20, 0.8, 0, 0}, Ride{50, 10, 0.5, 0.5, 1},
                          Ride{50, 10, 0.9, 0.5, 0}, Ride{30, 6, 0.8, 0.3, 2}, Ride{40, 5, 0.9, 0, 1}}) {
    const double omega_rad_s = 2.0 * std::numbers::pi * ride.rate_Hz / ride.samples_a_swing;
    const double amplitude_rad = ride.share * limits.acceleration_rad_s2 / (omega_rad_s * omega_rad_s);
    const double fastest_rad_s = amplitude_rad * omega_rad_s;
    Following following(limits);
    following.begin(0.0);
    std::uniform_real_distribution<double> late(0.0, ride.jitter);
    double next_s = 0.0;
    double farthest_rad = 0.0;
    for (int k = 0, count = 0; k < 8000; ++k) {
      if (k * kPeriod_s >= next_s) {
        const double t_s = count / ride.rate_Hz;
        const double size = std::min(1.0, 2.0 * t_s) * amplitude_rad;
        following.take({size * std::sin(omega_rad_s * t_s), size * omega_rad_s * std::cos(omega_rad_s * t_s),
                        -size * omega_rad_s * omega_rad_s * std::sin(omega_rad_s * t_s), ride.derivatives});
        ++count;
        next_s = (count + late(random)) / ride.rate_Hz;
      }
      farthest_rad = std::max(farthest_rad, std::abs(following.step().position_rad));
    }
    // What it goes in three intervals (the sample is old, velocities are smoothed, it catches up), and needs to come to rest.
    const double room_rad =
        3.0 * fastest_rad_s / ride.rate_Hz + 0.5 * fastest_rad_s * fastest_rad_s / limits.acceleration_rad_s2;
    EXPECT_LE(farthest_rad, amplitude_rad + room_rad) << ride.rate_Hz << " Hz, " << ride.samples_a_swing
                                                      << " samples a swing of " << amplitude_rad << " rad";
  }
}

TEST(ReferenceShaper, KeepsAllLimitsWhileItFollowsAnything) {
  std::mt19937 random(5);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const PositionRange range{-1.0, 1.2};
  for (int run = 0; run < 200; ++run) {
    Following following;
    following.begin(uniform(-0.9, 0.9));
    Reference last = following.step(range);
    for (int k = 0; k < 1000; ++k) {
      if (random() % 8 == 0) {
        StreamSample sample{uniform(-1.0, 1.2), uniform(-20.0, 20.0), uniform(-500.0, 500.0),
                            static_cast<int>(random() % 3)};
        if (random() % 3 == 0) sample.in_periods = 1 + static_cast<int>(random() % 50);
        following.take(sample);
      }
      const Reference reference = following.step(range);
      ASSERT_TRUE(std::isfinite(reference.position_rad));
      ASSERT_LE(std::abs(reference.velocity_rad_s), kLimits.velocity_rad_s + 1e-9) << run << ", " << k;
      const double change = reference.velocity_rad_s - last.velocity_rad_s;
      const double allowed =
          (std::abs(reference.velocity_rad_s) > std::abs(last.velocity_rad_s) ? kLimits.acceleration_rad_s2
                                                                              : kLimits.deceleration_rad_s2) *
          kPeriod_s;
      ASSERT_LE(std::abs(change), allowed + 1e-9) << run << ", " << k;
      ASSERT_GE(reference.position_rad, range.min_rad - 1e-9) << run << ", " << k;
      ASSERT_LE(reference.position_rad, range.max_rad + 1e-9) << run << ", " << k;
      last = reference;
    }
  }
}

TEST(StreamTarget, ThatIsSkippedIsWhereItWouldHaveGone) {
  for (const int skipped : {5, 25, 45, 60}) {
    StreamTarget stepped(kPeriod_s, 0.05);
    StreamTarget leapt(kPeriod_s, 0.05);
    for (StreamTarget* target : {&stepped, &leapt}) {
      target->begin(0.0, 0.0, 0.0);
      for (int k = 0; k < 200; ++k) {
        if (k % 10 == 0) {
          StreamSample sample = sine(1e-3 * (k + 30), 1);
          sample.in_periods = 30;
          target->take(sample, kReach);
        }
        (void)target->step();
      }
    }
    MovingTarget last;
    for (int k = 0; k < skipped; ++k) last = stepped.step();
    leapt.skip(skipped);
    const MovingTarget next = leapt.step();
    EXPECT_EQ(next.position_rad, last.next_position_rad) << skipped;
    EXPECT_EQ(next.velocity_rad_s, last.next_velocity_rad_s) << skipped;
    EXPECT_FALSE(leapt.ended()) << skipped;
  }
}

// What has come meanwhile is taken before anybody asks whether it has ended, and nothing goes on for as long as that in between.
TEST(StreamTarget, ThatIsSkippedForLongEndsOnlyWhenNoSampleHasCome) {
  for (const bool comes : {false, true}) {
    StreamTarget target(kPeriod_s, 0.05);
    target.begin(0.0, 0.0, 0.0);
    for (int k = 0; k < 200; ++k) {
      if (k % 10 == 0) target.take({0.5e-3 * k, 0.5, 0.0, 1, 10}, kReach);
      (void)target.step();
    }
    target.skip(1000);
    EXPECT_FALSE(target.ended());
    if (comes) target.take({0.605, 0.5, 0.0, 1, 10}, kReach);
    const MovingTarget next = target.step();
    EXPECT_EQ(target.ended(), !comes);
    EXPECT_LT(next.position_rad, 0.2) << "as far as a stream is bridged";
  }
}

}  // namespace
}  // namespace strainwave
