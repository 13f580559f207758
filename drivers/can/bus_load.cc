// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/can/bus_load.h"

#include <cmath>
#include <cstdio>

#include "base/input_error.h"

namespace strainwave {

namespace {

constexpr double kPerCent = 100.0;

std::string number_text(double value, int decimals) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

}  // namespace

double bus_load(const std::vector<FrameTraffic>& traffic, double bit_rate) {
  double bits_per_s = 0.0;
  for (const FrameTraffic& frame : traffic) bits_per_s += worst_case_frame_bits(frame.bytes) * frame.rate_Hz;
  return bits_per_s / bit_rate;
}

std::string bus_load_text(const std::string& bus, const std::vector<FrameTraffic>& traffic, double bit_rate) {
  std::string text = bus + ": " + number_text(kPerCent * bus_load(traffic, bit_rate), 1) + " % of " +
                     number_text(bit_rate, 0) + " bit/s in use at worst:";
  for (const FrameTraffic& frame : traffic)
    text += " " + frame.what + " " + number_text(kPerCent * bus_load({frame}, bit_rate), 1) + ",";
  text.pop_back();
  return text;
}

void require_bus_load(const std::string& bus, const std::vector<FrameTraffic>& traffic, double bit_rate,
                      double limit) {
  if (bus_load(traffic, bit_rate) <= limit) return;
  throw InputError(bus_load_text(bus, traffic, bit_rate) +
                   "; more than load_limit = " + number_text(limit, 2) +
                   " allows: put joints on another bus, raise bit_rate or period_s, or lengthen the slow "
                   "messages' periods");
}

}  // namespace strainwave
