// SPDX-License-Identifier: BSD-3-Clause
// A C++ program that uses only the message types of Strainwave. It reads an encoded state from its standard input.
#include <iostream>
#include <iterator>
#include <strainwave/state_v1.hpp>
#include <vector>

int main() {
  const std::vector<char> bytes{std::istreambuf_iterator<char>(std::cin), {}};
  strainwave::state_v1 state{};
  if (state.decode(bytes.data(), 0, static_cast<int>(bytes.size())) != static_cast<int>(bytes.size()))
    return 1;
  std::cout << "mode " << state.mode << ", setpoint " << state.setpoint_position_rad << " rad\n";
  return state.mode == 3 && state.setpoint_position_rad == 0.25 ? 0 : 1;
}
