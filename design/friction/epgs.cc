// SPDX-License-Identifier: BSD-3-Clause
#include "design/friction/epgs.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <thread>

#include "base/input_error.h"

namespace strainwave {

namespace {

using Index = Eigen::Index;

// Distance in the unit box below which two points are the same.
constexpr double kSamePoint = 1e-3;

struct Individual {
  DescentPoint point;
  std::int64_t evaluations = 0;
  bool selected = false;
};

// The sequence of std::mt19937_64 is fixed by the standard, that of the library's distributions is not.
class Uniform {
 public:
  explicit Uniform(std::uint64_t seed) : generator_(seed) {}
  double operator()(double low, double high) {
    return low + (high - low) * (static_cast<double>(generator_() >> 11) * 0x1p-53);
  }
  std::size_t index(std::size_t count) {
    return static_cast<std::size_t>(operator()(0.0, static_cast<double>(count)));
  }

 private:
  std::mt19937_64 generator_;
};

class Search {
 public:
  Search(const GradientCost& cost, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
         const EpgsOptions& options)
      : cost_(cost), lower_(lower), range_(upper - lower), options_(options), uniform_(options.seed) {}

  EpgsResult run() {
    const std::size_t count = static_cast<std::size_t>(options_.population);
    for (std::size_t i = 0; i < count; ++i) fresh_.push_back(random_point());
    double reference = std::numeric_limits<double>::infinity();
    int stale = 0;
    for (;;) {
      evaluate_fresh();
      select();
      descend_selected();
      remember_best();
      if (result_.cost < reference - options_.improvement * std::abs(reference) ||
          !std::isfinite(reference)) {
        reference = result_.cost;
        stale = 0;
      } else {
        ++stale;
      }
      if (should_stop(stale)) break;
      breed();
    }
    finish();
    return result_;
  }

 private:
  Eigen::VectorXd random_point() {
    return Eigen::VectorXd::NullaryExpr(lower_.size(), [this] { return uniform_(0.0, 1.0); });
  }

  GradientCost scaled_cost() const {
    return [this](const Eigen::VectorXd& x, CostSample& sample) {
      cost_(lower_ + range_.cwiseProduct(x), sample);
      sample.gradient = sample.gradient.cwiseProduct(range_);
      if (sample.curvature.size() > 0)
        sample.curvature = range_.asDiagonal() * sample.curvature * range_.asDiagonal();
      // A point whose cost is not finite gets the largest cost, so that others are selected first.
      if (!std::isfinite(sample.value) || !sample.gradient.allFinite()) {
        sample.value = std::numeric_limits<double>::max();
        sample.gradient.setZero(x.size());
      }
    };
  }

  template <typename Work>
  void in_parallel(std::size_t count, const Work& work) const {
    const auto workers = static_cast<std::size_t>(
        std::clamp(options_.threads, 1, static_cast<int>(std::max<std::size_t>(count, 1))));
    std::atomic<std::size_t> next{0};
    const auto run = [&] {
      for (std::size_t i = next++; i < count; i = next++) work(i);
    };
    std::vector<std::thread> others;
    for (std::size_t w = 1; w < workers; ++w) others.emplace_back(run);
    run();
    for (std::thread& other : others) other.join();
  }

  void evaluate_fresh() {
    const GradientCost cost = scaled_cost();
    const std::size_t kept = population_.size();
    population_.resize(kept + fresh_.size());
    in_parallel(fresh_.size(), [&](std::size_t i) {
      Individual& individual = population_[kept + i];
      individual.point = start_descent(cost, fresh_[i]);
      individual.evaluations = 1;
      individual.selected = false;
    });
    fresh_.clear();
  }

  bool is_copy(const Individual& candidate, const std::vector<std::size_t>& order, std::size_t until) const {
    for (std::size_t i = 0; i < until; ++i) {
      const Individual& other = population_[order[i]];
      if (!other.selected) continue;
      if ((candidate.point.x - other.point.x).cwiseAbs().maxCoeff() < kSamePoint) return true;
    }
    return false;
  }

  // The best by f, then the best of the rest by g; copies of a better point are passed over.
  void select() {
    std::vector<std::size_t> order(population_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (Individual& individual : population_) individual.selected = false;
    std::ranges::stable_sort(order, {}, [this](std::size_t i) { return population_[i].point.sample.value; });
    std::size_t places = share(options_.clone_by_cost);
    for (std::size_t i = 0; i < order.size() && places > 0; ++i) {
      if (is_copy(population_[order[i]], order, i)) continue;
      population_[order[i]].selected = true;
      --places;
    }
    std::ranges::stable_sort(order, {}, [this](std::size_t i) {
      const DescentPoint& point = population_[i].point;
      return point.sample.value - options_.slope_weight * projected_slope(point);
    });
    places = share(options_.clone_by_promise);
    for (std::size_t i = 0; i < order.size() && places > 0; ++i) {
      Individual& individual = population_[order[i]];
      if (individual.selected || individual.point.converged) continue;
      individual.selected = true;
      --places;
    }
  }

  void descend_selected() {
    const GradientCost cost = scaled_cost();
    in_parallel(population_.size(), [&](std::size_t i) {
      Individual& individual = population_[i];
      if (!individual.selected) return;
      for (int step = 0; step < options_.steps && !individual.point.converged; ++step) {
        individual.evaluations += descend(cost, individual.point, options_.step_tolerance);
      }
    });
    for (Individual& individual : population_) {
      result_.evaluations += individual.evaluations;
      individual.evaluations = 0;
    }
  }

  void remember_best() {
    for (const Individual& individual : population_) {
      if (best_.x.size() == 0 || individual.point.sample.value < best_.sample.value) best_ = individual.point;
    }
    result_.cost = best_.sample.value;
    result_.best_by_generation.push_back(result_.cost);
    ++result_.generations;
  }

  bool should_stop(int stale) {
    if (result_.cost <= options_.known_optimum + options_.optimum_tolerance) {
      result_.stop = EpgsStop::kKnownOptimum;
    } else if (stale >= options_.patience) {
      result_.stop = EpgsStop::kNoImprovement;
    } else if (result_.generations >= options_.generation_limit) {
      result_.stop = EpgsStop::kGenerationLimit;
    } else {
      return false;
    }
    return true;
  }

  // The selected points stay. Their children with the rest, then fresh points complete the population.
  void breed() {
    std::vector<Individual> selected;
    std::vector<Individual> rest;
    for (Individual& individual : population_)
      (individual.selected ? selected : rest).push_back(std::move(individual));
    for (std::size_t i = share(options_.crossover); i > 0; --i) {
      const Eigen::VectorXd& a = selected[uniform_.index(selected.size())].point.x;
      const Eigen::VectorXd& b = rest.empty() ? a : rest[uniform_.index(rest.size())].point.x;
      const double r = uniform_(0.0, 1.0);
      Eigen::VectorXd child = r * a + (1.0 - r) * b;
      for (Index v = 0; v < child.size(); ++v) {
        const double q = uniform_(-1.0, 1.0);
        if (std::abs(q) < options_.mutation) child(v) += q;
      }
      fresh_.push_back(child.cwiseMax(0.0).cwiseMin(1.0));
    }
    population_ = std::move(selected);
    while (population_.size() + fresh_.size() < static_cast<std::size_t>(options_.population))
      fresh_.push_back(random_point());
  }

  // Descends from the best point until it converges.
  void finish() {
    constexpr int kStepLimit = 500;
    const GradientCost cost = scaled_cost();
    best_ = start_descent(cost, best_.x);
    ++result_.evaluations;
    for (int step = 0; step < kStepLimit && !best_.converged; ++step) {
      result_.evaluations += descend(cost, best_, options_.final_tolerance);
    }
    result_.cost = best_.sample.value;
    result_.x = (lower_ + range_.cwiseProduct(best_.x)).cwiseMax(lower_).cwiseMin(lower_ + range_);
  }

  std::size_t share(double part) const {
    return static_cast<std::size_t>(std::lround(part * static_cast<double>(options_.population)));
  }

  const GradientCost& cost_;
  Eigen::VectorXd lower_, range_;
  const EpgsOptions& options_;
  Uniform uniform_;
  std::vector<Individual> population_;
  std::vector<Eigen::VectorXd> fresh_;
  DescentPoint best_;
  EpgsResult result_;
};

}  // namespace

const char* name_of(EpgsStop stop) {
  switch (stop) {
    case EpgsStop::kGenerationLimit:
      return "generation limit";
    case EpgsStop::kNoImprovement:
      return "no improvement";
    case EpgsStop::kKnownOptimum:
      return "within tolerance of the known optimum";
  }
  return "?";
}

EpgsResult minimise_epgs(const GradientCost& cost, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                         const EpgsOptions& options) {
  if (lower.size() == 0 || lower.size() != upper.size() || !((upper - lower).minCoeff() > 0.0)) {
    throw InputError("EPGS: the box is empty: every upper bound must be above its lower bound");
  }
  const double shares = options.clone_by_cost + options.clone_by_promise + options.crossover;
  if (options.population < 4 || !(options.clone_by_cost * options.population >= 0.5) || !(shares <= 1.0)) {
    throw InputError(
        "EPGS: population must be at least 4, with one or more points by cost, and the shares at most 1 "
        "together");
  }
  return Search(cost, lower, upper, options).run();
}

}  // namespace strainwave
