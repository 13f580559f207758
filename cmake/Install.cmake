# SPDX-License-Identifier: BSD-3-Clause
# What goes where on a machine; an install component has the name of its Debian package (debian/control). Programs find what belongs to them from where they are
# themselves: nothing points back into the source or build tree.
set(doc_dir "${CMAKE_INSTALL_DATAROOTDIR}/doc")
# systemd and udev of Debian 12 look below /lib; with its merged /usr that is /usr/lib.
set(unit_dir lib/systemd/system)

# strainwave_install_manual(COMPONENT PROGRAM.SECTION...): man pages and completion, which the target "manual" makes.
function(strainwave_install_manual component)
  set(folder "${CMAKE_BINARY_DIR}/man")
  foreach(page IN LISTS ARGN)
    cmake_path(GET page STEM program)
    cmake_path(GET page EXTENSION section)
    string(REPLACE "." "man" section_folder "${section}")
    install(FILES "${folder}/${page}.gz" DESTINATION ${CMAKE_INSTALL_MANDIR}/${section_folder} COMPONENT ${component})
    install(FILES "${folder}/${program}.bash" RENAME ${program}
            DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/bash-completion/completions COMPONENT ${component})
    install(FILES "${folder}/_${program}" DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/zsh/vendor-completions COMPONENT ${component})
  endforeach()
endfunction()

# Package strainwave: daemon, client, units, example configuration, documentation.
install(TARGETS strainwavectl DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT strainwave)
strainwave_install_manual(strainwave strainwavectl.1)
if(STRAINWAVE_BUILD_DAEMON)
  install(TARGETS strainwaved strainwave-telemetry DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT strainwave)
  install(TARGETS strainwave-gateway DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/strainwave COMPONENT strainwave)
  install(PROGRAMS systemd/grant-sysfs DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/strainwave COMPONENT strainwave)

  # strainwave_unit(NAME CONFIGURATION STATE TITLE COMMENT): one source for the service and its template.
  function(strainwave_unit UNIT_NAME UNIT_CONFIGURATION UNIT_STATE UNIT_TITLE UNIT_COMMENT)
    configure_file(systemd/strainwaved.service.in "${CMAKE_BINARY_DIR}/systemd/${UNIT_NAME}.service" @ONLY)
    install(FILES "${CMAKE_BINARY_DIR}/systemd/${UNIT_NAME}.service" DESTINATION ${unit_dir} COMPONENT strainwave)
  endfunction()
  strainwave_unit(strainwaved strainwaved strainwave "" "The daemon of this machine, with /etc/strainwave/strainwaved.toml.")
  strainwave_unit(strainwaved@ %i strainwave/%i " (%i)"
    "A further daemon: strainwaved@left uses /etc/strainwave/left.toml, with a daemon.prefix and drives of its own.")
  configure_file(systemd/strainwave-telemetry.service.in "${CMAKE_BINARY_DIR}/systemd/strainwave-telemetry.service" @ONLY)
  install(FILES "${CMAKE_BINARY_DIR}/systemd/strainwave-telemetry.service" DESTINATION ${unit_dir} COMPONENT strainwave)
  configure_file("systemd/strainwave-gateway@.service.in" "${CMAKE_BINARY_DIR}/systemd/strainwave-gateway@.service" @ONLY)
  install(FILES "${CMAKE_BINARY_DIR}/systemd/strainwave-gateway@.service" systemd/strainwave-gateway.socket
          systemd/strainwave-multicast.service DESTINATION ${unit_dir} COMPONENT strainwave)
  install(FILES systemd/strainwave.sysusers DESTINATION lib/sysusers.d RENAME strainwave.conf COMPONENT strainwave)
  install(FILES systemd/strainwave.tmpfiles DESTINATION lib/tmpfiles.d RENAME strainwave.conf COMPONENT strainwave)
  install(FILES systemd/60-strainwave.rules DESTINATION lib/udev/rules.d COMPONENT strainwave)
  install(DIRECTORY systemd/network DESTINATION ${CMAKE_INSTALL_DATADIR}/strainwave COMPONENT strainwave)
  install(FILES packaging/strainwaved.toml packaging/authorized_keys
          DESTINATION ${CMAKE_INSTALL_FULL_SYSCONFDIR}/strainwave COMPONENT strainwave)
  install(FILES data/tables/rhs17-6006.json DESTINATION ${CMAKE_INSTALL_DATADIR}/strainwave/tables COMPONENT strainwave)
  # The tree's own order, so that links between the pages hold.
  install(FILES README.md DESTINATION ${doc_dir}/strainwave COMPONENT strainwave)
  install(DIRECTORY docs config DESTINATION ${doc_dir}/strainwave COMPONENT strainwave)
  install(DIRECTORY "${STRAINWAVE_WEB}" DESTINATION ${CMAKE_INSTALL_DATADIR}/strainwave COMPONENT strainwave)
  strainwave_install_manual(strainwave strainwaved.8 strainwave-telemetry.8)
endif()

# Package strainwave-design: what needs no robot.
if(TARGET strainwave-sim)
  install(TARGETS strainwave-sim DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT strainwave-design)
  strainwave_install_manual(strainwave-design strainwave-sim.1)
  install(DIRECTORY data DESTINATION ${CMAKE_INSTALL_DATADIR}/strainwave COMPONENT strainwave-design)
endif()
if(STRAINWAVE_BUILD_DESIGN)
  install(TARGETS strainwave-design DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT strainwave-design)
  strainwave_install_manual(strainwave-design strainwave-design.1)
endif()

# Package strainwave-spy.
if(STRAINWAVE_BUILD_SPY)
  install(FILES "${STRAINWAVE_SPY_JAR}" DESTINATION ${CMAKE_INSTALL_DATADIR}/strainwave-spy COMPONENT strainwave-spy)
  install(PROGRAMS spy/strainwave-spy DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT strainwave-spy)
  install(FILES "${CMAKE_BINARY_DIR}/man/strainwave-spy.1.gz" DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT strainwave-spy)
endif()

# Package libstrainwave-lcmtypes-dev.
install(FILES ${STRAINWAVE_LCM_SOURCES} DESTINATION ${CMAKE_INSTALL_DATADIR}/lcmtypes/strainwave COMPONENT libstrainwave-lcmtypes-dev)
install(TARGETS strainwave-lcmtypes DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT libstrainwave-lcmtypes-dev)
install(DIRECTORY "${STRAINWAVE_LCM_GENERATED_DIR}/strainwave" "${STRAINWAVE_LCM_GENERATED_DIR}/c/strainwave"
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT libstrainwave-lcmtypes-dev FILES_MATCHING PATTERN "*.hpp" PATTERN "*.h")
# Where a .pc file finds its prefix, from where it is itself: another prefix needs no other file.
file(RELATIVE_PATH up_to_prefix "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
configure_file(packaging/strainwave-lcmtypes.pc.in "${CMAKE_BINARY_DIR}/packaging/strainwave-lcmtypes.pc" @ONLY)
install(FILES "${CMAKE_BINARY_DIR}/packaging/strainwave-lcmtypes.pc" DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
        COMPONENT libstrainwave-lcmtypes-dev)

# Package libstrainwave-client-dev: find_package(strainwave-client), target strainwave::client, or pkg-config.
install(TARGETS strainwave-client EXPORT strainwave-client DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT libstrainwave-client-dev)
install(EXPORT strainwave-client NAMESPACE strainwave:: FILE strainwave-client-targets.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/strainwave-client COMPONENT libstrainwave-client-dev)
include(CMakePackageConfigHelpers)
write_basic_package_version_file("${CMAKE_BINARY_DIR}/packaging/strainwave-client-config-version.cmake" COMPATIBILITY SameMinorVersion)
install(FILES packaging/strainwave-client-config.cmake "${CMAKE_BINARY_DIR}/packaging/strainwave-client-config-version.cmake"
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/strainwave-client COMPONENT libstrainwave-client-dev)
install(DIRECTORY strainwave DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT libstrainwave-client-dev)
configure_file(packaging/strainwave-client.pc.in "${CMAKE_BINARY_DIR}/packaging/strainwave-client.pc" @ONLY)
install(FILES "${CMAKE_BINARY_DIR}/packaging/strainwave-client.pc" DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
        COMPONENT libstrainwave-client-dev)

# Package python3-strainwave: our modules and lcm-gen's types.
install(DIRECTORY "${STRAINWAVE_PYTHON_PACKAGE}" DESTINATION lib/python3/dist-packages COMPONENT python3-strainwave
        FILES_MATCHING PATTERN "*.py" PATTERN "__pycache__" EXCLUDE)

# What the packages hold; scripts/package builds it without the tests.
add_custom_target(products DEPENDS strainwavectl strainwave-lcmtypes strainwave-client strainwave_python)
foreach(product manual strainwaved strainwave-gateway strainwave-telemetry strainwave-sim strainwave-design strainwave_spy)
  if(TARGET ${product})
    add_dependencies(products ${product})
  endif()
endforeach()
