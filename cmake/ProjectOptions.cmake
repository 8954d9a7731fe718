# Options, warnings and the helper that makes every library of the project the same way.

option(BUILD_SHARED_LIBS "Build shared libraries" OFF)
option(PARKING_CORE_ONLY "Build only what needs nothing but Eigen: geometry, footprint checks and search" OFF)
if(PROJECT_IS_TOP_LEVEL AND NOT PARKING_CORE_ONLY)
  set(parking_everything ON)
else()
  set(parking_everything OFF)
endif()
# colcon builds workspaces for their users: the libraries and programs.
if(parking_everything AND NOT DEFINED ENV{COLCON})
  set(parking_checks ON)
else()
  set(parking_checks OFF)
endif()
option(PARKING_BUILD_TESTS "Build the tests" ${parking_checks})
option(PARKING_BUILD_BENCHMARKS "Build parking_plan, parking_benchmark and the micro-benchmarks" ${parking_everything})
option(PARKING_BUILD_EXAMPLES "Build the example programs" ${parking_checks})
if(PARKING_CORE_ONLY AND (PARKING_BUILD_TESTS OR PARKING_BUILD_BENCHMARKS OR PARKING_BUILD_EXAMPLES))
  message(FATAL_ERROR "PARKING_CORE_ONLY builds three libraries; the tests, benchmarks and examples need the others, too: "
    "set PARKING_BUILD_TESTS, PARKING_BUILD_BENCHMARKS and PARKING_BUILD_EXAMPLES to OFF")
endif()
set(PARKING_PYTHON AUTO CACHE STRING "Build the Python module: ON, OFF, or AUTO (when pybind11, Python and NumPy are found)")
set_property(CACHE PARKING_PYTHON PROPERTY STRINGS AUTO ON OFF)
# The Python module needs the readers and the drawings; with the core alone only when it is asked for.
if(NOT PARKING_CORE_ONLY OR PARKING_PYTHON STREQUAL "ON")
  set(PARKING_READERS ON)
endif()
option(PARKING_WARNINGS_AS_ERRORS "Treat compiler warnings as errors" OFF)
option(PARKING_PACKAGES "Prepare Debian packages, which cpack -G DEB makes; the prefix is /usr then" OFF)
set(PARKING_REFERENCE "" CACHE PATH "Folder of the reference pages that go into the packages (scripts/docs builds them)")
set(PARKING_SANITIZER "" CACHE STRING "Sanitizers to build with, for example address,undefined or thread")

if(PROJECT_IS_TOP_LEVEL AND NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

if((CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 9) OR
    (CMAKE_CXX_COMPILER_ID STREQUAL "Clang" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 9))
  message(FATAL_ERROR "${CMAKE_CXX_COMPILER} is version ${CMAKE_CXX_COMPILER_VERSION}, C++17 as used here needs GCC 9 or "
    "clang 9: install a newer g++")
endif()
set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
# Projects that add this one as a subdirectory link the dependencies' targets, too: they must see them.
set(CMAKE_FIND_PACKAGE_TARGETS_GLOBAL ON)

# The tests and the comparison precompile headers of others that nearly all their sources include. ccache keeps no object
# that is made so, and clang refuses precompiled headers where macros differ.
if(NOT DEFINED CMAKE_DISABLE_PRECOMPILE_HEADERS
    AND (CMAKE_CXX_COMPILER_LAUNCHER OR NOT CMAKE_CXX_COMPILER_ID STREQUAL "GNU"))
  set(CMAKE_DISABLE_PRECOMPILE_HEADERS ON)
endif()

# Private to the project: consumers of the installed package get none of these flags.
add_library(parking_build_flags INTERFACE)
target_compile_options(parking_build_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual
  $<$<BOOL:${PARKING_WARNINGS_AS_ERRORS}>:-Werror>)
# A program finds the functions of its libraries when it starts, and not while it plans for the first time.
target_link_options(parking_build_flags INTERFACE $<$<PLATFORM_ID:Linux>:-Wl,-z,now>)
if(BUILD_SHARED_LIBS AND NOT PARKING_SANITIZER)
  # What a library lacks, its own build says. A module finds the rest in what loads it: the Python module, in Python.
  target_link_options(parking_build_flags INTERFACE
    $<$<STREQUAL:$<TARGET_PROPERTY:TYPE>,SHARED_LIBRARY>:-Wl,-z,defs>)
endif()
if(PARKING_SANITIZER)
  target_compile_options(parking_build_flags INTERFACE -fsanitize=${PARKING_SANITIZER} -fno-omit-frame-pointer)
  target_link_options(parking_build_flags INTERFACE -fsanitize=${PARKING_SANITIZER})
endif()

# Before 1.0 every minor version may change the binary interface.
if(PROJECT_VERSION_MAJOR EQUAL 0)
  set(PARKING_SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
else()
  set(PARKING_SOVERSION ${PROJECT_VERSION_MAJOR})
endif()

# parking_add_library(name [CORE]): a library whose headers are included as <folder/Header.h>, exported as
# ompl_improved_astar::name. Sources are added with target_sources, headers as its FILE_SET HEADERS. A library of the
# core needs nothing but Eigen and other libraries of the core.
function(parking_add_library name)
  cmake_parse_arguments(ARG "CORE" "" "" ${ARGN})
  add_library(${name})
  add_library(ompl_improved_astar::${name} ALIAS ${name})
  target_compile_features(${name} PUBLIC cxx_std_17)
  target_link_libraries(${name} PRIVATE $<BUILD_INTERFACE:parking_build_flags>)
  if(BUILD_SHARED_LIBS AND NOT PARKING_SANITIZER)
    # What others' templates leave in our libraries (Eigen, Ceres, the standard library) is nobody else's.
    target_link_options(${name} PRIVATE -Wl,--version-script=${PROJECT_SOURCE_DIR}/cmake/symbols.map)
    set_property(TARGET ${name} APPEND PROPERTY LINK_DEPENDS ${PROJECT_SOURCE_DIR}/cmake/symbols.map)
  endif()
  set_target_properties(${name} PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION ${PARKING_SOVERSION})
  set_property(GLOBAL APPEND PROPERTY PARKING_LIBRARIES ${name})
  if(ARG_CORE)
    set_property(GLOBAL APPEND PROPERTY PARKING_CORE_LIBRARIES ${name})
  endif()
endfunction()
