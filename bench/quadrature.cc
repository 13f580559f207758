// SPDX-License-Identifier: BSD-3-Clause
// Measures the decoding of one encoder edge without the kernel's part. This bounds the rate that the software
// fallback can reach.
#include <benchmark/benchmark.h>

#include "drivers/gpio/quadrature_decoder.h"

namespace strainwave {
namespace {

void edge(benchmark::State& bench) {
  QuadratureDecoder decoder(1e9);
  decoder.reset(false, false, 0);
  Edge next;
  std::uint32_t step = 0;
  for (auto _ : bench) {
    // Forward: A rises, B rises, A falls, B falls.
    next.line = step % 2;
    next.active = step % 4 < 2;
    next.time_ns += 1000;
    ++next.sequence;
    ++step;
    benchmark::DoNotOptimize(decoder.apply(next));
  }
  if (decoder.fault() != QuadratureFault::kNone) bench.SkipWithError("the decoder refused an edge");
  bench.SetItemsProcessed(bench.iterations());
}
BENCHMARK(edge);

}  // namespace
}  // namespace strainwave

BENCHMARK_MAIN();
