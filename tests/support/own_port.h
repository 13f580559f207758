// SPDX-License-Identifier: BSD-3-Clause
// A UDP port for each test process. With a shared port, tests that run in parallel would hear each other.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <string>

namespace strainwave::testing {

inline std::uint16_t own_port() {
  return static_cast<std::uint16_t>(20'000 + ::getpid() % 20'000);
}
inline std::string own_url() {
  return "udpm://239.255.76.67:" + std::to_string(own_port()) + "?ttl=0";
}

}  // namespace strainwave::testing
