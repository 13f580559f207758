// SPDX-License-Identifier: BSD-3-Clause
// bench/steps: the cost of JointController::step() on moves, on a stream and at rest, with a new temperature every
// period. It records one closed-loop run and replays it without the simulated joint. The same readings and orders
// give the same steps. Prints processor time of the mean step, for one joint and for 64 in turn, and the slowest
// step of the run. Also prints the share of one processor that 64 joints take at 1 kHz. Each figure is the minimum
// over all repetitions, which other programs disturb the least.
//
//   steps_benchmark [REPETITIONS [KIND]]     callgrind runs one repetition of one kind (docs/performance.md)
#include <ctime>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "control/table/gain_table_json.h"
#include "sim/joint/reference_plant.h"
#include "sim/studies/contenders.h"
#include "sim/studies/loop_controllers.h"

namespace strainwave {
namespace {

constexpr double kPeriod_s = 0.001;
constexpr int kSteps = 6000;
constexpr int kStreamBegins = 3000;  // moves before this step ...
constexpr int kStreamEnds = 5000;    // ... and rest from this one on
constexpr int kMoveEvery = 500;
constexpr int kSampleEvery = 10;
constexpr std::size_t kJoints = 64;
constexpr int kOfMany = 8;  // repetitions of one joint for each repetition of all joints
constexpr double kAmbient_C = 10.0;
constexpr double kTemperatureNoise_C = 0.02;

struct Kind {
  std::string name;
  JointPlantConfig plant;
  MotionLimits motion;
  GainTable table;
};

std::vector<Kind> kinds() {
  const std::string tables = STRAINWAVE_SOURCE_DIR "/data/tables/";
  const GainTable rigid = read_gain_table(tables + "rhs17-6006.json");
  const GainTable total = read_gain_table(tables + "total-0.178/c4.json");
  JointPlantConfig spring = flexible_plant();
  spring.effects.gravity = {3.0, -0.5};
  return {{"rigid", realistic_plant(), {6.0, 150.0, 150.0}, rigid},
          {"flexible, with gravity", spring, kNoMotionLimits, total}};
}

void order(JointController& controller, int k) {
  if (k < kStreamBegins) {
    if (k % kMoveEvery == 0) controller.set_target(k / kMoveEvery % 2 == 0 ? 0.5 : -0.5);
    return;
  }
  if (k >= kStreamEnds || k % kSampleEvery != 0) return;
  const double w = 2.0 * std::numbers::pi;
  const double t = (k - kStreamBegins + kSampleEvery) * kPeriod_s;
  controller.follow(
      {-0.5 * std::cos(w * t), 0.5 * w * std::sin(w * t), 0.5 * w * w * std::cos(w * t), 2, kSampleEvery},
      k == kStreamBegins, 0.0, {});
}

/// One recorded joint, ready for replay.
class Replay {
 public:
  Replay(const Kind& kind, const std::vector<JointMeasurement>& run)
      : fresh_(extended_config(kind.plant, kind.table, kind.motion)), run_(run), controller_(fresh_) {
    fresh_.load(kind.table);
    begin();
  }
  void begin() {
    controller_ = fresh_;
    controller_.start(0.0);
  }
  double step(int k) {
    order(controller_, k);
    return controller_.step(run_[static_cast<std::size_t>(k)]).output.torque_Nm;
  }

 private:
  JointController fresh_;
  const std::vector<JointMeasurement>& run_;
  JointController controller_;
};

/// The sensor readings of the joint over the run.
std::vector<JointMeasurement> record(const Kind& kind) {
  JointController controller(extended_config(kind.plant, kind.table, kind.motion));
  controller.load(kind.table);
  controller.start(0.0);
  JointPlant plant(kind.plant);
  std::mt19937_64 random(1);
  std::vector<JointMeasurement> run;
  for (int k = 0; k < kSteps; ++k) {
    plant.set_ambient_temperature(kAmbient_C);
    const double noise = 2.0 * (static_cast<double>(random() >> 11U) * 0x1p-53) - 1.0;
    LoopSample sample;
    sample.joint_position_rad = plant.measured_position_rad();
    run.push_back(measurement_of(sample, plant.sensor_temperature_C() + kTemperatureNoise_C * noise));
    order(controller, k);
    const JointStep step = controller.step(run.back());
    if (step.oscillates)
      throw std::runtime_error(kind.name + ": the joint oscillates, the figures mean nothing");
    plant.step(step.output.torque_Nm);
  }
  return run;
}

volatile double sink;

double processor_time_ns() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

/// Mean time of a step in ns, over `joints` in turn.
double mean_ns(std::vector<Replay>& joints) {
  for (Replay& joint : joints) joint.begin();
  const double start_ns = processor_time_ns();
  double sum = 0.0;
  for (int k = 0; k < kSteps; ++k)
    for (Replay& joint : joints) sum += joint.step(k);
  sink = sum;
  return (processor_time_ns() - start_ns) / (kSteps * static_cast<double>(joints.size()));
}

/// Updates the least time of every step of the run. It includes the time of the clock call.
void time_each(Replay& joint, std::vector<double>& least_ns) {
  joint.begin();
  for (int k = 0; k < kSteps; ++k) {
    const auto start = std::chrono::steady_clock::now();
    sink = joint.step(k);
    const std::chrono::duration<double, std::nano> elapsed = std::chrono::steady_clock::now() - start;
    double& least = least_ns[static_cast<std::size_t>(k)];
    least = std::min(least, elapsed.count());
  }
}

void report(const Kind& kind, int repetitions) {
  const std::vector<JointMeasurement> run = record(kind);
  std::vector<Replay> one(1, Replay(kind, run));
  std::vector<Replay> many(kJoints, Replay(kind, run));
  double alone_ns = std::numeric_limits<double>::infinity();
  double in_turn_ns = alone_ns;
  std::vector<double> each_ns(kSteps, alone_ns);
  for (int repetition = 0; repetition < repetitions; ++repetition) {
    alone_ns = std::min(alone_ns, mean_ns(one));
    time_each(one.front(), each_ns);
    if (repetition % kOfMany == 0) in_turn_ns = std::min(in_turn_ns, mean_ns(many));
  }
  std::printf("%-34s %7.0f %11.0f %12.0f %12.1f %8zu\n", kind.name.c_str(), alone_ns,
              *std::max_element(each_ns.begin(), each_ns.end()), in_turn_ns,
              100.0 * kJoints * in_turn_ns * 1e-9 / kPeriod_s, sizeof(JointController));
}

}  // namespace
}  // namespace strainwave

int main(int argc, char** argv) {
  using namespace strainwave;
  const int repetitions = argc > 1 ? std::stoi(argv[1]) : 200;
  const std::vector<Kind> all = kinds();
  std::printf("%-34s %7s %11s %12s %12s %8s\n", "controller", "mean ns", "slowest ns", "of 64 in ns",
              "% of a core", "bytes");
  for (std::size_t i = 0; i < all.size(); ++i)
    if (argc <= 2 || static_cast<int>(i) == std::stoi(argv[2])) report(all[i], repetitions);
  return 0;
}
