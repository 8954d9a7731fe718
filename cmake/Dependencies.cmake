# What the libraries need. This file is read by the project's own build and, installed beside it, by the package
# configuration, so that both find the same things. Debian's OMPL 1.5 exports no CMake target: it is made here.

include(CMakeFindDependencyMacro)

# Within find_package(ompl_improved_astar) a missing dependency must be reported the way that its caller asked for.
macro(parking_find)
  if(PARKING_PACKAGE_CONFIG)
    find_dependency(${ARGV})
  else()
    find_package(${ARGV} REQUIRED)
  endif()
endmacro()

# All that the core needs.
parking_find(Eigen3 3.3 NO_MODULE)
if(PARKING_CORE_ONLY)
  return()
endif()

# What the public headers include. No version of OMPL is asked for: its configuration refuses other major versions.
parking_find(ompl)
parking_find(fcl)

# What only the sources need: of interest to consumers of static libraries, which link it, but not of shared ones.
if(NOT PARKING_PACKAGE_CONFIG OR PARKING_STATIC_LIBRARIES)
  parking_find(yaml-cpp)
  parking_find(PNG)
  parking_find(Ceres)
endif()

if(NOT TARGET ompl_improved_astar::ompl_dependency)
  add_library(ompl_improved_astar::ompl_dependency INTERFACE IMPORTED)
  if(TARGET ompl::ompl)
    set_property(TARGET ompl_improved_astar::ompl_dependency PROPERTY INTERFACE_LINK_LIBRARIES ompl::ompl)
  else()
    # OMPL_LIBRARIES names what OMPL itself was linked with, too (Boost's libraries, ODE). Programs that use OMPL
    # need none of it, and Debian's libompl-dev does not bring all of it.
    list(GET OMPL_LIBRARIES 0 parking_ompl_library)
    # Debian's OMPL names folders of packages that it does not bring; a target with one of them cannot be used.
    set(parking_ompl_includes)
    foreach(dir IN LISTS OMPL_INCLUDE_DIRS)
      if(IS_DIRECTORY ${dir} AND NOT dir STREQUAL "/usr/include")
        list(APPEND parking_ompl_includes ${dir})
      endif()
    endforeach()
    set_target_properties(ompl_improved_astar::ompl_dependency PROPERTIES
      INTERFACE_INCLUDE_DIRECTORIES "${parking_ompl_includes}"
      INTERFACE_LINK_LIBRARIES "${parking_ompl_library};Eigen3::Eigen")
  endif()
endif()
