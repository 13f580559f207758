// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/drive_check.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <sstream>

#include "base/input_error.h"

namespace strainwave {
namespace {

/// A bus whose start-up succeeded.
class QuietBus final : public Fieldbus {
 public:
  std::unique_ptr<Actuator> make_actuator(std::size_t /*slot*/) override { return nullptr; }
  std::vector<std::string> take_messages() override { return {"elbow: found"}; }
  void begin_cycle(std::int64_t /*now_ns*/) noexcept override {}
  void end_cycle() noexcept override {}
};

/// A name that only this run of the test has.
std::string resource() {
  return "test " + std::to_string(::getpid()) + " node 3";
}

DaemonConfig with_joint() {
  DaemonConfig config;
  config.joints.emplace_back();
  config.joints[0].driver_resource = resource();
  return config;
}

TEST(DriveCheck, TellsWhatStartUpFoundOnEveryBusAndWhatItWouldRefuse) {
  DaemonConfig config = with_joint();
  config.buses.push_back({"arm", {}, {}});
  const BusOpener open = [](const BusConfig& bus) -> std::unique_ptr<Fieldbus> {
    if (bus.name == "leg") throw InputError("knee: no answer");
    return std::make_unique<QuietBus>();
  };
  std::ostringstream good;
  EXPECT_TRUE(check_drives(config, good, open));
  EXPECT_NE(good.str().find("elbow: found"), std::string::npos);
  config.buses.insert(config.buses.begin(), {"leg", {}, {}});
  std::ostringstream bad;
  EXPECT_FALSE(check_drives(config, bad, open));
  EXPECT_NE(bad.str().find("leg: refused: knee: no answer"), std::string::npos) << bad.str();
  EXPECT_NE(bad.str().find("elbow: found"), std::string::npos) << "the other bus is checked all the same";
}

TEST(DriveCheck, TouchesNoDriveThatAnotherDaemonHas) {
  DaemonConfig config = with_joint();
  const InstanceLock other("drive " + resource(), "");
  bool made = false;
  config.buses.push_back({"arm", {}, {}});
  const BusOpener open = [&](const BusConfig& /*bus*/) {
    made = true;
    return std::make_unique<QuietBus>();
  };
  std::ostringstream out;
  EXPECT_THROW(check_drives(config, out, open), InputError);
  EXPECT_FALSE(made);
}

}  // namespace
}  // namespace strainwave
