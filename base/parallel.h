// SPDX-License-Identifier: BSD-3-Clause
// Independent jobs on all cores. Each job has its own index, so results do not depend on the number of
// threads. Offline.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <thread>
#include <vector>

namespace strainwave {

/// Calls job(0) ... job(count - 1), each once. The exception of the lowest failing index is rethrown when all
/// have ended.
template <typename Job>
void run_in_parallel(std::size_t count, const Job& job) {
  std::atomic<std::size_t> next{0};
  std::vector<std::exception_ptr> failures(count);
  const auto work = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        job(i);
      } catch (...) {
        failures[i] = std::current_exception();
      }
    }
  };
  {
    std::vector<std::jthread> helpers;
    const std::size_t threads =
        std::min<std::size_t>(count, std::max(1U, std::thread::hardware_concurrency()));
    for (std::size_t i = 1; i < threads; ++i) helpers.emplace_back(work);
    work();
  }
  for (const auto& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

}  // namespace strainwave
