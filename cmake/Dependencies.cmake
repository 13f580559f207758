# SPDX-License-Identifier: BSD-3-Clause
# Every library comes from Debian 12; scripts/deps installs what is missing.
find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(spdlog 1.10 REQUIRED)
find_package(fmt 9 REQUIRED)
find_package(CLI11 2.1 REQUIRED)
pkg_check_modules(TOMLPLUSPLUS REQUIRED IMPORTED_TARGET tomlplusplus)
pkg_check_modules(CLP REQUIRED IMPORTED_TARGET clp)
pkg_check_modules(LCM REQUIRED IMPORTED_TARGET lcm)
pkg_check_modules(GPIOD REQUIRED IMPORTED_TARGET libgpiod)
pkg_check_modules(SODIUM REQUIRED IMPORTED_TARGET libsodium)
pkg_check_modules(SECCOMP REQUIRED IMPORTED_TARGET libseccomp)
pkg_check_modules(SYSTEMD REQUIRED IMPORTED_TARGET libsystemd)
find_program(LCM_GEN lcm-gen REQUIRED)

# GCC 12 loses the object that LCM's C++ callbacks cast from void* when the vptr sanitizer checks them; and the check itself
# opens a pipe, which the confined gateway may not.
if(STRAINWAVE_SANITIZE MATCHES "undefined")
  set_property(TARGET PkgConfig::LCM APPEND PROPERTY INTERFACE_COMPILE_OPTIONS "SHELL:-fno-sanitize=vptr")
endif()
