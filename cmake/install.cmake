# SPDX-License-Identifier: MIT
# Installation for other projects: `cmake --install`, then find_package(ph CONFIG). Each library has
# its own set of exported targets, and thus requires only its own dependencies.
#
# `cmake --install BUILD --component NAME` installs one component: `c`, the files needed to run
# programs linked with ph::c; `dev`, the files needed to compile and link programs; `pcl` and
# `alpha`, the same for ph::pcl and ph::alpha; `programs`; `mpi`; `python`; `doc`; `licence`.
# debian/rules makes a package of each component, except `mpi` and `licence`.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/ph)

foreach(library core c io plot segment report pcl alpha)
  if(NOT TARGET ph_${library})
    continue()
  endif()
  set(component dev)
  if(library MATCHES "^(pcl|alpha)$")
    set(component ${library})
  endif()
  set_target_properties(ph_${library} PROPERTIES EXPORT_NAME ${library})
  install(TARGETS ph_${library} EXPORT ph-${library}
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${component}
          LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT c NAMELINK_COMPONENT dev
          INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(EXPORT ph-${library} NAMESPACE ph:: DESTINATION ${package_dir} COMPONENT ${component})
endforeach()

install(DIRECTORY libph/include/ph DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT dev)
foreach(library segment report)
  if(TARGET ph_${library})
    install(DIRECTORY lib${library}/include/ph DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT dev)
  endif()
endforeach()
if(TARGET ph_pcl)
  install(DIRECTORY libsegment/pcl/include/ph DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT pcl)
endif()
if(PH_BUILD_APPS)
  install(TARGETS ph-barcode ph-cluster ph-distance ph-segment ph-vectorise
          RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT programs)
endif()
if(TARGET ph-barcode-mpi)
  install(TARGETS ph-barcode-mpi RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT mpi)
endif()
# The pages keep the layout of the repository, because this keeps the links between them valid. If
# libph is part of a larger project, the pages of libph go to a separate folder.
set(doc_dir ${CMAKE_INSTALL_DOCDIR})
if(NOT PROJECT_IS_TOP_LEVEL)
  set(doc_dir ${CMAKE_INSTALL_DATAROOTDIR}/doc/libph)
endif()
install(FILES README.md CHANGELOG.md CITATION.cff CODE_OF_CONDUCT.md CONTRIBUTING.md SECURITY.md
        DESTINATION ${doc_dir} COMPONENT doc)
install(DIRECTORY docs examples DESTINATION ${doc_dir} COMPONENT doc
        PATTERN CMakeLists.txt EXCLUDE PATTERN docs/site EXCLUDE)
install(FILES LICENSE DESTINATION ${doc_dir} COMPONENT licence)

# If only the component `dev` is installed, it includes the link libph_c.so but not the library
# itself. A dangling link tells find_package that ph::c is missing.
set(c_library ${CMAKE_INSTALL_LIBDIR}/${CMAKE_SHARED_LIBRARY_PREFIX}ph_c${CMAKE_SHARED_LIBRARY_SUFFIX})
configure_package_config_file(cmake/ph-config.cmake.in ${PROJECT_BINARY_DIR}/ph-config.cmake
                              INSTALL_DESTINATION ${package_dir} PATH_VARS c_library)
# Before 1.0, a minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/ph-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/ph-config.cmake ${PROJECT_BINARY_DIR}/ph-config-version.cmake
        DESTINATION ${package_dir} COMPONENT dev)
