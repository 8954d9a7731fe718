# cmake --install: headers below include/<library>/, the libraries, and what makes them known to others:
# find_package(ompl_improved_astar) and pkg-config's ompl_improved_astar. Everything installed may be moved as a whole.
include(CMakePackageConfigHelpers)
include(PkgConfigFile)

get_property(parking_libraries GLOBAL PROPERTY PARKING_LIBRARIES)
set(parking_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/${PROJECT_NAME})

install(TARGETS ${parking_libraries}
  EXPORT ${PROJECT_NAME}Targets
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR}
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT ${PROJECT_NAME}Targets
  NAMESPACE ${PROJECT_NAME}::
  DESTINATION ${parking_package_dir})

if(BUILD_SHARED_LIBS)
  set(PARKING_STATIC_LIBRARIES OFF)
else()
  set(PARKING_STATIC_LIBRARIES ON)
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
  DESTINATION ${parking_package_dir})
install(FILES ${PROJECT_SOURCE_DIR}/cmake/Dependencies.cmake
  DESTINATION ${parking_package_dir} RENAME ${PROJECT_NAME}Dependencies.cmake)

parking_install_pkg_config()

install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

# The programs, where they are built, with the problems that they bring.
foreach(program IN ITEMS parking_plan parking_benchmark)
  if(TARGET ${program})
    install(TARGETS ${program} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
    file(RELATIVE_PATH parking_bin_to_lib ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
    set_property(TARGET ${program} PROPERTY INSTALL_RPATH "$ORIGIN/${parking_bin_to_lib}")
  endif()
endforeach()
foreach(library IN LISTS parking_libraries)
  set_property(TARGET ${library} PROPERTY INSTALL_RPATH "$ORIGIN")
endforeach()
