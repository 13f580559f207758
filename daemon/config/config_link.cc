#include "daemon/config/config_link.h"

#include <cmath>
#include <string>

#include "base/printable.h"
#include "control/gear_catalogue.h"
#include "control/units.h"

namespace strainwave {

namespace {

// A link this light beside the motor follows it: a rigid joint.
constexpr double kLeastShare = 1e-3;
// Of critical damping: so far the planned motion allows for it (tests/control/link_motion_test.cc); gears have a tenth of it.
constexpr double kMostDamping = 0.5;

const Gear& named_gear(TomlSection& section, const PlantIdentity& plant) {
  const Gear* gear = find_gear(section.text("gear"));
  if (gear == nullptr) section.fail("gear", "a gear of the catalogue is allowed: " + gear_names());
  if (std::abs(gear->ratio - plant.gear_ratio) > 1e-6 * gear->ratio)
    section.fail("gear", "a gear of joint.gear_ratio = " + number_text(plant.gear_ratio) + " is allowed");
  return *gear;
}

// m g l sin(position - zero).
void read_gravity(TomlSection& section, JointControllerConfig& controller) {
  if (!section.has("gravity_Nm")) {
    if (section.has("gravity_zero_rad"))
      section.fail("gravity_zero_rad", "it is allowed only with gravity_Nm");
    return;
  }
  if (controller.use_observer)
    section.fail("gravity_Nm", "it is allowed only without the observer, which finds the load by itself");
  controller.gravity.torque_Nm = section.number("gravity_Nm", {0.0, controller.torque_limit_Nm});
  controller.gravity.zero_rad = section.number("gravity_zero_rad", {-kTurn_rad, kTurn_rad});
}

}  // namespace

void read_link(TomlSection& section, PlantIdentity& plant, JointControllerConfig& controller) {
  read_gravity(section, controller);
  if (!section.has("gear")) {
    for (const char* key : {"load_inertia_kgm2", "damping_Nms_rad"})
      if (section.has(key)) section.fail(key, "it is allowed only with a gear");
    return;
  }
  if (controller.rigid) section.fail("gear", "it is allowed only without rigid = true: a gear is a spring");
  if (!controller.use_shaping) section.fail("gear", "it is allowed only with shaping = true");
  LinkModel link;
  const Gear& gear = named_gear(section, plant);
  plant.gear = FixedString<32>(gear.name);
  link.spring = gear.spring;
  const double total_kgm2 = plant.inertia_kgm2;
  link.link_inertia_kgm2 =
      section.number("load_inertia_kgm2", {kLeastShare * total_kgm2, (1.0 - kLeastShare) * total_kgm2});
  link.motor_inertia_kgm2 = total_kgm2 - link.link_inertia_kgm2;
  link.damping_Nms_rad =
      section.number_or("damping_Nms_rad", 0.0,
                        {0.0, structural_damping_Nms_rad(link.motor_inertia_kgm2, link.link_inertia_kgm2,
                                                         link.spring.stiffness_1_Nm_rad, kMostDamping)});
  controller.link = link;
}

}  // namespace strainwave
