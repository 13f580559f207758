# SPDX-License-Identifier: BSD-3-Clause
# Debian packages of the install components; scripts/package makes them.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME strainwave)
set(CPACK_PACKAGE_VENDOR "Strainwave developers")
set(CPACK_PACKAGE_CONTACT "Strainwave developers <strainwave@example.org>")
set(CPACK_PACKAGE_DIRECTORY "${PROJECT_SOURCE_DIR}/build/packages")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL daemon lcmtypes client python)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
# Of the packaging, while the version stays.
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_DAEMON_PACKAGE_NAME strainwave)
set(CPACK_DEBIAN_DAEMON_PACKAGE_SECTION electronics)
set(CPACK_COMPONENT_DAEMON_DESCRIPTION "Real-time control of strain-wave joints
 Controls joints with strain-wave (harmonic drive) gears, whose friction
 changes with temperature: a daemon with its network gateway, a client for
 the operator, and the units of the service. Nothing is started by the
 installation.")
# The libraries that the programs link are found by dpkg-shlibdeps.
set(CPACK_DEBIAN_DAEMON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_DAEMON_DEBUGINFO_PACKAGE ON)
set(CPACK_DEBIAN_DAEMON_PACKAGE_DEPENDS "systemd (>= 252), udev, iproute2")
# strainwavectl plot-record draws with it.
set(CPACK_DEBIAN_DAEMON_PACKAGE_SUGGESTS "gnuplot-nox | gnuplot, strainwave-design, strainwave-spy")
set(CPACK_DEBIAN_DAEMON_PACKAGE_CONTROL_EXTRA
  "${PROJECT_SOURCE_DIR}/packaging/strainwave/postinst;${PROJECT_SOURCE_DIR}/packaging/strainwave/prerm;${PROJECT_SOURCE_DIR}/packaging/strainwave/postrm;${PROJECT_SOURCE_DIR}/packaging/strainwave/conffiles")

if(STRAINWAVE_BUILD_DESIGN)
  list(APPEND CPACK_COMPONENTS_ALL design)
endif()
set(CPACK_DEBIAN_DESIGN_PACKAGE_NAME strainwave-design)
set(CPACK_DEBIAN_DESIGN_PACKAGE_SECTION electronics)
set(CPACK_COMPONENT_DESIGN_DESCRIPTION "Design of gain tables for strain-wave joints
 Fits the friction of a gear to its catalogue or to recorded motion, designs
 and verifies gain tables for strainwaved, and simulates the closed loop.
 Needs no robot. The program strainwave-design contains SDPA, which is under
 the GNU General Public License.")
set(CPACK_DEBIAN_DESIGN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_DESIGN_DEBUGINFO_PACKAGE ON)
# Its figures alone need gnuplot.
set(CPACK_DEBIAN_DESIGN_PACKAGE_SUGGESTS "gnuplot-nox | gnuplot, strainwave")

if(STRAINWAVE_BUILD_SPY)
  list(APPEND CPACK_COMPONENTS_ALL spy)
endif()
set(CPACK_DEBIAN_SPY_PACKAGE_NAME strainwave-spy)
set(CPACK_DEBIAN_SPY_PACKAGE_SECTION electronics)
set(CPACK_DEBIAN_SPY_PACKAGE_ARCHITECTURE all)
set(CPACK_COMPONENT_SPY_DESCRIPTION "Viewer of Strainwave's messages
 LCM's viewer with the messages of strainwaved decoded, and a plot of
 position, setpoint, error, torque and temperature of a joint.")
set(CPACK_DEBIAN_SPY_PACKAGE_DEPENDS "default-jre (>= 2:1.17), liblcm-java (>= 1.3.1), libjchart2d-java")

set(CPACK_DEBIAN_LCMTYPES_PACKAGE_NAME libstrainwave-lcmtypes-dev)
set(CPACK_DEBIAN_LCMTYPES_PACKAGE_SECTION libdevel)
set(CPACK_COMPONENT_LCMTYPES_DESCRIPTION "Strainwave's LCM messages for other programs
 The message types of strainwaved: their definitions, headers for C and C++,
 and a static library for C. Those for Python are in python3-strainwave.")
set(CPACK_DEBIAN_LCMTYPES_PACKAGE_DEPENDS "liblcm-dev (>= 1.3.1)")

set(CPACK_DEBIAN_CLIENT_PACKAGE_NAME libstrainwave-client-dev)
set(CPACK_DEBIAN_CLIENT_PACKAGE_SECTION libdevel)
set(CPACK_COMPONENT_CLIENT_DESCRIPTION "Strain-wave joints from C++
 Moves and watches joints of strainwaved: orders are signed, acknowledged and
 repeated, setpoints come as a stream, states have names and units. A static
 library with its headers, for CMake and pkg-config.")
# lcm.pc asks for glib, which liblcm-dev does not bring.
set(CPACK_DEBIAN_CLIENT_PACKAGE_DEPENDS
  "libstrainwave-lcmtypes-dev (= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}), libfmt-dev, libglib2.0-dev, liblcm-dev (>= 1.3.1), libsodium-dev")
set(CPACK_DEBIAN_CLIENT_PACKAGE_SUGGESTS strainwave)

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-strainwave)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_ARCHITECTURE all)
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "Strain-wave joints from Python
 Moves and watches joints of strainwaved: orders are signed, acknowledged and
 repeated, setpoints come as a stream, states have names and units. Pure
 Python over LCM's wire format; no LCM library is needed.")
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.11), libsodium23")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS strainwave)

include(CPack)
