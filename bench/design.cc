// SPDX-License-Identifier: BSD-3-Clause
// Times the design and the certification of the four controllers. Prints a table.
#include <chrono>
#include <cstdio>

#include "design/friction/friction_file.h"
#include "design/gains/controller_design.h"

int main() {
  using namespace strainwave;
  using Clock = std::chrono::steady_clock;
  TableRequest request;
  DesignRequest& design = request.design;
  design.plant.joint_model = std::string_view("rhs17-6006");
  design.plant.inertia_kgm2 = 0.089;
  design.plant.gear_ratio = 50.0;
  design.plant.period_s = 1e-3;
  design.friction =
      read_friction_rules(STRAINWAVE_SOURCE_DIR "/data/fuzzy_rules_table5.csv", 50.0, GearSide::kJoint)
          .friction;
  design.weights = {0.1, 1.0, 1e-4, 1e-6};
  design.initial_states = {StateVector(0.0, 1.0, 0.0)};
  double total_ms = 0.0;
  std::printf("| controller | design ms | certificate us | smallest margin |\n|---|---|---|---|\n");
  for (const Controller controller : {Controller::kC1, Controller::kC2, Controller::kC3, Controller::kC4}) {
    const auto start = Clock::now();
    const DesignedGains designed = design_gains(controller, design);
    const auto designed_at = Clock::now();
    const CertificateReport report = certify(designed.gains, design.plant, design.friction);
    const auto end = Clock::now();
    const double design_ms = std::chrono::duration<double, std::milli>(designed_at - start).count();
    total_ms += std::chrono::duration<double, std::milli>(end - start).count();
    std::printf("| %s | %.1f | %.1f | %.3g |\n", name_of(controller), design_ms,
                std::chrono::duration<double, std::micro>(end - designed_at).count(), report.worst.margin);
  }
  std::printf("all four: %.0f ms\n", total_ms);
  return 0;
}
