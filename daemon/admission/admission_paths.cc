// SPDX-License-Identifier: BSD-3-Clause
// Part of admission.h: judges each joint's path as a whole, before any of it reaches the loop.
#include <algorithm>
#include <cmath>
#include <span>
#include <sstream>
#include <strainwave/path_v1.hpp>

#include "control/trajectory/knot_path.h"
#include "daemon/admission/admission.h"
#include "daemon/admission/verdict.h"
#include "lcmtypes/wire.h"

namespace strainwave {

namespace {

static_assert(std::size(path_v1{}.time_s) == KnotPath::kMostKnots);

// Knots beyond knot_count are ignored. find_defect() refuses a count that is out of range or negative.
KnotPath knots_of(const path_v1& message) {
  KnotPath path;
  path.count = static_cast<std::size_t>(message.knot_count);
  for (std::size_t i = 0; i < std::min(path.count, KnotPath::kMostKnots); ++i)
    path.knots[i] = {message.time_s[i], message.position_rad[i], message.velocity_rad_s[i]};
  return path;
}

bool is_finite(const KnotPath& path) {
  return std::ranges::all_of(std::span(path.knots).first(std::min(path.count, KnotPath::kMostKnots)),
                             [](const PathKnot& knot) {
                               return std::isfinite(knot.time_s) && std::isfinite(knot.position_rad) &&
                                      std::isfinite(knot.velocity_rad_s);
                             });
}

}  // namespace

Verdict Admission::judge_path(std::size_t joint, const WireMessage& message) {
  const auto path = decode_exactly<path_v1>(payload(message));
  if (!path) return discard(Reason::kMalformed);
  Requester requester{joint, path->sender_id, path->sequence};
  if (auto verdict =
          check_envelope(message, {path->session_id, path->challenge, Role::kOperator, true}, requester))
    return std::move(*verdict);
  std::ostringstream text;
  if (path->path_id == 0)
    return refuse(requester, Reason::kOutOfRange, "path_id = 0: any other number is allowed");
  if (path->joint_count < 1 || static_cast<std::size_t>(path->joint_count) > joints_.size()) {
    text << "joint_count = " << path->joint_count << ": from 1 to " << joints_.size()
         << " (the joints of this daemon) is allowed";
    return refuse(requester, Reason::kOutOfRange, text.str());
  }
  auto loaded = std::make_unique<LoadedPath>();
  loaded->id = path->path_id;
  loaded->joint_count = path->joint_count;
  loaded->path = knots_of(*path);
  const JointAdmission& limits = joints_[joint];
  if (const auto defect = find_defect(loaded->path, limits.path)) {
    return refuse(requester, is_finite(loaded->path) ? Reason::kOutOfRange : Reason::kNotFinite,
                  limits.name + ", " + *defect);
  }
  Verdict verdict = pass(requester, OrderKind::kLoadPath, path->challenge);
  text << loaded->path.count << " knots in " << loaded->path.duration_s() << " s";
  verdict.text = text.str();
  verdict.path = std::move(loaded);
  path_ids_[joint] = path->path_id;
  return verdict;
}

std::optional<Verdict> Admission::check_path_owner(const Requester& requester) {
  const std::int64_t id = path_ids_[requester.joint];
  for (std::size_t other = 0; id != 0 && other < joints_.size(); ++other) {
    if (other == requester.joint || path_ids_[other] != id) continue;
    Requester of_other = requester;
    of_other.joint = other;
    auto verdict = check_owner(of_other);
    if (!verdict) continue;
    verdict->requester = requester;
    return verdict;
  }
  return std::nullopt;
}

}  // namespace strainwave
