# SPDX-License-Identifier: BSD-3-Clause
# How every target of ours is made: includes from the root, warnings on our code only (errors in the presets).
add_library(strainwave_flags INTERFACE)
target_include_directories(strainwave_flags INTERFACE "${PROJECT_SOURCE_DIR}")
# Some libraries' flags ask for it; where all have it, all fit one precompiled header.
target_compile_options(strainwave_flags INTERFACE -pthread)
target_compile_definitions(strainwave_flags INTERFACE STRAINWAVE_VERSION="${PROJECT_VERSION}")
if(STRAINWAVE_SANITIZE)
  # Instrumented code hides from GCC what is initialised; its manual says to expect false alarms of this warning.
  target_compile_options(strainwave_flags INTERFACE
    -fsanitize=${STRAINWAVE_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  target_link_options(strainwave_flags INTERFACE -fsanitize=${STRAINWAVE_SANITIZE})
  # These ask at every access and double the compiler's time, for what the address sanitizer and warnings stop as well. The preset "fuzz",
  # whose clang is quicker at it, keeps them.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND STRAINWAVE_SANITIZE MATCHES "undefined")
    target_compile_options(strainwave_flags INTERFACE
      -fno-sanitize=null,alignment,object-size,vptr,pointer-overflow,nonnull-attribute,returns-nonnull-attribute,return)
  endif()
endif()

add_library(strainwave_warnings INTERFACE)
target_compile_options(strainwave_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wdouble-promotion
  -Wnon-virtual-dtor -Woverloaded-virtual -Wold-style-cast -Wcast-align -Wcast-qual
  -Wformat=2 -Wimplicit-fallthrough -Wundef -Wunused -Wextra-semi)

# GCC 12 warns of overlapping copies inside its own std::string (its bug 105651) as soon as it inlines operator+.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(strainwave_warnings INTERFACE -Wno-restrict)
endif()

# What most files include, compiled once: a third of the time that building takes is spent on reading these. The precompiled
# header is shared by all targets; whoever includes nothing of it loses nothing. Every file still includes what it uses: the preset
# "fuzz" builds without, and clang-tidy reads them so.
file(CONFIGURE OUTPUT "${CMAKE_BINARY_DIR}/precompiled.cc" CONTENT "// Nothing: carries the precompiled header.\n")
add_library(strainwave_precompiled OBJECT "${CMAKE_BINARY_DIR}/precompiled.cc")
target_link_libraries(strainwave_precompiled PRIVATE strainwave_flags strainwave_warnings Eigen3::Eigen Threads::Threads)
target_precompile_headers(strainwave_precompiled PRIVATE
  <Eigen/Dense> <algorithm> <array> <atomic> <chrono> <cmath> <cstdint> <filesystem> <fstream> <functional> <map> <memory>
  <optional> <sstream> <string> <string_view> <thread> <utility> <vector>)

# strainwave_precompile(TARGET)
function(strainwave_precompile target)
  target_precompile_headers(${target} REUSE_FROM strainwave_precompiled)
endfunction()

# strainwave_units(TARGET): compiles several of its files as one, which costs half of the time, since headers and templates are read
# and made once. Private names must therefore differ within a target. The preset "fuzz" and clang-tidy read files as they are.
function(strainwave_units target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${STRAINWAVE_UNITS} UNITY_BUILD_BATCH_SIZE 16)
endfunction()

# strainwave_false_overlap(file...): files in which GCC 12 (its bug 105651) sees a copy past the end of a string that is put together
# from short ones, where the hardened library tells it sizes.
function(strainwave_false_overlap)
  set_property(SOURCE ${ARGN} APPEND PROPERTY COMPILE_OPTIONS
    $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds;-Wno-stringop-overflow;-Wno-stringop-overread>)
endfunction()

# strainwave_library(NAME SOURCES file... [PUBLIC lib...] [PRIVATE lib...])
function(strainwave_library name)
  cmake_parse_arguments(arg "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(${name} STATIC ${arg_SOURCES})
  target_link_libraries(${name} PUBLIC strainwave_flags ${arg_PUBLIC} PRIVATE strainwave_warnings ${arg_PRIVATE})
  strainwave_precompile(${name})
  strainwave_units(${name})
endfunction()

# strainwave_portable_library(...): the same for what libstrainwave-client holds, which others link into programs and libraries of
# theirs: position-independent, which the precompiled header is not, and file by file, so that it holds no more than it needs.
# Files that are only needed together may be named as a unit (UNITY_GROUP).
function(strainwave_portable_library name)
  strainwave_library(${name} ${ARGN})
  set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE ON DISABLE_PRECOMPILE_HEADERS ON UNITY_BUILD OFF)
endfunction()

# strainwave_program(NAME SOURCES file... [PRIVATE lib...])
function(strainwave_program name)
  cmake_parse_arguments(arg "" "" "SOURCES;PRIVATE" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE strainwave_flags strainwave_warnings ${arg_PRIVATE})
  strainwave_precompile(${name})
  strainwave_units(${name})
endfunction()
