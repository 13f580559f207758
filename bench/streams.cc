// bench/streams: what becomes of a streamed sine of 0.5 rad and 0.5 Hz under other rules for what lies between samples, on the simulated
// rigid joint. All rules drive the same servo cascade (sim/studies/peers/cascade.h) with its feed-forward, so that nothing but the rule
// differs; the last row is the daemon's own controller, friction compensation included. Virtual time. Rules, from their documentation:
//
//   hold and plan       each position is a move, time-optimal within the joint's limits, that ends at rest
//   trapezoid           likewise with a gentle acceleration, planned anew from where it is: the ODrive's trap_traj (ODrive documentation,
//                       "Control modes", "Trajectory control")
//   linear              from one sample to the next along a line, an interval later, its slope as the velocity fed forward: CiA 402's
//                       interpolated position mode with submode 0 (CiA 402-2, "Interpolated position mode")
//   stream              control/trajectory/stream_target.h, confined, followed by control/trajectory/reference_shaper.h, with the samples' velocities
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <vector>

#include "control/table/gain_table_json.h"
#include "control/trajectory/stream_target.h"
#include "sim/joint/reference_plant.h"
#include "sim/studies/peers/cascade.h"
#include "tests/control/controlled_joint.h"

namespace strainwave {
namespace {

constexpr double kPeriod_s = 0.001;
constexpr double kOmega_rad_s = 2.0 * std::numbers::pi * 0.5;
constexpr double kAmplitude_rad = 0.5;
constexpr double kGentle_rad_s2 = 10.0;  // twice what the sine needs
constexpr MotionLimits kLimits{6.0, 150.0, 150.0};
constexpr int kBegin = 2000;
constexpr int kEnd = 6000;
constexpr int kLongestLag = 200;

Reference sine(double t_s) {
  const double phase = kOmega_rad_s * t_s;
  return {kAmplitude_rad * std::sin(phase), kAmplitude_rad * kOmega_rad_s * std::cos(phase),
          -kAmplitude_rad * kOmega_rad_s * kOmega_rad_s * std::sin(phase)};
}

/// What a rule makes of samples: take() in the periods in which one comes.
class Rule {
 public:
  virtual ~Rule() = default;
  Rule() = default;
  Rule(const Rule&) = delete;
  Rule& operator=(const Rule&) = delete;
  virtual void take(const Reference& sample) = 0;
  virtual Reference step() = 0;
};

class HoldAndPlan final : public Rule {
 public:
  explicit HoldAndPlan(const MotionLimits& limits) { shaper_.set_limits(limits); }
  void take(const Reference& sample) override { shaper_.set_target(sample.position_rad); }
  Reference step() override { return shaper_.step(); }

 private:
  ReferenceShaper shaper_{kPeriod_s};
};

class Linear final : public Rule {
 public:
  explicit Linear(int interval) : interval_(interval) {}
  void take(const Reference& sample) override {
    from_rad_ = to_rad_;
    to_rad_ = sample.position_rad;
    done_ = 0;
  }
  Reference step() override {
    const int now = std::min(done_++, interval_);
    const double slope_rad_s = now < interval_ ? (to_rad_ - from_rad_) / (interval_ * kPeriod_s) : 0.0;
    return {from_rad_ + (to_rad_ - from_rad_) * now / interval_, slope_rad_s, 0.0};
  }

 private:
  int interval_;
  int done_ = 0;
  double from_rad_ = 0.0;
  double to_rad_ = 0.0;
};

class Streamed final : public Rule {
 public:
  Streamed() {
    shaper_.set_limits(kLimits);
    target_.begin(0.0, 0.0, 0.0);
  }
  void take(const Reference& sample) override {
    target_.take({sample.position_rad, sample.velocity_rad_s, 0.0, 1},
                 {kLimits.velocity_rad_s, kLimits.acceleration_rad_s2});
  }
  Reference step() override {
    const MovingTarget target = target_.step();
    return shaper_.follow(
        target_.confined(target, shaper_.position_rad(), shaper_.velocity_rad_s(), confined_), {});
  }

 private:
  StreamTarget target_{kPeriod_s, 0.05};
  ReferenceShaper shaper_{kPeriod_s};
  StreamTarget::Confinement confined_ = 0;
};

struct Ride {
  double rms_torque_Nm = 0.0;
  double largest_step_Nm = 0.0;  ///< in a period
  double lag_s = 0.0;            ///< at which the error is least
  double rms_error_rad = 0.0;    ///< without regard to the lag
};

/// `torque_Nm` of period k, from the position that is read in it.
Ride ride(const std::function<double(int k, double position_rad)>& torque_Nm) {
  JointPlant plant(realistic_plant());
  plant.set_ambient_temperature(20.0);
  Ride result;
  std::vector<double> positions_rad;
  double last_Nm = 0.0;
  for (int k = 0; k < kEnd; ++k) {
    const double position_rad = plant.state().position_rad;
    const double wanted_Nm = torque_Nm(k, plant.measured_position_rad());
    if (k >= kBegin) {
      positions_rad.push_back(position_rad);
      result.rms_torque_Nm += wanted_Nm * wanted_Nm / (kEnd - kBegin);
      result.largest_step_Nm = std::max(result.largest_step_Nm, std::abs(wanted_Nm - last_Nm));
    }
    last_Nm = wanted_Nm;
    plant.step(wanted_Nm);
    plant.set_ambient_temperature(20.0);
  }
  const auto rms_error_rad = [&](int lag) {
    double squares = 0.0;
    for (int k = kBegin; k < kEnd; ++k)
      squares += std::pow(
          positions_rad[static_cast<std::size_t>(k - kBegin)] - sine((k - lag) * kPeriod_s).position_rad, 2);
    return std::sqrt(squares / (kEnd - kBegin));
  };
  int best = 0;
  for (int lag = 1; lag <= kLongestLag; ++lag)
    if (rms_error_rad(lag) < rms_error_rad(best)) best = lag;
  result.lag_s = best * kPeriod_s;
  result.rms_torque_Nm = std::sqrt(result.rms_torque_Nm);
  result.rms_error_rad = rms_error_rad(0);
  return result;
}

Ride ride_by(Rule& rule, int every) {
  CascadePeer cascade(servo_joint(realistic_plant()), true);
  cascade.reset(0.0);
  return ride([&](int k, double position_rad) {
    if (k % every == 0) rule.take(sine(k * kPeriod_s));
    return cascade.step(rule.step(), position_rad);
  });
}

Ride ride_by_the_daemons(int every) {
  JointControllerConfig config = testing::realistic_config();
  config.motion = kLimits;
  JointController controller(config);
  controller.load(read_gain_table(STRAINWAVE_SOURCE_DIR "/data/tables/rhs17-6006.json"));
  controller.start(0.0);
  return ride([&](int k, double position_rad) {
    const Reference sample = sine(k * kPeriod_s);
    if (k % every == 0)
      controller.follow({sample.position_rad, sample.velocity_rad_s, 0.0, 1}, k == 0, 0.0, {});
    JointMeasurement measurement;
    measurement.joint_position_rad = position_rad;
    measurement.temperature_C = 20.0;
    measurement.temperature_valid = true;
    return controller.step(measurement).output.torque_Nm;
  });
}

void print(const char* rule, int every, const Ride& ride) {
  std::printf("| %s | %d Hz | %.2f | %.2f | %.0f | %.2f |\n", rule, 1000 / every, ride.rms_torque_Nm,
              ride.largest_step_Nm, 1e3 * ride.lag_s, 1e3 * ride.rms_error_rad);
}

void run() {
  std::printf(
      "| rule | samples | torque rms, N.m | largest step in a period, N.m | lag, ms | error rms, mrad |\n"
      "|---|---|---|---|---|---|\n");
  for (const int every : {50, 10, 2}) {
    HoldAndPlan hold(kLimits);
    HoldAndPlan trapezoid({kLimits.velocity_rad_s, kGentle_rad_s2, kGentle_rad_s2});
    Linear linear(every);
    Streamed streamed;
    print("hold and plan", every, ride_by(hold, every));
    print("trapezoid", every, ride_by(trapezoid, every));
    print("linear, velocity fed forward", every, ride_by(linear, every));
    print("stream", every, ride_by(streamed, every));
    print("the daemon's controller", every, ride_by_the_daemons(every));
  }
}

}  // namespace
}  // namespace strainwave

int main() {
  strainwave::run();
}
