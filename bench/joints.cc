// SPDX-License-Identifier: BSD-3-Clause
// Measures the cost of several joints in one loop: cycles of 8, 16, 32 and 64 moving simulated joints. Slices
// alternate, so that disturbances of the machine affect all counts alike. Prints the cost per joint and
// cycle, its ratio to that of 8 joints, and the share of one processor at the configured period. Processor
// time, not wall time.
#include <ctime>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <vector>

#include "tests/support/joint_bench.h"

namespace {

using strainwave::testing::JointBench;

constexpr double kPeriod_s = 0.001;
constexpr int kSliceJointCycles = 64 * 250;  // the same work in every slice
constexpr std::size_t kRecordSamples = 5000;

double processor_time_s() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Joints in constant motion: each moves back and forth, out of phase with the others.
class Arm {
 public:
  explicit Arm(std::size_t joints)
      : bench_(std::vector<strainwave::testing::BenchJoint>(joints, strainwave::testing::demo_joint())),
        joints_(joints) {
    for (std::size_t i = 0; i < joints; ++i) {
      recorders_.push_back(std::make_unique<strainwave::FlightRecorder>(kRecordSamples, kRecordSamples / 10));
      bench_.joint(i).record_into(*recorders_.back());
      bench_.bring_to_hold(i);
    }
  }

  /// Seconds per joint and cycle, over one slice.
  double slice_s() {
    const int cycles = kSliceJointCycles / static_cast<int>(joints_);
    const double start_s = processor_time_s();
    for (int i = 0; i < cycles; ++i) {
      give_orders();
      bench_.step();
    }
    return (processor_time_s() - start_s) / kSliceJointCycles;
  }
  bool sound() const {
    for (std::size_t i = 0; i < joints_; ++i)
      if (bench_.mode(i) == strainwave::Mode::kFaulted) return false;
    return true;
  }

 private:
  void give_orders() {
    constexpr std::size_t kEvery = 500;
    for (std::size_t i = 0; i < joints_; ++i) {
      if ((count_ + 61 * i) % kEvery != 0) continue;
      strainwave::Order order;
      order.kind = strainwave::OrderKind::kSetpoint;
      order.position_rad = (count_ + 61 * i) / kEvery % 2 == 0 ? 1.0 : -1.0;
      (void)bench_.joint(i).orders().push(order);
    }
    ++count_;
  }

  JointBench bench_;
  std::size_t joints_;
  std::size_t count_ = 0;
  std::vector<std::unique_ptr<strainwave::FlightRecorder>> recorders_;
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

int main(int argc, char** argv) {
  const int slices = argc > 1 ? std::stoi(argv[1]) : 100;
  const std::vector<std::size_t> counts{8, 16, 32, 64};
  std::vector<std::unique_ptr<Arm>> arms;
  arms.reserve(counts.size());
  for (const std::size_t count : counts) arms.push_back(std::make_unique<Arm>(count));
  std::vector<std::vector<double>> costs_s(counts.size());
  for (const auto& arm : arms) arm->slice_s();  // warm-up
  for (int slice = 0; slice < slices; ++slice)
    for (std::size_t i = 0; i < arms.size(); ++i) costs_s[i].push_back(arms[i]->slice_s());
  std::printf("joints  ns per joint and cycle  ratio to 8  %% of one processor at 1 kHz\n");
  const double first_s = median(costs_s.front());
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (!arms[i]->sound()) {
      std::fprintf(stderr, "a joint has faulted: the figures mean nothing\n");
      return 1;
    }
    const double cost_s = median(costs_s[i]);
    std::printf("%6zu  %22.0f  %10.3f  %27.2f\n", counts[i], 1e9 * cost_s, cost_s / first_s,
                100.0 * cost_s * static_cast<double>(counts[i]) / kPeriod_s);
  }
  return 0;
}
