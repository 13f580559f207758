// SPDX-License-Identifier: BSD-3-Clause
#include <strainwave/joint.h>

extern "C" double plugin_move(const char* name, double position_rad);

double plugin_move(const char* name, double position_rad) {
  return strainwave::Joint{name}.move(position_rad).error_rad;
}
