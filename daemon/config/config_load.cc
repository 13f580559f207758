#include "daemon/config/config_load.h"

#include <algorithm>
#include <cmath>

namespace strainwave {

namespace {

// Of what gravity leaves. A joint whose acceleration takes all of its torque still carries something; one that hardly accelerates keeps a
// fifth, to slow down what pushes it.
constexpr double kLeastLoad = 0.5;
constexpr double kLargestLoad = 0.8;
// Of the torque limit: what a table's friction is off by is no load, even where the weight takes all of the torque.
constexpr double kLeastOfAll = 0.1;
// Above what the joint is told to carry or to press with.
constexpr double kRoom = 1.25;
// Of the largest load: what calls for a notice.
constexpr double kHighLoad = 0.8;

}  // namespace

double usual_load_limit_Nm(const JointConfig& joint) {
  const JointControllerConfig& controller = joint.loop.controller;
  const double left_Nm = controller.torque_limit_Nm - std::abs(controller.gravity.torque_Nm);
  const double acceleration_rad_s2 =
      std::max(controller.motion.acceleration_rad_s2, controller.motion.deceleration_rad_s2);
  const double spare_Nm = left_Nm - joint.plant.inertia_kgm2 * acceleration_rad_s2;
  const double told_Nm = std::max(std::abs(joint.loop.initial_load_Nm), joint.loop.homing.stop_torque_Nm);
  return std::max({std::clamp(spare_Nm, kLeastLoad * left_Nm, kLargestLoad * left_Nm),
                   kLeastOfAll * controller.torque_limit_Nm, kRoom * told_Nm});
}

void read_load_limits(TomlSection& limits, JointConfig& joint) {
  JointLimits& read = joint.loop.limits;
  read.load_Nm = limits.number_or("load_Nm", usual_load_limit_Nm(joint), kPositive);
  read.load_notice_Nm = limits.number_or("load_notice_Nm", kHighLoad * read.load_Nm, {1e-6, read.load_Nm});
}

}  // namespace strainwave
