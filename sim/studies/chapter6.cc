// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/chapter6.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>

#include "base/parallel.h"

namespace strainwave {

namespace {

std::vector<Chapter6Key> all_keys() {
  std::vector<Chapter6Key> keys;
  for (const Setting setting : kSettings)
    for (const Scenario scenario : kScenarios)
      for (int range = 0; range < kRangeCount; ++range) keys.push_back({setting, scenario, range});
  return keys;
}

}  // namespace

const ClosedLoopResult& Chapter6::at(const Chapter6Key& key, const std::string& contender) const {
  const auto run = std::find_if(runs.begin(), runs.end(), [&](const Chapter6Run& candidate) {
    return candidate.key == key && candidate.contender == contender;
  });
  if (run == runs.end()) throw std::out_of_range("no run of " + contender);
  return run->result;
}

const TimeOptimalResult* Chapter6::limit(const Chapter6Key& key) const {
  const auto found = std::find_if(limits.begin(), limits.end(),
                                  [&](const Chapter6Limit& limit) { return limit.key == key; });
  return found == limits.end() ? nullptr : &found->result;
}

Chapter6 run_chapter6(const std::vector<Contender>& contenders) {
  const auto start = std::chrono::steady_clock::now();
  Chapter6 chapter;
  for (const Contender& contender : contenders) chapter.contenders.push_back(contender.name);
  for (const Chapter6Key& key : all_keys()) {
    for (const Contender& contender : contenders) chapter.runs.push_back({key, contender.name, {}});
    if (key.setting != Setting::kIdeal) chapter.limits.push_back({key, {}});
  }
  const auto config_of = [](const Chapter6Key& key) {
    return scenario_config(key.scenario, key.range, setting_plant(key.setting));
  };
  run_in_parallel(chapter.runs.size() + chapter.limits.size(), [&](std::size_t i) {
    if (i >= chapter.runs.size()) {
      Chapter6Limit& limit = chapter.limits[i - chapter.runs.size()];
      limit.result = run_time_optimal(config_of(limit.key));
      return;
    }
    const ClosedLoopConfig config = config_of(chapter.runs[i].key);
    const auto controller = contenders[i % contenders.size()].make(config.plant);
    chapter.runs[i].result = run_closed_loop(config, *controller);
  });
  for (const Chapter6Run& run : chapter.runs) chapter.periods += static_cast<long>(run.result.trace.size());
  chapter.computation_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return chapter;
}

}  // namespace strainwave
