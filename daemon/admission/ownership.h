// SPDX-License-Identifier: BSD-3-Clause
// Ownership of joints. The sender of the first accepted order owns the joint until it is silent for a lease, releases the joint, or
// an engineer takes it over. An order on its way to the loop reserves a free joint, so that one of two simultaneous senders is
// refused. Time is an argument. Not real-time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/durations.h"

namespace strainwave {

class Ownership {
 public:
  /// A program that gives orders.
  struct Holder {
    std::int64_t key = -1;  ///< index of its key; -1: it does not sign
    std::int64_t sender_id = 0;
    bool operator==(const Holder&) const = default;
  };
  static constexpr std::int64_t kReservation_ns = 500'000'000;

  Ownership(std::size_t joints, double lease_s) : lease_ns_(nanoseconds(lease_s)), leases_(joints) {}

  /// Whether `holder` may order `joint`: it is free or its own. Reserves a free joint, and renews the lease of an owner.
  bool reserve(std::size_t joint, const Holder& holder, std::int64_t now_ns) {
    Lease& lease = leases_[joint];
    if (now_ns < lease.until_ns && !(lease.holder == holder)) return false;
    if (now_ns >= lease.until_ns) lease = {holder, now_ns + kReservation_ns, false};
    if (lease.confirmed) lease.until_ns = now_ns + lease_ns_;
    return true;
  }

  /// Reports the outcome of an order that reserve() let through.
  void settle(std::size_t joint, const Holder& holder, bool accepted, std::int64_t now_ns) {
    Lease& lease = leases_[joint];
    if (!(lease.holder == holder) || now_ns >= lease.until_ns) return;
    if (accepted)
      lease = {holder, now_ns + lease_ns_, true};
    else if (!lease.confirmed)
      lease.until_ns = 0;
  }

  void take(std::size_t joint, const Holder& holder, std::int64_t now_ns) {
    leases_[joint] = {holder, now_ns + lease_ns_, true};
  }
  /// False if `holder` does not have the joint.
  bool release(std::size_t joint, const Holder& holder, std::int64_t now_ns) {
    Lease& lease = leases_[joint];
    if (now_ns >= lease.until_ns || !(lease.holder == holder)) return false;
    lease.until_ns = 0;
    return true;
  }

  /// sender_id of the owner, 0: none.
  std::int64_t owner_id(std::size_t joint, std::int64_t now_ns) const {
    const Lease& lease = leases_[joint];
    return lease.confirmed && now_ns < lease.until_ns ? lease.holder.sender_id : 0;
  }
  /// Remaining time of the lease, s; 0 without an owner.
  double lease_s(std::size_t joint, std::int64_t now_ns) const {
    return owner_id(joint, now_ns) == 0 ? 0.0 : seconds(leases_[joint].until_ns - now_ns);
  }
  /// The holder of `joint`, which must be reserved or owned.
  const Holder& holder(std::size_t joint) const { return leases_[joint].holder; }

 private:
  struct Lease {
    Holder holder;
    std::int64_t until_ns = 0;
    bool confirmed = false;  ///< an order of the holder was accepted
  };
  std::int64_t lease_ns_;
  std::vector<Lease> leases_;
};

}  // namespace strainwave
