// A joint that is declared rigid and follows streamed sines, told another inertia, friction or load than it has: easing its answer to the encoder's
// counts (control/eased_torque.h) must not let what it is told wrongly swing. Virtual time; the simulated joint, motor side.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "tests/support/joint_bench.h"

namespace strainwave::testing {
namespace {

constexpr int kWrongBegin = 1000;
constexpr int kWrongEnd = 5000;

struct WrongStream {
  double amplitude_rad;
  double frequency_Hz;
  int every;
};

struct WrongRide {
  double farthest_rad = 0.0;
  double step_rms_Nm = 0.0;  ///< of the torque, from period to period
  bool fell_back = false;
  bool faulted = false;
};

Order wrong_sample(const WrongStream& stream, int period) {
  const double omega_rad_s = 2.0 * std::numbers::pi * stream.frequency_Hz;
  Order order;
  order.kind = OrderKind::kSetpoint;
  order.stream_id = 1;
  order.begins_stream = period == 0;
  order.valid_for_s = 0.2;
  order.derivatives = 1;
  order.position_rad = stream.amplitude_rad * std::sin(omega_rad_s * 1e-3 * period);
  order.velocity_rad_s = stream.amplitude_rad * omega_rad_s * std::cos(omega_rad_s * 1e-3 * period);
  return order;
}

WrongRide ride_wrongly_told(double inertia, double friction, double temperature_C,
                            const WrongStream& stream) {
  BenchJoint joint = demo_joint_with_friction(friction);
  joint.drive.plant.joint.inertia_kgm2 *= inertia;
  joint.drive.ambient = TemperatureProfile::constant(temperature_C);
  JointBench bench({std::move(joint)});
  bench.bring_to_hold(0);
  WrongRide ride;
  double last_Nm = 0.0, sum_Nm2 = 0.0;
  for (int k = 0; k < kWrongEnd; ++k) {
    if (k % stream.every == 0) {
      EXPECT_TRUE(bench.joint(0).orders().push(wrong_sample(stream, k)));
    }
    bench.step();
    const double torque_Nm = bench.state(0).torque_commanded_Nm;
    if (k >= kWrongBegin) {
      sum_Nm2 += (torque_Nm - last_Nm) * (torque_Nm - last_Nm);
      const double wanted_rad =
          stream.amplitude_rad * std::sin(2.0 * std::numbers::pi * stream.frequency_Hz * 1e-3 * k);
      ride.farthest_rad = std::max(
          ride.farthest_rad, std::abs(bench.drive(0).simulated().plant().state().position_rad - wanted_rad));
    }
    last_Nm = torque_Nm;
  }
  ride.step_rms_Nm = std::sqrt(sum_Nm2 / (kWrongEnd - kWrongBegin));
  ride.fell_back = bench.has_notice(0, Notice::kPlainLaw);
  ride.faulted = bench.fault(0) != Fault::kNone;
  return ride;
}

TEST(WronglyToldStreams, DoNotShakeARigidJoint) {
  for (const double inertia : {0.5, 0.7, 1.0, 1.4, 2.0})
    for (const double friction : {0.5, 1.0, 1.5}) {
      WrongRide worst;
      double sum_rad = 0.0, sum_Nm = 0.0;
      int rides = 0, fallen_back = 0, faulted = 0;
      for (const double temperature_C : {-8.0, 20.0})
        for (const WrongStream& stream :
             {WrongStream{0.5, 0.5, 10}, WrongStream{0.1, 1.0, 2}, WrongStream{0.02, 2.0, 20},
              WrongStream{0.3, 0.2, 10}, WrongStream{0.05, 3.0, 5}}) {
          const WrongRide ride = ride_wrongly_told(inertia, friction, temperature_C, stream);
          worst.farthest_rad = std::max(worst.farthest_rad, ride.farthest_rad);
          worst.step_rms_Nm = std::max(worst.step_rms_Nm, ride.step_rms_Nm);
          sum_rad += ride.farthest_rad;
          sum_Nm += ride.step_rms_Nm;
          fallen_back += ride.fell_back ? 1 : 0;
          faulted += ride.faulted ? 1 : 0;
          ++rides;
        }
      std::printf(
          "inertia %.1f, friction %.1f: %.2f mrad off at most, %.2f in the mean; steps of %.2f N.m rms at "
          "most, %.2f in the mean; %d fell back, %d faulted of %d\n",
          inertia, friction, 1e3 * worst.farthest_rad, 1e3 * sum_rad / rides, worst.step_rms_Nm,
          sum_Nm / rides, fallen_back, faulted, rides);
      EXPECT_EQ(fallen_back, 0);
      EXPECT_EQ(faulted, 0);
      EXPECT_LT(worst.farthest_rad, 3e-3);
      EXPECT_LT(worst.step_rms_Nm, 0.9);
    }
}

}  // namespace
}  // namespace strainwave::testing
