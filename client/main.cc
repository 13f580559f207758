// SPDX-License-Identifier: BSD-3-Clause
// strainwavectl: the command-line program for operators.
#include <unistd.h>

#include <iostream>

#include "client/options/command_line.h"
#include "client/protocol/interrupt.h"

int main(int argc, char** argv) {
  strainwave::catch_interrupts();
  const bool terminal = ::isatty(STDOUT_FILENO) == 1;
  return static_cast<int>(strainwave::run_command_line(argc, argv, std::cout, std::cerr, terminal));
}
