#include "daemon/admission/fair_share.h"

#include <algorithm>
#include <cmath>

namespace strainwave {

double FairShare::Taker::taken_by(std::int64_t now_ns) const noexcept {
  return taken == 0.0 ? 0.0 : taken * std::exp(-1e-9 * static_cast<double>(now_ns - at_ns));
}

bool FairShare::is_proven(std::uint64_t source) const noexcept {
  return std::any_of(proven_.begin(), proven_.end(),
                     [&](const Proof& proof) { return proof.at_ns >= 0 && proof.source == source; });
}

bool FairShare::available(std::uint64_t source, std::int64_t now_ns) noexcept {
  const double left = bucket_.left(now_ns);
  if (left < 1.0) return false;
  const double burst = bucket_.burst();
  double for_others = is_proven(source) ? 0.0 : burst / 8.0;
  for (const Taker& taker : takers_)
    if (taker.taken > 0.0 && taker.source == source)
      for_others += std::min(taker.taken_by(now_ns), burst / 2.0);
  return left > for_others;
}

void FairShare::take(std::uint64_t source, std::int64_t now_ns) noexcept {
  bucket_.take();
  Taker* least = nullptr;
  double least_taken = 0.0;
  for (Taker& taker : takers_) {
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
