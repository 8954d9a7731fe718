# The pkg-config files: of the core, and of the planner with what lies between. OMPL, FCL and libccd are named by their
# paths: Debian's ompl.pc is broken ("-L_link_dirs-NOTFOUND"), and fcl.pc and ompl.pc impose the language standard on users.

# -I, or nothing for a folder that the compiler searches anyway.
function(parking_include_flags result)
  set(flags)
  foreach(dir IN LISTS ARGN)
    if(IS_DIRECTORY "${dir}" AND NOT dir STREQUAL "/usr/include")
      list(APPEND flags "-I${dir}")
    endif()
  endforeach()
  list(REMOVE_DUPLICATES flags)
  list(JOIN flags " " flags)
  set(${result} "${flags}" PARENT_SCOPE)
endfunction()

# -L and -l for library files; no -L for the folders that the linker searches anyway.
function(parking_link_flags result)
  set(flags)
  foreach(file IN LISTS ARGN)
    get_filename_component(dir ${file} DIRECTORY)
    get_filename_component(name ${file} NAME)
    string(REGEX REPLACE "^lib|\\.(so|a)[.0-9]*$" "" name ${name})
    if(NOT dir IN_LIST CMAKE_CXX_IMPLICIT_LINK_DIRECTORIES)
      list(APPEND flags "-L${dir}")
    endif()
    list(APPEND flags "-l${name}")
  endforeach()
  list(REMOVE_DUPLICATES flags)
  list(JOIN flags " " flags)
  set(${result} "${flags}" PARENT_SCOPE)
endfunction()

# Writes and installs NAME.pc; the PC_ variables are what it says.
function(parking_write_pkg_config name)
  set(PC_NAME ${name})
  file(RELATIVE_PATH PC_PREFIX ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
  string(REGEX REPLACE "/$" "" PC_PREFIX "${PC_PREFIX}")
  list(TRANSFORM PC_LIBRARIES PREPEND "-l")
  list(JOIN PC_LIBRARIES " " PC_LIBRARIES)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/package.pc.in ${PROJECT_BINARY_DIR}/package/${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/package/${name}.pc
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
endfunction()

function(parking_install_pkg_config)
  set(PC_DESCRIPTION "The geometry, footprint checks and search of ${PROJECT_NAME}, without OMPL")
  set(PC_REQUIRES "eigen3 >= 3.3")
  set(PC_LIBRARIES parking_planner parking_perception improved_astar_search trajectory_optimization state_validity parking_geometry)
  parking_write_pkg_config(${PROJECT_NAME}_core)
  if(PARKING_CORE_ONLY)
    return()
  endif()

  set(files)
  foreach(library IN ITEMS ompl fcl ccd)
    find_library(PARKING_${library}_LIBRARY ${library} HINTS ${OMPL_LIBRARY_DIRS} ${FCL_LIBRARY_DIRS} ${CCD_LIBRARY_DIRS}
      REQUIRED)
    mark_as_advanced(PARKING_${library}_LIBRARY)
    list(APPEND files ${PARKING_${library}_LIBRARY})
  endforeach()
  parking_link_flags(PC_DEPENDENCY_LIBS ${files})
  set(includes ${OMPL_INCLUDE_DIRS} ${FCL_INCLUDE_DIRS} ${CCD_INCLUDE_DIRS})
  list(FILTER includes EXCLUDE REGEX "/eigen3$")  # comes with Requires: eigen3
  parking_include_flags(PC_DEPENDENCY_CFLAGS ${includes})

  set(PC_DESCRIPTION "${PROJECT_DESCRIPTION}")
  set(PC_REQUIRES "${PROJECT_NAME}_core = ${PROJECT_VERSION}, octomap")
  set(PC_LIBRARIES ompl_improved_astar state_validity_ompl state_validity_fcl)
  parking_write_pkg_config(${PROJECT_NAME})
endfunction()
