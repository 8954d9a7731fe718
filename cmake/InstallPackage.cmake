# cmake --install: headers below include/<library>/, the libraries, and what makes them known to others:
# find_package(ompl_improved_astar) and pkg-config's ompl_improved_astar. Everything installed may be moved as a whole.
include(CMakePackageConfigHelpers)
include(PkgConfigFile)

get_property(parking_libraries GLOBAL PROPERTY PARKING_LIBRARIES)
get_property(parking_core_libraries GLOBAL PROPERTY PARKING_CORE_LIBRARIES)
set(parking_other_libraries ${parking_libraries})
list(REMOVE_ITEM parking_other_libraries ${parking_core_libraries})
set(parking_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/${PROJECT_NAME})

# The core in one target.
add_library(parking_core INTERFACE)
add_library(${PROJECT_NAME}::core ALIAS parking_core)
set_property(TARGET parking_core PROPERTY EXPORT_NAME core)
target_link_libraries(parking_core INTERFACE ${parking_core_libraries})

# Two sets of targets: that of the core can be read where OMPL, FCL and the others are not installed.
install(TARGETS parking_core EXPORT ${PROJECT_NAME}CoreTargets COMPONENT development)
foreach(set IN ITEMS core other)
  if(set STREQUAL "core")
    set(export ${PROJECT_NAME}CoreTargets)
  else()
    set(export ${PROJECT_NAME}Targets)
  endif()
  if(parking_${set}_libraries)
    install(TARGETS ${parking_${set}_libraries}
      EXPORT ${export}
      RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT libraries
      LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT libraries NAMELINK_COMPONENT development
      ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
      FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
    install(EXPORT ${export}
      NAMESPACE ${PROJECT_NAME}::
      DESTINATION ${parking_package_dir} COMPONENT development)
  endif()
endforeach()

if(BUILD_SHARED_LIBS)
  set(PARKING_STATIC_LIBRARIES OFF)
else()
  set(PARKING_STATIC_LIBRARIES ON)
endif()
if(PARKING_CORE_ONLY)
  set(parking_has_only_core ON)
else()
  set(parking_has_only_core OFF)
endif()
list(JOIN parking_libraries ", " parking_library_names)
configure_package_config_file(
  ${PROJECT_SOURCE_DIR}/cmake/PackageConfig.cmake.in
  ${PROJECT_BINARY_DIR}/package/${PROJECT_NAME}Config.cmake
  INSTALL_DESTINATION ${parking_package_dir}
  NO_SET_AND_CHECK_MACRO)
# Before 1.0 every minor version may change interfaces.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/package/${PROJECT_NAME}ConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES
  ${PROJECT_BINARY_DIR}/package/${PROJECT_NAME}Config.cmake
  ${PROJECT_BINARY_DIR}/package/${PROJECT_NAME}ConfigVersion.cmake
  DESTINATION ${parking_package_dir} COMPONENT development)
install(FILES ${PROJECT_SOURCE_DIR}/cmake/Dependencies.cmake
  DESTINATION ${parking_package_dir} COMPONENT development RENAME ${PROJECT_NAME}Dependencies.cmake)

# ROS finds packages by this file.
install(FILES ${PROJECT_SOURCE_DIR}/package.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/${PROJECT_NAME} COMPONENT development)

parking_install_pkg_config()

install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT licence)

# The programs, where they are built, with the problems that they bring.
foreach(program IN ITEMS parking_plan parking_benchmark parking_queries)
  if(TARGET ${program})
    install(TARGETS ${program} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT programs)
    file(RELATIVE_PATH parking_bin_to_lib ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
    set_property(TARGET ${program} PROPERTY INSTALL_RPATH "$ORIGIN/${parking_bin_to_lib}")
  endif()
endforeach()
foreach(library IN LISTS parking_libraries)
  set_property(TARGET ${library} PROPERTY INSTALL_RPATH "$ORIGIN")
endforeach()
