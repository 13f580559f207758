// SPDX-License-Identifier: BSD-3-Clause
#include "sim/joint/plant_file.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/input_error.h"
#include "base/printable.h"
#include "sim/joint/reference_plant.h"
#include "tests/support/refusal.h"

namespace strainwave {
namespace {

std::string refusal(const std::string& text) {
  return testing::refusal_of([&] { plant_from_toml(text, "joint.toml"); });
}

TEST(PlantFile, TakesWhatItDoesNotSayFromItsBase) {
  const JointPlantConfig plant = plant_from_toml(R"(
base = "limited"
[joint]
inertia_kgm2 = 0.12
[friction]
asymptote_coulomb_Nm = 1
[simulation]
substeps = 20
[drive]
delay_periods = 2.5
)",
                                                 "joint.toml");
  EXPECT_EQ(plant.joint.inertia_kgm2, 0.12);
  EXPECT_EQ(plant.joint.friction.asymptote.coulomb_Nm, 1.0) << "a whole number is a number";
  EXPECT_EQ(plant.joint.friction.decay_C, reference_joint().friction.decay_C);
  EXPECT_EQ(plant.motor.peak_torque_Nm, kReferencePeakTorque_Nm);
  EXPECT_EQ(plant.encoder.counts_per_joint_revolution, 0.0);
  EXPECT_EQ(plant.substeps, 20);
  EXPECT_EQ(plant.delay.periods, 2.5);
}

TEST(PlantFile, KeepsTheSlopesOfItsBaseUnlessItSaysTheFirst) {
  const TorsionSpring of_base = flexible_plant().effects.transmission->spring;
  ASSERT_GT(of_base.stiffness_3_Nm_rad, of_base.stiffness_1_Nm_rad) << "else nothing is tested";
  for (const char* text : {"base = \"flexible\"\n", "base = \"flexible\"\n[spring]\ndamping_Nms_rad = 0.5\n",
                           "base = \"flexible\"\n[link]\ninertia_kgm2 = 0.1\n"}) {
    const TorsionSpring spring = plant_from_toml(text, "joint.toml").effects.transmission->spring;
    EXPECT_EQ(spring.stiffness_1_Nm_rad, of_base.stiffness_1_Nm_rad) << text;
    EXPECT_EQ(spring.stiffness_2_Nm_rad, of_base.stiffness_2_Nm_rad) << text;
    EXPECT_EQ(spring.stiffness_3_Nm_rad, of_base.stiffness_3_Nm_rad) << text;
  }
  const TorsionSpring linear =
      plant_from_toml("base = \"flexible\"\n[spring]\nstiffness_1_Nm_rad = 5000\n", "joint.toml")
          .effects.transmission->spring;
  EXPECT_EQ(linear.stiffness_3_Nm_rad, 5000.0);
}

TEST(PlantFile, IsTheRealisticJointWhenEmpty) {
  const JointPlantConfig plant = plant_from_toml("", "joint.toml");
  EXPECT_EQ(plant.encoder.counts_per_joint_revolution, kReferenceCountsPerRevolution);
  EXPECT_EQ(plant.delay.periods, 1.0);
}

TEST(PlantFile, NamesLineKeyAndWhatIsAllowed) {
  const auto names = [](const std::string& text, std::initializer_list<const char*> parts) {
    const std::string message = refusal(text);
    for (const char* part : parts) EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  names("base = \"perfect\"", {"joint.toml:1: base = ", "perfect", "ideal", "flexible"});
  names("[joint]\nmass_kg = 3", {"joint.toml:2", "joint.mass_kg"});
  names("[gearbox]\nratio = 50", {"gearbox"});
  names("[joint]\ninertia_kgm2 = \"heavy\"", {"joint.toml:2", "joint.inertia_kgm2", "heavy", "a number"});
  names("[joint]\ninertia_kgm2 = -1", {"joint.inertia_kgm2 = -1"});
  names("gear = \"csf-17-77\"\n[link]\ninertia_kgm2 = 0.1",
        {"joint.toml:1", "gear", "csf-17-77", "csf-17-50"});
  names("gear = \"csf-17-50\"", {"gear", "link.inertia_kgm2"});
  names("[link]\ninertia_kgm2 = 0.1", {"link", "a gear, or a spring"});
  names("[link]\ninertia_kgm2 = 0.1\n[spring]\nstiffness_1_Nm_rad = -8000",
        {"joint.toml:4", "spring.stiffness_1_Nm_rad = -8000"});
  names("[link_encoder]\nfeedback = true", {"link_encoder.counts_per_joint_revolution"});
  names("base = \"flexible\"\n[spring]\nstiffness_3_Nm_rad = 1e8", {"substeps = 10", "at least 48"});
  names("base = \"flexible\"\n[contact]\nposition_rad = -1\nstiffness_Nm_rad = 100",
        {"joint.toml:3", "contact.position_rad = -1", "from 0 to"});
  names("[simulation]\ninitial_position_rad = 2\n[contact]\nposition_rad = 1.5\nstiffness_Nm_rad = 100",
        {"contact.position_rad = 1.5", "from 2 to"});
  names("base = \"flexible\"\n[kinematic_error]\nonce_rad = 0.0201", {"once_rad = 0.0201"});
  names("base = \"flexible\"\n[kinematic_error]\ntwice_rad = 0.01",
        {"twice_rad = 0.01", "turn back", "by less than 1"});
  EXPECT_EQ(refusal("base = \"flexible\"\n[kinematic_error]\ntwice_rad = 0.0099"), "accepted");
  EXPECT_EQ(refusal("base = \"flexible\"\n[kinematic_error]\nonce_rad = 0.0099\ntwice_rad = 0.0066"),
            "accepted")
      << "the steepest of one is not that of the other";
  names("[friction]\nasymptote_viscous_Nms_rad = 2500", {"substeps = 10", "at least 15", "viscous"});
  EXPECT_NE(refusal("[simulation]\nsubsteps = 2.5").find("substeps"), std::string::npos);
  EXPECT_NE(refusal("[joint\n").find("joint.toml:1:"), std::string::npos);
}

TEST(PlantFile, RefusesFrictionThatIsLessAtRestThanInMotion) {
  EXPECT_NE(refusal("[friction]\nasymptote_static_Nm = 0.5").find("asymptote_static_Nm = 0.5"),
            std::string::npos);
  const std::string cold = refusal("[friction]\namplitude_static_Nm = 0.1");
  EXPECT_NE(cold.find("amplitude_static_Nm = 0.1"), std::string::npos) << cold;
  EXPECT_NE(cold.find("-40 degC"), std::string::npos) << cold;
}

TEST(PlantFile, RefusesCreepThatIsTooShortForItsSubstepsAndWhatItAllowsStaysFinite) {
  const std::string shortest = "base = \"flexible\"\n[sliding]\npresliding_rad = ";
  const std::string message = refusal(shortest + "1e-9");
  EXPECT_NE(message.find("presliding_rad = 1e-09"), std::string::npos) << message;
  const std::string before = "at least ";
  ASSERT_NE(message.find(before), std::string::npos) << message;
  const double least_rad = std::stod(message.substr(message.find(before) + before.size()));
  EXPECT_NE(refusal(shortest + number_text(0.99 * least_rad)), "accepted");
  for (const double temperature_C : {-40.0, 20.0}) {
    JointPlant plant(plant_from_toml(shortest + number_text(1.01 * least_rad), "joint.toml"));
    plant.set_ambient_temperature(temperature_C);
    for (int k = 0; k < 2000; ++k) plant.step(k < 1000 ? 30.0 : -30.0);
    EXPECT_LT(std::abs(plant.state().position_rad), 10.0) << temperature_C;
    EXPECT_LT(std::abs(plant.state().velocity_rad_s), 10.0) << temperature_C;
  }
  EXPECT_NE(
      refusal("base = \"ideal\"\n[sliding]\npresliding_rad = 1e-4\n[friction]\nasymptote_static_Nm = 0\n"
              "asymptote_coulomb_Nm = 0")
          .find("asymptote_static_Nm = 0"),
      std::string::npos);
}

TEST(PlantFile, KnowsTheBuiltInPlantsByName) {
  EXPECT_EQ(plant_named("realistic").delay.periods, 1.0);
  EXPECT_THROW(plant_named("/nonexistent/plant.toml"), InputError);
}

}  // namespace
}  // namespace strainwave
