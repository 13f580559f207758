// What StreamTarget makes of a sample's derivatives: whether they may be believed, and those that it lacks.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "control/trajectory/stream_target.h"

namespace strainwave {

namespace {

// Of what the two nodes before said that is new. On a sine of angular frequency w nodes s and s' ago say w^2 s s' / 6 of it, 0.22 where two of
// three samples of 20 Hz are lost; one that is taken for another's time says more than all before.
constexpr double kLittleNew = 0.5;
// A velocity may differ from that of the positions by these shares of the limit (the less, the farther apart the samples are) and of
// itself, for what arrivals do to times, and by what acceleration makes of it meanwhile: so many times the positions' own.
constexpr double kDoubtOfLimit = 0.02;
constexpr double kDoubtOfItself = 0.5;
constexpr double kDoubtOfAcceleration = 2.0;
// What contradicts, and what is a little off, as where an acceleration steps, is so many times what agrees; of so much doubt on none is believed, and
// of more than so long a time it is not gathered.
constexpr int kContradiction = 4;
constexpr int kLittleOff = 2;
constexpr int kDoubted = 8;
constexpr double kMostDoubted_s = 2.0;
// Where times are exact, what a velocity is off would be an acceleration, to and fro, of six times this from sample to sample, rad/s^2.
constexpr double kExact_rad_s2 = 0.25;

/// Of three values that lie on a parabola, by the mean rates of the newer and the older interval.
double change_of_rate(double newer, double newer_s, double older, double older_s) noexcept {
  return 2.0 * (newer - older) / (newer_s + older_s);
}

struct ToldMotion {
  double at_s = 0.0;
  double position_rad = 0.0;
  double velocity_rad_s = 0.0;
};
struct Exactness {
  bool tells = false;
  double off_rad_s = 0.0;
  double doubt_rad_s = 0.0;
  double mean_rad_s = 0.0;
};
/// Of samples with times of their own: how far the mean of the last two velocities is from the one between their positions, and how far it may be
/// where a steady jerk explains that, T^2 / 12 of it.
Exactness exactness_of(const ToldMotion& newest, const ToldMotion& last, const ToldMotion& first) noexcept {
  const double newer_s = newest.at_s - last.at_s, older_s = last.at_s - first.at_s;
  const double mean_rad_s = (newest.position_rad - last.position_rad) / newer_s;
  const double jerk_rad_s3 = change_of_rate((newest.velocity_rad_s - last.velocity_rad_s) / newer_s, newer_s,
                                            (last.velocity_rad_s - first.velocity_rad_s) / older_s, older_s);
  return {true, std::abs(0.5 * (newest.velocity_rad_s + last.velocity_rad_s) - mean_rad_s),
          kExact_rad_s2 * newer_s + std::abs(jerk_rad_s3) * newer_s * newer_s / 6.0, std::abs(mean_rad_s)};
}

}  // namespace

// Whether the velocity that it gives is that of its positions, and not in degrees, of another sign, or left over. Followed, it would take the
// joint away from every position that was sent. Where all are near 0 none contradicts: there it is the stream's other velocities that tell.
bool StreamTarget::believes(const Knot& knot, const Before& before) noexcept {
  const auto [last, first] = before;
  if (last == nullptr) return doubted_ < kDoubted;
  const double doubt_rad_s = kDoubtOfLimit * reach_.velocity_rad_s * std::min(1.0, kApart_s / mean_s_) +
                             kDoubtOfItself * std::min(std::abs(knot.velocity_rad_s), std::abs(mean_rad_s_));
  double acceleration_rad_s2 = reach_.acceleration_rad_s2;
  if (first != nullptr) {
    const double older_s = seconds(last->at - first->at);
    const double older_rad_s = (last->position_rad - first->position_rad) / older_s;
    const double own_rad_s2 = std::abs(change_of_rate(mean_rad_s_, mean_s_, older_rad_s, older_s));
    acceleration_rad_s2 = std::min(acceleration_rad_s2, kDoubtOfAcceleration * own_rad_s2);
  }
  const double changed_rad_s = acceleration_rad_s2 * mean_s_;
  const double between_rad_s = 0.5 * (knot.sent_rad_s + last->sent_rad_s);
  const bool contradicts = std::abs(knot.velocity_rad_s - mean_rad_s_) > doubt_rad_s + changed_rad_s ||
                           std::abs(between_rad_s - mean_rad_s_) > doubt_rad_s + 0.5 * changed_rad_s;
  Exactness exactness;
  if (knot.stamped && past_count_ >= 2 && past_[0].stamped && past_[1].stamped) {
    const auto told = [this](const Knot& one) {
      return ToldMotion{seconds(one.at), one.position_rad, one.sent_rad_s};
    };
    exactness = exactness_of(told(knot), told(past_[0]), told(past_[1]));
  }
  const bool little_off = exactness.tells && exactness.off_rad_s > exactness.doubt_rad_s;
  // Where none at all would contradict, or be off, as well, this one agrees.
  const bool agrees = exactness.tells ? exactness.mean_rad_s > exactness.doubt_rad_s
                                      : std::abs(mean_rad_s_) > doubt_rad_s + changed_rad_s;
  if (contradicts || little_off)
    doubted_ = std::min(doubted_ + (contradicts ? kContradiction : kLittleOff),
                        static_cast<int>(kMostDoubted_s / seconds(expected_interval())));
  else if (agrees)
    doubted_ = std::max(doubted_ - 1, 0);
  return !contradicts && doubted_ < kDoubted;
}

void StreamTarget::estimate_derivatives(const StreamSample& sample, const Before& before,
                                        Knot& knot) noexcept {
  const auto [last, first] = before;
  if (sample.derivatives < 2) knot.acceleration_rad_s2 = 0.0;
  if (sample.derivatives < 1) knot.velocity_rad_s = 0.0;
  if (last == nullptr) return;
  if (sample.derivatives == 0) return derive_from_positions(before, knot);
  if (sample.derivatives == 2) {
    knot.jerk_rad_s3 = derivatives_at(knot, before, &Knot::acceleration_rad_s2).first;
    return;
  }
  const Derivatives shown = derivatives_at(knot, before, &Knot::velocity_rad_s);
  knot.acceleration_rad_s2 = shown.first;
  knot.jerk_rad_s3 = shown.second;
}

// Likewise. What needs more acceleration than can be is a place: nothing before it says anything about a motion.
void StreamTarget::derive_from_positions(const Before& before, Knot& knot) noexcept {
  const auto [last, first] = before;
  const bool stands = past_count_ >= 2 && knot.position_rad == past_[0].position_rad &&
                      knot.position_rad == past_[1].position_rad && knot.position_rad == last->position_rad;
  if (stands) return;
  if (first == nullptr) {
    const double possible = kReach * reach_.acceleration_rad_s2 * mean_s_;
    if (std::abs(mean_rad_s_ - state_.velocity_rad_s) <= possible) knot.velocity_rad_s = mean_rad_s_;
    return;
  }
  const double older_s = seconds(last->at - first->at);
  const double older_rad_s = (last->position_rad - first->position_rad) / older_s;
  const double acceleration_rad_s2 = change_of_rate(mean_rad_s_, mean_s_, older_rad_s, older_s);
  if (std::abs(acceleration_rad_s2) > kReach * reach_.acceleration_rad_s2) {
    past_count_ = left_behind_ = 0;
    return;
  }
  const Derivatives shown = derivatives_at(knot, before, &Knot::position_rad);
  knot.velocity_rad_s = shown.first;
  knot.acceleration_rad_s2 = shown.second;
  knot.jerk_rad_s3 = shown.third;
}

// Whether the fit through many positions has missed what came by less, or little more, than the polynomial that would be taken else, which missed this one by
// `missed_rad`.
bool StreamTarget::fits_better(const Knot& newest, const Before& before, double missed_rad) noexcept {
  fit_.weigh(seconds(newest.at - past_[0].at), newest.position_rad - past_[0].position_rad, missed_rad);
  MotionFit::Samples ages_s{}, positions_rad{};
  positions_rad[0] = newest.position_rad;
  std::size_t count = 1;
  const Knot* node = before.last;
  for (; count < MotionFit::kSamples && node != nullptr; ++count) {
    ages_s[count] = seconds(newest.at - node->at);
    positions_rad[count] = node->position_rad;
    node = count == 1 ? before.first : sample_before(node->at, kApart_s);
  }
  if (count == MotionFit::kSamples)
    fit_.fit(ages_s, positions_rad);
  else
    fit_.no_fit();
  return fit_.helps();
}

// Of the polynomial through the newest and the samples before, in Newton's form: through two of them, and in slow streams through as many
// more, up to kNodes with the newest, as say little that is new and have helped. Where one came at
// another time than it was taken for, each more would say more.
StreamTarget::Derivatives StreamTarget::derivatives_at(const Knot& newest, const Before& before,
                                                       double Knot::*value) noexcept {
  std::array<double, kNodes + 1> ages_s{};
  std::array<double, kNodes + 1> differences{};  // divided, from each node to the latest
  std::array<double, kNodes + 1> slopes{};       // divided, over the newest and all nodes up to this
  NodeWeights::Missed missed{};
  differences[0] = newest.*value;
  double product = 1.0;  // of the ages of the nodes between newest and latest
  const Knot* node = before.last;
  std::size_t nodes = 1;
  for (; nodes <= kNodes && node != nullptr; ++nodes) {
    ages_s[nodes] = seconds(newest.at - node->at);
    differences[nodes] = node->*value;
    for (std::size_t i = nodes; i-- > 0;)
      differences[i] = (differences[i + 1] - differences[i]) / (ages_s[i] - ages_s[nodes]);
    slopes[nodes] = differences[0];
    product *= ages_s[nodes];
    missed[nodes] = std::abs(differences[0]) * product;
    node = nodes == 1 ? before.first : sample_before(node->at, kApart_s);
  }
  if (slow()) nodes_.weigh(missed, nodes - 1);
  const double missed_else = nodes > 4 && nodes_.helps(3) ? missed[4] : missed[3];
  const bool positions = nodes > 3 && value == &Knot::position_rad;
  if (slow() && positions && fits_better(newest, before, missed_else) && !nodes_.helps(4))
    return {fit_.first(), fit_.second(), fit_.third()};
  // Of t, from 0 on: of the product of (t + age) over the nodes between newest and latest.
  std::array<double, 3> powers{1.0};
  Derivatives shown;
  for (std::size_t n = 1; n < std::min(nodes, kNodes); ++n) {
    if (n > 2 &&
        !(slow() && missed[n] <= kLittleNew * std::max(missed[n - 1], missed[n - 2]) && nodes_.helps(n)))
      break;
    shown.first += slopes[n] * powers[0];
    shown.second += 2.0 * slopes[n] * powers[1];
    shown.third += 6.0 * slopes[n] * powers[2];
    powers = {ages_s[n] * powers[0], powers[0] + ages_s[n] * powers[1], powers[1] + ages_s[n] * powers[2]};
  }
  return shown;
}

}  // namespace strainwave
