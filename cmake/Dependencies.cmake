# What the libraries need. This file is read by the project's own build and, installed beside it, by the package
# configuration, so that both find the same things. Debian's OMPL 1.5 exports no CMake target: it is made here.

include(CMakeFindDependencyMacro)

# parking_require(DEBIAN_PACKAGE ARGUMENT...): find_package(ARGUMENT...), with a word that says what to install.
macro(parking_require debian_package name)
  find_package(${name} ${ARGN} QUIET)
  if(NOT ${name}_FOUND)
    set(parking_wanted "${name}")
    if("${ARGN}" MATCHES "^([0-9.]+)")
      string(APPEND parking_wanted " ${CMAKE_MATCH_1} or later")
    endif()
    if(${name}_CONSIDERED_VERSIONS)
      string(APPEND parking_wanted " (only ${${name}_CONSIDERED_VERSIONS})")
    endif()
    message(FATAL_ERROR "${parking_wanted} was not found: install ${debian_package}")
  endif()
endmacro()

# Within find_package(ompl_improved_astar) a missing dependency must be reported the way that its caller asked for.
macro(parking_find debian_package)
  if(PARKING_PACKAGE_CONFIG)
    find_dependency(${ARGN})
  else()
    parking_require(${debian_package} ${ARGN})
  endif()
endmacro()

# All that the core needs.
parking_find(libeigen3-dev Eigen3 3.3 NO_MODULE)
if(PARKING_CORE_ONLY)
  if(PARKING_READERS)
    parking_find(libyaml-cpp-dev yaml-cpp)
    parking_find(libpng-dev PNG)
  endif()
  return()
endif()

# What the public headers include. No version of OMPL is asked for: its configuration refuses other major versions.
parking_find(libompl-dev ompl)
if(ompl_VERSION AND ompl_VERSION VERSION_LESS 1.5 AND NOT PARKING_PACKAGE_CONFIG)
  message(FATAL_ERROR "OMPL 1.5 or later is needed, ${ompl_VERSION} was found: install a newer libompl-dev")
endif()
parking_find(libfcl-dev fcl)

# What only the sources need: of interest to consumers of static libraries, which link it, but not of shared ones.
if(NOT PARKING_PACKAGE_CONFIG OR PARKING_STATIC_LIBRARIES)
  parking_find(libyaml-cpp-dev yaml-cpp)
  parking_find(libpng-dev PNG)
  parking_find(libceres-dev Ceres)
endif()

if(NOT TARGET ompl_improved_astar::ompl_dependency)
  # Packages of OMPL name folders of packages that they do not bring; a target with one of them cannot be used. Nothing
  # that is needed comes from there.
  if(TARGET ompl::ompl)
    get_target_property(parking_ompl_folders ompl::ompl INTERFACE_INCLUDE_DIRECTORIES)
  else()
    set(parking_ompl_folders ${OMPL_INCLUDE_DIRS})
  endif()
  set(parking_ompl_includes)
  foreach(dir IN LISTS parking_ompl_folders)
    if((IS_DIRECTORY "${dir}" OR dir MATCHES "\\$<") AND NOT dir STREQUAL "/usr/include")
      list(APPEND parking_ompl_includes ${dir})
    endif()
  endforeach()
  add_library(ompl_improved_astar::ompl_dependency INTERFACE IMPORTED)
  if(TARGET ompl::ompl)
    get_target_property(parking_ompl_is_imported ompl::ompl IMPORTED)
    if(parking_ompl_is_imported)
      set_property(TARGET ompl::ompl PROPERTY INTERFACE_INCLUDE_DIRECTORIES ${parking_ompl_includes})
    endif()
    set_property(TARGET ompl_improved_astar::ompl_dependency PROPERTY INTERFACE_LINK_LIBRARIES ompl::ompl)
  else()
    # OMPL_LIBRARIES names what OMPL itself was linked with, too (Boost's libraries, ODE). Programs that use OMPL
    # need none of it, and Debian's libompl-dev does not bring all of it.
    list(GET OMPL_LIBRARIES 0 parking_ompl_library)
    set_target_properties(ompl_improved_astar::ompl_dependency PROPERTIES
      INTERFACE_INCLUDE_DIRECTORIES "${parking_ompl_includes}"
      INTERFACE_LINK_LIBRARIES "${parking_ompl_library};Eigen3::Eigen")
  endif()
endif()
