// SPDX-License-Identifier: BSD-3-Clause
// Compares EPGS with NLopt's global optimisers on the costs of the friction fits. It shows how often each
// reaches the target within the same processor time on one core, and how soon. Prints a table.
//
//   estimation_benchmark [SEEDS [SECONDS]]    default 100 seeds, 1 s each
#include <nlopt.h>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "design/friction/catalogue.h"
#include "design/friction/estimation.h"

namespace strainwave {
namespace {

double processor_time_s() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

struct Task {
  std::string name;
  GradientCost cost;
  Eigen::VectorXd lower, upper;
  double target = 0.0;
  EpgsOptions options;
};

struct Outcome {
  double best = 1e300;
  double reached_s = -1.0;  // processor time at which the target was first met; < 0: never
  double total_s = 0.0;
};

struct TimeIsUp {};

// Tracks time and success during evaluations of a cost.
class Watch {
 public:
  Watch(const Task& task, double limit_s) : task_(task), limit_s_(limit_s), start_s_(processor_time_s()) {}
  void evaluate(const Eigen::VectorXd& x, CostSample& sample) {
    task_.cost(x, sample);
    const double elapsed_s = processor_time_s() - start_s_;
    if (sample.value < outcome_.best) outcome_.best = sample.value;
    if (outcome_.best <= task_.target && outcome_.reached_s < 0.0) outcome_.reached_s = elapsed_s;
    outcome_.total_s = elapsed_s;
  }
  bool time_is_up() const { return outcome_.total_s > limit_s_; }
  const Outcome& outcome() const { return outcome_; }

 private:
  const Task& task_;
  double limit_s_;
  double start_s_;
  Outcome outcome_;
};

struct NloptRun {
  Watch* watch;
  nlopt_opt optimiser;
};

double nlopt_cost(unsigned count, const double* x, double* gradient, void* data) {
  const auto* run = static_cast<NloptRun*>(data);
  const auto n = static_cast<Eigen::Index>(count);
  CostSample sample;
  run->watch->evaluate(Eigen::VectorXd::Map(x, n), sample);
  if (gradient != nullptr) Eigen::VectorXd::Map(gradient, n) = sample.gradient;
  if (run->watch->time_is_up()) nlopt_force_stop(run->optimiser);
  return sample.value;
}

// EPGS chooses its own number of generations. It may end before the time limit.
Outcome run_epgs(const Task& task, unsigned seed, double limit_s) {
  Watch watch(task, limit_s);
  EpgsOptions options = task.options;
  options.seed = seed;
  try {
    minimise_epgs(
        [&watch](const Eigen::VectorXd& x, CostSample& sample) {
          watch.evaluate(x, sample);
          if (watch.time_is_up()) throw TimeIsUp();
        },
        task.lower, task.upper, options);
  } catch (const TimeIsUp&) {
  }
  return watch.outcome();
}

Outcome run_nlopt(const Task& task, nlopt_algorithm algorithm, bool with_local, unsigned seed,
                  double limit_s) {
  Watch watch(task, limit_s);
  nlopt_srand(seed);
  const auto n = static_cast<unsigned>(task.lower.size());
  const nlopt_opt optimiser = nlopt_create(algorithm, n);
  NloptRun run{&watch, optimiser};
  nlopt_set_lower_bounds(optimiser, task.lower.data());
  nlopt_set_upper_bounds(optimiser, task.upper.data());
  nlopt_set_min_objective(optimiser, nlopt_cost, &run);
  if (with_local) {
    const nlopt_opt local = nlopt_create(NLOPT_LD_LBFGS, n);
    nlopt_set_ftol_rel(local, 1e-5);
    nlopt_set_maxeval(local, 300);
    nlopt_set_local_optimizer(optimiser, local);
    nlopt_destroy(local);  // the optimiser has copied it
  }
  // The start lies inside the box and depends on the seed.
  Eigen::VectorXd x(task.lower.size());
  for (unsigned i = 0; i < n; ++i) {
    const auto v = static_cast<Eigen::Index>(i);
    const double part = 0.1 + 0.8 * static_cast<double>((seed * 7919u + i * 104729u) % 1000u) / 1000.0;
    x(v) = task.lower(v) + part * (task.upper(v) - task.lower(v));
  }
  double value = 0.0;
  nlopt_optimize(optimiser, x.data(), &value);  // ignores the status: the watch saw every evaluation
  nlopt_destroy(optimiser);
  return watch.outcome();
}

void print_row(const Task& task, const char* method, const std::vector<Outcome>& outcomes) {
  int reached = 0;
  double best = 1e300, longest_s = 0.0;
  std::vector<double> times_s, costs;
  for (const Outcome& outcome : outcomes) {
    reached += outcome.reached_s >= 0.0 ? 1 : 0;
    if (outcome.reached_s >= 0.0) times_s.push_back(outcome.reached_s);
    costs.push_back(outcome.best);
    best = std::min(best, outcome.best);
    longest_s = std::max(longest_s, outcome.total_s);
  }
  std::sort(costs.begin(), costs.end());
  std::sort(times_s.begin(), times_s.end());
  const double median_s = times_s.empty() ? -1.0 : times_s[times_s.size() / 2];
  std::printf("| %-24s | %-14s | %4d of %-4zu | %10.6f | %10.6f | %8.3f | %8.3f |\n", task.name.c_str(),
              method, reached, outcomes.size(), best, costs[costs.size() / 2], median_s, longest_s);
  std::fflush(stdout);
}

std::vector<Task> tasks() {
  const FrictionData data = read_catalogue(STRAINWAVE_SOURCE_DIR "/data/friction_parameters.csv");
  const FitTargets targets = fit_targets(data);
  const Eigen::Matrix3d metric = friction_metric(FitWeighting::kSource, data.motor_speeds_rpm);
  Eigen::VectorXd lower(10), upper(10);
  lower << Eigen::VectorXd::Constant(5, -15.0), Eigen::VectorXd::Constant(5, 1.0);
  upper << Eigen::VectorXd::Constant(5, 45.0), Eigen::VectorXd::Constant(5, 15.0);
  const FitProblem physical{targets, metric, true};
  const FitProblem unconstrained{targets, metric, false};
  return {{"exponential <= 0.905", exponential_cost(physical), Eigen::VectorXd::Constant(1, 1.0),
           Eigen::VectorXd::Constant(1, 500.0), 0.905, exponential_search_options()},
          {"fuzzy physical <= 0.0100", fuzzy_cost(physical), lower, upper, 0.0100, fuzzy_search_options()},
          {"fuzzy free <= 0.0075", fuzzy_cost(unconstrained), lower, upper, 0.0075, fuzzy_search_options()}};
}

void run(unsigned seeds, double limit_s) {
  struct Method {
    const char* name;
    nlopt_algorithm algorithm;
    bool with_local;
  };
  const std::vector<Method> methods{{"CRS2", NLOPT_GN_CRS2_LM, false},
                                    {"ISRES", NLOPT_GN_ISRES, false},
                                    {"MLSL+L-BFGS", NLOPT_G_MLSL_LDS, true}};
  std::printf("| %-24s | %-14s | %-12s | %10s | %10s | %8s | %8s |\n", "cost and target", "method", "reached",
              "best", "median", "to it s", "longest");
  std::printf("|---|---|---|---|---|---|---|\n");
  for (const Task& task : tasks()) {
    std::vector<Outcome> outcomes;
    for (unsigned seed = 1; seed <= seeds; ++seed) outcomes.push_back(run_epgs(task, seed, limit_s));
    print_row(task, "EPGS", outcomes);
    for (const Method& method : methods) {
      outcomes.clear();
      for (unsigned seed = 1; seed <= seeds; ++seed) {
        outcomes.push_back(run_nlopt(task, method.algorithm, method.with_local, seed, limit_s));
      }
      print_row(task, method.name, outcomes);
    }
  }
}

}  // namespace
}  // namespace strainwave

int main(int argc, char** argv) {
  const int seeds = argc > 1 ? std::stoi(argv[1]) : 100;
  const double limit_s = argc > 2 ? std::stod(argv[2]) : 1.0;
  if (seeds < 1 || !(limit_s > 0.0)) {
    std::fputs("usage: estimation_benchmark [SEEDS [SECONDS]]\n", stderr);
    return 1;
  }
  strainwave::run(static_cast<unsigned>(seeds), limit_s);
  return 0;
}
