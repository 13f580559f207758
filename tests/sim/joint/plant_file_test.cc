#include "sim/joint/plant_file.h"

#include <gtest/gtest.h>

#include "base/input_error.h"
#include "sim/joint/reference_plant.h"

namespace strainwave {
namespace {

std::string refusal(const std::string& text) {
  try {
    plant_from_toml(text, "joint.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
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
delay_samples = 2
)",
                                                 "joint.toml");
  EXPECT_EQ(plant.joint.inertia_kgm2, 0.12);
  EXPECT_EQ(plant.joint.friction.asymptote.coulomb_Nm, 1.0) << "a whole number is a number";
  EXPECT_EQ(plant.joint.friction.decay_C, reference_joint().friction.decay_C);
  EXPECT_EQ(plant.motor.peak_torque_Nm, kReferencePeakTorque_Nm);
  EXPECT_EQ(plant.encoder.counts_per_joint_revolution, 0.0);
  EXPECT_EQ(plant.substeps, 20);
  EXPECT_EQ(plant.delay_samples, 2);
}

TEST(PlantFile, IsTheRealisticJointWhenEmpty) {
  const JointPlantConfig plant = plant_from_toml("", "joint.toml");
  EXPECT_EQ(plant.encoder.counts_per_joint_revolution, kReferenceCountsPerRevolution);
  EXPECT_EQ(plant.delay_samples, 1);
}

TEST(PlantFile, NamesLineKeyAndWhatIsAllowed) {
  EXPECT_NE(refusal("base = \"perfect\"").find("joint.toml:1: base = \"perfect\": allowed are \"ideal\""),
            std::string::npos);
  EXPECT_NE(refusal("[joint]\nmass_kg = 3").find("joint.toml:2: joint.mass_kg = 3: unknown key"),
            std::string::npos);
  EXPECT_NE(refusal("[gear]\nratio = 50").find("gear = (a table): unknown key"), std::string::npos);
  EXPECT_NE(refusal("[joint]\ninertia_kgm2 = \"heavy\"").find("joint.toml:2: joint.inertia_kgm2 = \"heavy\": a number from"),
            std::string::npos);
  EXPECT_NE(refusal("[joint]\ninertia_kgm2 = -1").find("inertia_kgm2 = -1"), std::string::npos);
  EXPECT_NE(refusal("[simulation]\nsubsteps = 2.5").find("substeps"), std::string::npos);
  EXPECT_NE(refusal("[joint\n").find("joint.toml:1:"), std::string::npos);
}

TEST(PlantFile, KnowsTheBuiltInPlantsByName) {
  EXPECT_EQ(plant_named("realistic").delay_samples, 1);
  EXPECT_THROW(plant_named("/nonexistent/plant.toml"), InputError);
}

}  // namespace
}  // namespace strainwave
