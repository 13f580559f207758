// SPDX-License-Identifier: BSD-3-Clause
#include "design/friction/identification_record.h"

#include <nlohmann/json.hpp>

namespace strainwave {

using nlohmann::ordered_json;

namespace {

constexpr std::size_t kMaxTemperatures = 1000;

ordered_json to_json(const FrictionRegression& fit) {
  return {{"temperature_C", fit.temperature_C},
          {"points", fit.points},
          {"static_Nm", fit.static_Nm.value},
          {"static_half_width_Nm", fit.static_Nm.half_width},
          {"coulomb_Nm", fit.coulomb_Nm.value},
          {"coulomb_half_width_Nm", fit.coulomb_Nm.half_width},
          {"viscous_Nms_rad", fit.viscous_Nms_rad.value},
          {"viscous_half_width_Nms_rad", fit.viscous_Nms_rad.half_width},
          {"residual_squares", fit.residual_squares},
          {"degrees_of_freedom", fit.degrees_of_freedom}};
}

FrictionRegression regression_from_json(StrictObject& object) {
  FrictionRegression fit;
  fit.temperature_C = object.number("temperature_C");
  fit.points = static_cast<int>(object.integer("points"));
  fit.static_Nm = {object.number("static_Nm"), object.number("static_half_width_Nm")};
  fit.coulomb_Nm = {object.number("coulomb_Nm"), object.number("coulomb_half_width_Nm")};
  fit.viscous_Nms_rad = {object.number("viscous_Nms_rad"), object.number("viscous_half_width_Nms_rad")};
  fit.residual_squares = object.number("residual_squares");
  fit.degrees_of_freedom = static_cast<int>(object.integer("degrees_of_freedom"));
  object.finish();
  return fit;
}

}  // namespace

ordered_json to_json(const IdentificationRecord& record) {
  ordered_json measured = ordered_json::array();
  for (const FrictionRegression& fit : record.measured) measured.push_back(to_json(fit));
  return {{"prior_file", record.prior_file},
          {"prior_sha256", record.prior_sha256},
          {"prior_common_deviation", record.weights.common},
          {"prior_own_deviation", record.weights.own},
          {"torque_uncertainty", record.weights.torque_uncertainty},
          {"noise_Nm", record.noise_Nm},
          {"confidence", record.confidence},
          {"measured", std::move(measured)}};
}

IdentificationRecord identification_from_json(StrictObject object) {
  IdentificationRecord record;
  record.prior_file = object.text("prior_file", kMaxTextBytes);
  record.prior_sha256 = object.text("prior_sha256", kMaxTextBytes);
  record.weights = {object.number("prior_common_deviation"), object.number("prior_own_deviation"),
                    object.number("torque_uncertainty")};
  record.noise_Nm = object.number("noise_Nm");
  record.confidence = object.number("confidence");
  for (StrictObject& fit : object.objects("measured", 0, kMaxTemperatures))
    record.measured.push_back(regression_from_json(fit));
  object.finish();
  return record;
}

}  // namespace strainwave
