# SPDX-License-Identifier: MIT
# What others use of us: `cmake --install`, then find_package(ph CONFIG). One set of exported
# targets a component, so that a component asks for its own dependencies only.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/ph)

foreach(component core c io plot segment pcl)
  if(NOT TARGET ph_${component})
    continue()
  endif()
  set_target_properties(ph_${component} PROPERTIES EXPORT_NAME ${component})
  install(TARGETS ph_${component} EXPORT ph-${component}
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
          LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
          INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(EXPORT ph-${component} NAMESPACE ph:: DESTINATION ${package_dir})
endforeach()

install(DIRECTORY libph/include/ph DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
if(TARGET ph_segment)
  install(DIRECTORY libsegment/include/ph DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endif()
if(TARGET ph_pcl)
  install(DIRECTORY libsegment/pcl/include/ph DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endif()
if(PH_BUILD_APPS)
  install(TARGETS ph-barcode ph-segment RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR}
          COMPONENT programs)
endif()
install(FILES LICENSE README.md CHANGELOG.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR})

configure_package_config_file(cmake/ph-config.cmake.in ${PROJECT_BINARY_DIR}/ph-config.cmake
                              INSTALL_DESTINATION ${package_dir})
# Before 1.0 a minor version may change what a program calls.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/ph-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/ph-config.cmake ${PROJECT_BINARY_DIR}/ph-config-version.cmake
        DESTINATION ${package_dir})
