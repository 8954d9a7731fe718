# Debian packages, made by cpack -G DEB (scripts/package does it all): the libraries, what compiling against them takes, the
# programs, the Python module, and the documentation. Nothing of this is needed to build or to install.
if(NOT BUILD_SHARED_LIBS)
  message(FATAL_ERROR "PARKING_PACKAGES makes packages of shared libraries: set BUILD_SHARED_LIBS to ON")
endif()
set(parking_source ompl-improved-astar)
set(parking_runtime_package libompl-improved-astar${PARKING_SOVERSION})
set(CPACK_COMPONENTS_ALL libraries development documentation)
if(TARGET parking_plan)
  list(APPEND CPACK_COMPONENTS_ALL programs)
endif()
if(TARGET improved_astar_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME ${parking_source})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "path planning for parking cars")
set(CPACK_PACKAGE_VENDOR "the ${PROJECT_NAME} authors")
set(CPACK_PACKAGE_CONTACT "The ${PROJECT_NAME} authors <${PROJECT_NAME}@localhost>" CACHE STRING "Maintainer of the packages")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
# What a library is linked with, and which version of it at least, is read from the files.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
get_property(parking_all_libraries GLOBAL PROPERTY PARKING_LIBRARIES)
foreach(library IN LISTS parking_all_libraries)
  get_target_property(dir ${library} BINARY_DIR)
  list(APPEND CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${dir})
  string(APPEND parking_shlibs "lib${library} ${PARKING_SOVERSION} ${parking_runtime_package} (= ${PROJECT_VERSION})\n")
endforeach()
# Who is linked with these libraries needs this package, and the linker is to know of them.
set(made ${PROJECT_BINARY_DIR}/package/debian)
file(WRITE ${made}/shlibs ${parking_shlibs})
file(WRITE ${made}/triggers "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_LIBRARIES_PACKAGE_CONTROL_EXTRA ${made}/shlibs ${made}/triggers)

set(CPACK_DEBIAN_LIBRARIES_PACKAGE_NAME ${parking_runtime_package})
set(CPACK_DEBIAN_LIBRARIES_PACKAGE_SECTION libs)
set(CPACK_COMPONENT_LIBRARIES_DESCRIPTION "Shared libraries: a planner for OMPL after the improved A* algorithm,
footprint checks that skip nothing between two samples, the geometry of
parking manoeuvres, trajectory optimisation and a controller that drives the
result.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME lib${parking_source}-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "${parking_runtime_package} (= ${PROJECT_VERSION}), libeigen3-dev (>= 3.3), libompl-dev, libfcl-dev, libccd-dev")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS ${parking_source}-doc)
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Development files: headers, the CMake package ompl_improved_astar and files
for pkg-config. The component core needs nothing but Eigen.")

set(CPACK_COMPONENT_PROGRAMS_DEPENDS libraries)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_NAME ${parking_source})
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_RECOMMENDS
  "python3, python3-improved-astar, python3-jinja2, python3-numpy, python3-plotly, python3-scipy")
set(CPACK_COMPONENT_PROGRAMS_DESCRIPTION "Programs: parking_plan plans a parking problem, optimises and drives the
path; parking_benchmark compares planners on many problems.")

# The module is for one version of Python, as Debian's are. What Python compiles there when the package is installed, it takes
# away when the package is removed.
set(CPACK_COMPONENT_PYTHON_DEPENDS libraries)
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-improved-astar)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "${PARKING_PYTHON_DEPENDS}")
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-matplotlib, python3-pandas")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS ${parking_source}-doc)
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "Python module improved_astar: plans from scenario files, polygons and NumPy
arrays, optimises the drive, checks paths and draws them. It needs neither OMPL
nor FCL in its process.")
file(CONFIGURE OUTPUT ${made}/postinst @ONLY CONTENT "#!/bin/sh
set -e
if [ \"$1\" = configure ] && command -v py3compile >/dev/null; then
    py3compile -p python3-improved-astar
fi
")
file(CONFIGURE OUTPUT ${made}/prerm @ONLY CONTENT "#!/bin/sh
set -e
if command -v py3clean >/dev/null; then
    py3clean -p python3-improved-astar
fi
")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${made}/postinst ${made}/prerm)

set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_NAME ${parking_source}-doc)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_SHLIBDEPS OFF)
set(CPACK_COMPONENT_DOCUMENTATION_DESCRIPTION "Documentation: guides, examples, and the reference of the libraries as web
pages.")

# Each package has its licence and its changelog where Debian looks for them.
string(TIMESTAMP parking_date "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(CONFIGURE OUTPUT ${made}/changelog @ONLY CONTENT "@parking_source@ (@PROJECT_VERSION@) unstable; urgency=medium

  * See CHANGELOG.md in the package @parking_source@-doc.

 -- @CPACK_PACKAGE_CONTACT@  @parking_date@
")
file(READ ${PROJECT_SOURCE_DIR}/LICENSE parking_licence)
string(REGEX REPLACE "\n\n" "\n.\n" parking_licence "${parking_licence}")
string(REGEX REPLACE "\n(.)" "\n \\1" parking_licence "${parking_licence}")
file(WRITE ${made}/copyright "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: ${PROJECT_NAME}

Files: *
Copyright: 2026, the ${PROJECT_NAME} authors
License: BSD-3-Clause
 ${parking_licence}")
find_program(PARKING_GZIP gzip REQUIRED)
execute_process(COMMAND ${PARKING_GZIP} -9nf ${made}/changelog COMMAND_ERROR_IS_FATAL ANY)
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} upper)
  install(FILES ${made}/changelog.gz ${made}/copyright
    DESTINATION share/doc/${CPACK_DEBIAN_${upper}_PACKAGE_NAME} COMPONENT ${component})
endforeach()

set(doc share/doc/${parking_source}-doc)
install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md DESTINATION ${doc} COMPONENT documentation)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs DESTINATION ${doc} COMPONENT documentation PATTERN site EXCLUDE)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples DESTINATION ${doc} COMPONENT documentation)
if(PARKING_REFERENCE)
  install(DIRECTORY ${PARKING_REFERENCE}/ DESTINATION ${doc}/html COMPONENT documentation)
endif()

# The manual pages say what the programs say of themselves.
set(parking_plan_summary "plan how a car parks")
set(parking_benchmark_summary "compare planners on parking problems")
foreach(program IN ITEMS parking_plan parking_benchmark)
  if(TARGET ${program})
    find_program(PARKING_HELP2MAN help2man REQUIRED)
    add_custom_command(OUTPUT ${made}/${program}.1.gz
      COMMAND ${PARKING_HELP2MAN} --no-info --name ${${program}_summary} --version-string ${PROJECT_VERSION}
        --output ${made}/${program}.1 $<TARGET_FILE:${program}>
      COMMAND ${PARKING_GZIP} -9nf ${made}/${program}.1
      DEPENDS ${program} VERBATIM)
    list(APPEND parking_man_pages ${made}/${program}.1.gz)
  endif()
endforeach()
# What scripts/package builds: no micro-benchmarks.
add_custom_target(packaged DEPENDS ${parking_man_pages} ${parking_all_libraries})
# These are installed, too, and have no manual page that would have them built.
foreach(program IN ITEMS parking_queries parking_convert)
  if(TARGET ${program})
    add_dependencies(packaged ${program})
  endif()
endforeach()
if(TARGET improved_astar_python)
  add_dependencies(packaged improved_astar_python)
endif()
if(parking_man_pages)
  install(FILES ${parking_man_pages} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT programs)
endif()

include(CPack)
