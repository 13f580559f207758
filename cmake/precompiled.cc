// Nothing: carries the precompiled header, see Targets.cmake.
