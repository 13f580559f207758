// SPDX-License-Identifier: BSD-3-Clause
// Counts edges of the lines quadrature_a and quadrature_b of the chip "joint-board" with the driver's own thread, as the daemon does. When standard
// input ends, it prints the count and the number of the fault.
//
//   quadrature_probe MAX_RATE_HZ DEBOUNCE_S
#include <time.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "base/input_error.h"
#include "drivers/gpio/quadrature_counts.h"

namespace {

std::int64_t monotonic_ns() noexcept {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  strainwave::QuadratureConfig config;
  config.a = {"joint-board", "quadrature_a", strainwave::LineBias::kAsIs, false, std::atof(argv[2])};
  config.b = {"joint-board", "quadrature_b", strainwave::LineBias::kAsIs, false};
  config.max_rate_Hz = std::atof(argv[1]);
  config.clock_ns = &monotonic_ns;
  try {
    strainwave::QuadratureCounts counts(config, "quadrature_probe", "probe");
    std::puts("ready");
    std::fflush(stdout);
    char byte = 0;
    while (::read(STDIN_FILENO, &byte, 1) > 0) {
    }
    const auto sample = counts.read(monotonic_ns());
    std::printf("%lld %d\n", static_cast<long long>(sample.counts), static_cast<int>(counts.fault()));
  } catch (const strainwave::InputError& error) {
    std::printf("%s\n", error.what());
    return 1;
  }
  return 0;
}
