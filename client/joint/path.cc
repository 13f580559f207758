// SPDX-License-Identifier: BSD-3-Clause
#include "strainwave/path.h"

#include <fmt/format.h>

#include <cmath>

#include "client/joint/joint_link.h"
#include "client/protocol/joint_path.h"
#include "client/protocol/motion.h"
#include "client/protocol/orders.h"

namespace strainwave {

Path::Path(const std::vector<PathPart>& parts) {
  for (const auto& [joint, knots] : parts) {
    links_.push_back(joint.link_);
    parts_.push_back({joint.name(), knots});
    require_same_daemon(*joint.link_, first(), "the joints of a path");
  }
  check_path(parts_);
}
Path::~Path() = default;
Path::Path(Path&&) noexcept = default;
Path& Path::operator=(Path&&) noexcept = default;

void Path::start() {
  const auto held = first().lock();
  first().view();
  load_path(first().client(), parts_);
  start_path(first().client(), parts_);
  started_ = true;
}

void Path::pause() {
  const auto held = first().lock();
  order_accepted(first().client(), first().name(), Action::kPause);
}

void Path::resume() {
  const auto held = first().lock();
  order_accepted(first().client(), first().name(), Action::kResume);
}

void Path::hold() {
  const auto held = first().lock();
  for (const JointPath& part : parts_) send_stop(first().client(), part.joint, Action::kHold);
  for (const JointPath& part : parts_) wait_until_holding(first().client(), part.joint);
}

std::vector<Arrival> Path::wait(double tolerance_rad, double timeout_s) {
  checked_number(first().name(), "tolerance_rad", tolerance_rad, "a number above 0", tolerance_rad > 0.0);
  if (!(timeout_s > 0.0)) checked_number(first().name(), "timeout_s", timeout_s, "a number above 0", false);
  const auto held = first().lock();
  first().view();
  for (const JointPath& part : parts_) first().client().wait_for_joint(part.joint);
  if (!started_) check_under_way();
  return wait_for_path(first().client(), parts_, {.tolerance_rad = tolerance_rad, .timeout_s = timeout_s});
}

const JointPath* Path::joint_elsewhere() {
  bool moving = false;
  for (const JointPath& part : parts_) {
    const JointView& view = *first().client().find(part.joint);
    if (view.state.target_position_rad != part.knots.back().position_rad) return &part;
    moving = moving || mode_of(view) == Mode::kTracking || !std::isnan(view.state.path_time_s);
  }
  return moving ? nullptr : &parts_.front();
}

void Path::check_under_way() {
  Client& client = first().client();
  if (client.wait_until([&] { return joint_elsewhere() == nullptr; }, Deadline(kOldStates_s))) return;
  const JointPath& part = *joint_elsewhere();
  throw NotDone(fmt::format("{}: is not on its way to {} rad: this path is not under way; start() begins it",
                            part.joint, part.knots.back().position_rad),
                part.joint);
}

}  // namespace strainwave
