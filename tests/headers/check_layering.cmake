# SPDX-License-Identifier: MIT
# cmake -D LIBPH=<folder of libph> -P check_layering.cmake
# Which folder of libph may include which, for headers (include/ph/*) and sources (src/*) alike.
cmake_minimum_required(VERSION 3.25)  # without it, policies are those of CMake 2
set(may_include_core core)
set(may_include_metric core metric)
set(may_include_image core image)
set(may_include_complex core metric image complex)
set(may_include_cubical core cubical)
set(may_include_engine core cubical engine)
set(may_include_diagram core diagram)
set(may_include_io core metric image complex io)
# The merge tree's functions take complexes; only the source knows them.
set(exempt src/engine/merge_tree.cpp)

file(GLOB_RECURSE files RELATIVE ${LIBPH} ${LIBPH}/include/*.hpp ${LIBPH}/include/*.ipp
     ${LIBPH}/src/*.hpp ${LIBPH}/src/*.ipp ${LIBPH}/src/*.cpp)
set(violations 0)
set(checked 0)
foreach(file ${files})
  file(STRINGS ${LIBPH}/${file} includes REGEX "^[ \t]*#[ \t]*include")
  string(REGEX MATCH "^(include/ph|src)/([a-z_]+)/" _ ${file})
  set(folder "${CMAKE_MATCH_2}")
  foreach(include ${includes})
    math(EXPR checked "${checked} + 1")
    if(include MATCHES "<(pcl|CGAL)/" AND NOT file STREQUAL "src/complex/alpha.cpp")
      message("${file}: ${include}: PCL and CGAL stay out of libph")
      math(EXPR violations "${violations} + 1")
    endif()
    if(DEFINED may_include_${folder} AND include MATCHES "[<\"]ph/([a-z_]+)/"
       AND NOT file IN_LIST exempt)
      if(NOT CMAKE_MATCH_1 IN_LIST may_include_${folder})
        message("${file}: ${include}: ${folder} may include ${may_include_${folder}} only")
        math(EXPR violations "${violations} + 1")
      endif()
    elseif(DEFINED may_include_${folder} AND include MATCHES "[<\"]ph/[a-z_]+\\.[hi]pp"
           AND NOT file IN_LIST exempt)
      message("${file}: ${include}: ${folder} lies below the facade")
      math(EXPR violations "${violations} + 1")
    endif()
  endforeach()
endforeach()
if(checked EQUAL 0)
  message(FATAL_ERROR "found no include in ${LIBPH}: nothing was checked")
endif()
if(violations GREATER 0)
  message(FATAL_ERROR "${violations} violations in ${checked} includes")
endif()
message("${checked} includes keep to the layers")
