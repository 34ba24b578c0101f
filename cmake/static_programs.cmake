# SPDX-License-Identifier: MIT
# Links the programs statically, so that they need no shared library:
# docs/development/adr/0018-static-programs.md. Sets PH_IS_STATIC and PH_FMT, the target to link for
# fmt, and makes CMake find ZLIB, PNG and FreeType as static libraries.
ph_choice(PH_STATIC_PROGRAMS AUTO
          "Link the programs statically: ON, OFF, or AUTO: if all archives are there" AUTO ON OFF)
set(PH_IS_STATIC FALSE)
set(PH_FMT fmt::fmt)
if(PH_COMPILE_DEPENDENCIES)
  set(PH_FMT fmt::fmt-header-only)
endif()

# Called for each of our programs. The linker map lists the archives in the program: their licences
# must accompany each copy.
function(ph_link_program program)
  if(WIN32)
    target_sources(${program} PRIVATE ${PROJECT_SOURCE_DIR}/apps/common/system/windows/utf8.rc)
  endif()
  if(NOT PH_IS_STATIC)
    return()
  endif()
  # The map is not passed with -Wl, which would split its path at commas.
  target_link_options(${program} PRIVATE -static -Wl,--gc-sections
                      -Xlinker -Map=${CMAKE_CURRENT_BINARY_DIR}/${program}.map)
endfunction()

if(NOT PH_STATIC_PROGRAMS OR NOT PH_BUILD_APPS)
  return()
endif()
if(PH_WITH_CUDA)  # the CUDA runtime loads the driver, which is a shared library
  if(NOT PH_STATIC_PROGRAMS STREQUAL "AUTO")
    message(FATAL_ERROR "PH_STATIC_PROGRAMS: programs with PH_WITH_CUDA cannot be static")
  endif()
  message(STATUS "Programs: linked dynamically, as PH_WITH_CUDA needs")
  return()
endif()

find_library(PH_ARCHIVE_ZLIB libz.a)
find_library(PH_ARCHIVE_PNG libpng.a)
find_library(PH_ARCHIVE_FREETYPE libfreetype.a)
find_library(PH_ARCHIVE_BROTLIDEC libbrotlidec.a)
find_library(PH_ARCHIVE_BROTLICOMMON libbrotlicommon.a)
mark_as_advanced(PH_ARCHIVE_ZLIB PH_ARCHIVE_PNG PH_ARCHIVE_FREETYPE PH_ARCHIVE_BROTLIDEC
                 PH_ARCHIVE_BROTLICOMMON)
set(PH_ARCHIVES ${PH_ARCHIVE_FREETYPE} ${PH_ARCHIVE_PNG} ${PH_ARCHIVE_BROTLIDEC}
                ${PH_ARCHIVE_BROTLICOMMON} ${PH_ARCHIVE_ZLIB})
# Clang does not support -fkeep-inline-functions (see below).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND NOT PH_ARCHIVES MATCHES NOTFOUND)
  # This test program checks that static linking works: with sanitizers, for example, it does not.
  include(CheckCXXSourceCompiles)
  set(CMAKE_REQUIRED_LINK_OPTIONS -static)
  set(CMAKE_REQUIRED_LIBRARIES ${PH_ARCHIVES})
  check_cxx_source_compiles("
    #include <iostream>
    #include <thread>
    extern \"C\" int FT_Init_FreeType(void**);
    extern \"C\" unsigned png_access_version_number();
    int main() {
      void* library;
      std::jthread([&] { std::cout << FT_Init_FreeType(&library) << png_access_version_number(); });
    }" PH_LINKS_STATICALLY)
  unset(CMAKE_REQUIRED_LINK_OPTIONS)
  unset(CMAKE_REQUIRED_LIBRARIES)
endif()
if(PH_LINKS_STATICALLY)
  message(STATUS "Programs: linked statically")
elseif(PH_STATIC_PROGRAMS STREQUAL "AUTO")
  message(STATUS "Programs: linked dynamically")
  return()
else()
  message(FATAL_ERROR "PH_STATIC_PROGRAMS: ${CMAKE_CXX_COMPILER_ID} cannot link statically with "
                      "${PH_ARCHIVES}; needs GCC and these archives")
endif()

set(PH_IS_STATIC TRUE)

target_compile_options(ph_options INTERFACE -ffunction-sections)
# Makes find_package() choose these archives, even if an earlier dynamic configuration found others.
foreach(library ZLIB PNG FREETYPE)
  set(${library}_LIBRARY ${PH_ARCHIVE_${library}})
  set(${library}_LIBRARY_RELEASE ${PH_ARCHIVE_${library}})
endforeach()

include(${CMAKE_CURRENT_LIST_DIR}/static_fmt.cmake)
