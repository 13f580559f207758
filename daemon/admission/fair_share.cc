// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/admission/fair_share.h"

#include <algorithm>
#include <cmath>

#include "base/durations.h"

namespace strainwave {

namespace {

constexpr int kPortBits = 16;
constexpr double kMemory_s = 4.0;

// The finalizer of splitmix64: every bit of the result depends on all of `number`.
std::uint64_t mixed(std::uint64_t number) noexcept {
  number = (number ^ (number >> 30U)) * 0xbf58476d1ce4e5b9U;
  number = (number ^ (number >> 27U)) * 0x94d049bb133111ebU;
  return number ^ (number >> 31U);
}

}  // namespace

double FairShare::Taker::taken_by(std::int64_t now_ns) const noexcept {
  return taken == 0.0 ? 0.0 : taken * std::exp(-seconds(now_ns - at_ns) / kMemory_s);
}

std::span<FairShare::Taker> FairShare::row_of(std::uint64_t source) noexcept {
  const std::size_t row = mixed(mixed(source) + salt_) % kRows;
  return std::span(takers_).subspan(row * kTakersInRow, kTakersInRow);
}

double FairShare::kept_for_proven(std::uint64_t source) const noexcept {
  double kept = bucket_.burst() / 8.0;
  for (const Proof& proof : proven_) {
    if (proof.at_ns < 0) continue;
    if (proof.source == source) return 0.0;
    if (proof.source >> kPortBits == source >> kPortBits) kept = bucket_.burst() / 16.0;
  }
  return kept;
}

bool FairShare::available(std::uint64_t source, std::int64_t now_ns) noexcept {
  const double left = bucket_.left(now_ns);
  if (left < 1.0) return false;
  const double burst = bucket_.burst();
  double for_others = kept_for_proven(source);
  for (const Taker& taker : row_of(source)) {
    if (taker.taken == 0.0 || taker.source != source) continue;
    const double taken = taker.taken_by(now_ns);
    for_others += burst / 2.0 * taken / (taken + burst / 8.0);
  }
  return left > for_others;
}

void FairShare::take(std::uint64_t source, std::int64_t now_ns) noexcept {
  bucket_.take();
  Taker* least = nullptr;
  double least_taken = 0.0;
  for (Taker& taker : row_of(source)) {
    const double taken = taker.taken_by(now_ns);
    if (taken > 0.0 && taker.source == source) {
      taker = {source, taken + 1.0, now_ns};
      return;
    }
    if (least != nullptr && taken >= least_taken) continue;
    least = &taker;
    least_taken = taken;
  }
  *least = {source, 1.0, now_ns};
}

void FairShare::prove(std::uint64_t source, std::int64_t now_ns) noexcept {
  Proof* place = proven_.data();
  for (Proof& proof : proven_) {
    if (proof.at_ns >= 0 && proof.source == source) {
      proof.at_ns = now_ns;
      return;
    }
    if (proof.at_ns < place->at_ns) place = &proof;
  }
  *place = {source, now_ns};
}

}  // namespace strainwave
