// Valid fast streams whose samples come when a network lets them, to a rigid joint and to one on a spring of which it is not told: none of
// them is chatter. Virtual time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "sim/joint/reference_plant.h"
#include "tests/support/flexible_bench.h"

namespace strainwave::testing {
namespace {

constexpr double kMostAcceleration_rad_s2 = 30.0;

enum class Mechanics { kRigid, kOnASpring };
enum class Wave { kSine, kThereAndBack };

BenchJoint joint_of(Mechanics kind) {
  BenchJoint joint = demo_joint();
  JointControllerConfig& controller = joint.loop.controller;
  controller.motion.acceleration_rad_s2 = kMostAcceleration_rad_s2;
  controller.motion.deceleration_rad_s2 = kMostAcceleration_rad_s2;
  if (kind == Mechanics::kOnASpring) put_on_spring(joint, flexible_plant(), false);
  return joint;
}

struct Arrivals {
  double rate_Hz = 33.0;
  Wave form = Wave::kSine;
  double samples_a_swing = 3.3;
  double share = 0.6;     ///< of the limit of acceleration
  double jitter_s = 0.0;  ///< each is as much late, at most
  double lump_s = 0.0;    ///< what is sent meanwhile arrives together
  bool gaps = false;      ///< of 100 ms, twice a second
  std::string text() const {
    return std::to_string(rate_Hz) + " Hz " + (form == Wave::kSine ? "sine" : "there and back") + " jitter " +
           std::to_string(jitter_s) + " lump " + std::to_string(lump_s) + " gaps " + std::to_string(gaps) +
           " per swing " + std::to_string(samples_a_swing) + " share " + std::to_string(share);
  }
};

Order arriving(const Arrivals& stream, int i) {
  Order order;
  order.kind = OrderKind::kSetpoint;
  order.stream_id = 1;
  order.begins_stream = i == 0;
  order.valid_for_s = 1.0;
  order.derivatives = 1;
  const double interval_s = 1.0 / stream.rate_Hz;
  const double most_rad_s2 = stream.share * kMostAcceleration_rad_s2;
  if (stream.form == Wave::kThereAndBack) {
    order.position_rad = (i % 2 == 0 ? -1.0 : 1.0) * most_rad_s2 * interval_s * interval_s / 12.0;
    return order;
  }
  const double omega = 2.0 * std::numbers::pi * stream.rate_Hz / stream.samples_a_swing;
  order.position_rad = most_rad_s2 / (omega * omega) * std::sin(omega * interval_s * i);
  order.velocity_rad_s = most_rad_s2 / omega * std::cos(omega * interval_s * i);
  return order;
}

struct Arrived {
  double plain_law_s = -1.0;
  double fault_s = -1.0;
  Fault fault = Fault::kNone;
  double most_Nm = 0.0;
};

Arrived stream_to(Mechanics kind, const Arrivals& stream, unsigned seed) {
  JointBench bench({joint_of(kind)});
  bench.bring_to_hold(0, kind == Mechanics::kRigid ? demo_table() : flexible_table());
  bench.run(0.2);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> late_s(0.0, stream.jitter_s);
  Arrived seen;
  int sent = 0;
  double arrives_s = 0.0;
  for (int k = 0; k < 2500; ++k) {
    while (1e-3 * k >= arrives_s) {
      const double due_s = sent / stream.rate_Hz;
      const bool lost = stream.gaps && sent > 0 && std::fmod(due_s, 0.5) > 0.4;
      if (!lost) {
        EXPECT_TRUE(bench.joint(0).orders().push(arriving(stream, sent)));
      }
      ++sent;
      const double next_s = sent / stream.rate_Hz + late_s(random);
      arrives_s = stream.lump_s > 0.0 ? stream.lump_s * std::ceil(next_s / stream.lump_s) : next_s;
    }
    bench.step();
    seen.most_Nm = std::max(seen.most_Nm, std::abs(bench.drive(0).command().torque_Nm));
    if (seen.plain_law_s < 0.0 && bench.has_notice(0, Notice::kPlainLaw)) seen.plain_law_s = 1e-3 * k;
    if (bench.fault(0) == Fault::kNone) continue;
    seen.fault = bench.fault(0);
    seen.fault_s = 1e-3 * k;
    break;
  }
  return seen;
}

TEST(JointLoopArrivals, OfAValidStreamMakeNoChatter) {
  for (const Mechanics kind : {Mechanics::kRigid, Mechanics::kOnASpring})
    for (const double rate_Hz : {20.0, 33.0, 40.0, 100.0})
      for (const Wave form : {Wave::kSine, Wave::kThereAndBack})
        for (const double swing : {3.3, 10.0})
          for (const double share : {0.3, 0.6})
            for (const double jitter_s : {0.0, 0.004, 0.015})
              for (const double lump_s : {0.0, 0.06}) {
                if (form == Wave::kThereAndBack && (swing > 5.0 || rate_Hz > 50.0)) continue;
                Arrivals stream{rate_Hz, form, swing, share, jitter_s, lump_s};
                const Arrived seen = stream_to(kind, stream, 7);
                EXPECT_LT(seen.plain_law_s, 0.0) << static_cast<int>(kind) << " " << stream.text() << " most "
                                                 << seen.most_Nm << " from " << seen.plain_law_s;
                EXPECT_EQ(seen.fault, Fault::kNone)
                    << static_cast<int>(kind) << " " << stream.text() << " at " << seen.fault_s << " fault "
                    << static_cast<int>(seen.fault);
              }
}

TEST(JointLoopArrivals, AndGapsOfAValidStreamMakeNoChatter) {
  for (const Mechanics kind : {Mechanics::kRigid, Mechanics::kOnASpring})
    for (const double rate_Hz : {40.0, 100.0})
      for (const double swing : {10.0, 100.0})
        for (const double share : {0.3, 0.6}) {
          const Arrivals stream{rate_Hz, Wave::kSine, swing, share, 0.004, 0.0, true};
          const Arrived seen = stream_to(kind, stream, 7);
          EXPECT_LT(seen.plain_law_s, 0.0) << static_cast<int>(kind) << " " << stream.text();
          EXPECT_EQ(seen.fault, Fault::kNone) << static_cast<int>(kind) << " " << stream.text();
        }
}

}  // namespace
}  // namespace strainwave::testing
