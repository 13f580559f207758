// SPDX-License-Identifier: BSD-3-Clause
// A user's program: it uses every header, links the whole library and checks the errors without a daemon. Exit status 0: success.
#include <strainwave/path.h>
#include <iostream>

int main() {
  try {
    strainwave::Joint joint{"el bow"};
    return 1;
  } catch (const strainwave::InvalidInput& error) {
    std::cout << error.what() << '\n';
  }
  try {
    strainwave::Joint joint{"elbow", {.key = "/nowhere/key"}};
    return 1;
  } catch (const strainwave::InvalidInput& error) {
    std::cout << error.what() << '\n';
  }
  try {
    strainwave::Joint joint{"elbow", {.lcm_url = "udpm://nowhere"}};
    joint.enable();
    auto stream = joint.stream();
    stream.put(0.0, 0.5, 0.0);
    return 1;
  } catch (const strainwave::NoAnswer& error) {
    std::cout << error.what() << '\n';
  }
  return to_text(strainwave::Mode::kHolding) == "holding" ? 0 : 1;
}
