// SPDX-License-Identifier: BSD-3-Clause
// bench/timing: compares the wake-up latency of the daemon's loop with cyclictest's, in alternating slices on one machine.
//   timing [SLICES] [SECONDS_PER_SLICE] [JOINTS]
// The latencies of both sides go through the same histogram, so that the ratio compares like with like. Needs the
// right to SCHED_FIFO and the program cyclictest (Debian: rt-tests).

#include <unistd.h>

#include <chrono>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <memory>
#include <numeric>
#include <sstream>
#include <string>
#include <thread>

#include "base/input_error.h"
#include "base/printable.h"
#include "control/table/gain_table_json.h"
#include "daemon/assembly.h"
#include "daemon/realtime/loop/realtime_loop.h"
#include "drivers/simulated_actuator.h"

namespace strainwave {
namespace {

constexpr int kPriority = 80;
constexpr int kMicrosecondsOfHistogram = 50'000;

DaemonConfig bench_config(int joints) {
  DaemonConfig config;
  config.loop.real_time = RealTimePolicy::kIgnore;
  config.loop.priority = kPriority;
  for (int i = 0; i < joints; ++i) {
    JointConfig joint;
    joint.name = "j" + std::to_string(i);
    joint.loop.limits = {-10.0, 10.0, 1.0, 100.0, 10.0, 190.0, 200.0, {34.0, {}, {}}};
    joint.loop.controller.torque_limit_Nm = 34.0;
    joint.drive = SimulatedDrive{simulated_reference_joint(false), {}};
    config.joints.push_back(joint);
  }
  return config;
}

struct Slice {
  HistogramCounts counts{};
  std::int64_t max_ns = 0;
};

void add(Slice& to, const Slice& from) {
  for (std::size_t i = 0; i < to.counts.size(); ++i) to.counts[i] += from.counts[i];
  to.max_ns = std::max(to.max_ns, from.max_ns);
}

/// The value below which `fraction` of the counted durations lie, interpolated within its bucket; 0 when empty.
double percentile_ns(const HistogramCounts& counts, double fraction) {
  const double wanted = fraction * static_cast<double>(std::accumulate(counts.begin(), counts.end(), 0LL));
  double seen = 0.0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const auto count = static_cast<double>(counts[i]);
    if (count > 0.0 && seen + count >= wanted) {
      const double lower_ns = i == 0 ? 0.0 : bucket_upper_ns(i - 1);
      return lower_ns + (bucket_upper_ns(i) - lower_ns) * (wanted - seen) / count;
    }
    seen += count;
  }
  return 0.0;
}

Order order(OrderKind kind) {
  Order order;
  order.kind = kind;
  return order;
}

Slice run_ours(double seconds, int joints, const GainTable& table) {
  auto states = std::make_unique<decltype(OutboundMemory::states)>();
  const DaemonConfig config = bench_config(joints);
  RealtimeLoop loop(config.loop, assemble_loop(config), *states);
  for (std::size_t i = 0; i < loop.joint_count(); ++i) {
    loop.joint(i).table_slot(0) = {table, 1};
    loop.joint(i).orders().push(order(OrderKind::kUseTable));
  }
  loop.start();
  if (!loop.real_time_refusal().empty()) throw InputError(loop.real_time_refusal());
  // The joint takes the first order with its first reading. The order to enable must follow a cycle later.
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  for (std::size_t i = 0; i < loop.joint_count(); ++i) loop.joint(i).orders().push(order(OrderKind::kEnable));
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  const Slice slice{loop.statistics().wakeup_latency.counts(), loop.statistics().wakeup_latency.max_ns()};
  loop.request_stop();
  while (!loop.finished()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  return slice;
}

Slice run_cyclictest(double seconds) {
  const std::string output = "/tmp/strainwave-cyclictest-" + std::to_string(::getpid());
  std::ostringstream command;
  command << "cyclictest --quiet --mlockall --policy fifo --priority " << kPriority
          << " --interval 1000 --threads 1"
          << " --duration " << static_cast<int>(seconds) << " --histogram " << kMicrosecondsOfHistogram
          << " >" << output << " 2>/dev/null";
  if (std::system(command.str().c_str()) != 0)  // NOLINT(concurrency-mt-unsafe)
    throw InputError("cyclictest cannot be run: install rt-tests, run as root");
  Histogram histogram;
  std::ifstream file(output);
  std::string line;
  while (std::getline(file, line)) {
    std::int64_t microseconds = 0;
    std::int64_t count = 0;
    if (line.empty() || line[0] == '#' || !(std::istringstream(line) >> microseconds >> count)) continue;
    // cyclictest truncates to whole microseconds, so the middle of each is unbiased.
    for (std::int64_t i = 0; i < count; ++i) histogram.add(microseconds * 1000 + 500);
  }
  std::remove(output.c_str());
  return {histogram.counts(), histogram.max_ns()};
}

int run(int slices, double seconds, int joints) {
  const GainTable table = read_gain_table(STRAINWAVE_SOURCE_DIR "/data/tables/rhs17-6006.json");
  Slice ours;
  Slice theirs;
  for (int i = 0; i < slices; ++i) {
    add(ours, run_ours(seconds, joints, table));
    add(theirs, run_cyclictest(seconds));
  }
  std::printf("wake-up latency in us, 1 kHz, SCHED_FIFO %d, %d alternating slices of %g s, in our loop %s\n",
              kPriority, slices, seconds, counted(joints, "joint").c_str());
  std::printf("%-12s %12s %12s %8s\n", "", "strainwave", "cyclictest", "ratio");
  const std::pair<const char*, double> rows[] = {
      {"p50", 0.5}, {"p90", 0.9}, {"p99", 0.99}, {"p99.9", 0.999}, {"p99.99", 0.9999}};
  for (const auto& [name, fraction] : rows) {
    const double a = percentile_ns(ours.counts, fraction) / 1000.0;
    const double b = percentile_ns(theirs.counts, fraction) / 1000.0;
    std::printf("%-12s %12.1f %12.1f %8.2f\n", name, a, b, a / b);
  }
  std::printf("%-12s %12.1f %12.1f %8.2f\n", "max", static_cast<double>(ours.max_ns) / 1000.0,
              static_cast<double>(theirs.max_ns) / 1000.0,
              static_cast<double>(ours.max_ns) / static_cast<double>(theirs.max_ns));
  return 0;
}

}  // namespace
}  // namespace strainwave

int main(int argc, char** argv) {
  try {
    const auto argument = [&](int i, double fallback) { return argc > i ? std::stod(argv[i]) : fallback; };
    return strainwave::run(static_cast<int>(argument(1, 5)), argument(2, 4),
                           static_cast<int>(argument(3, 1)));
  } catch (const std::exception& error) {
    std::cerr << "timing: " << error.what() << '\n';
    return 1;
  }
}
