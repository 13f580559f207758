// SPDX-License-Identifier: BSD-3-Clause
// A C program that uses only the message types of Strainwave. It writes an encoded setpoint to its standard output.
#include <stdio.h>
#include <strainwave/strainwave_setpoint_v1.h>

int main(void) {
  strainwave_setpoint_v1 setpoint = {0};
  setpoint.sequence = 7;
  setpoint.position_rad = 0.25;
  unsigned char bytes[1024];
  const int size = strainwave_setpoint_v1_encode(bytes, 0, sizeof bytes, &setpoint);
  return size > 0 && fwrite(bytes, 1, (size_t)size, stdout) == (size_t)size ? 0 : 1;
}
