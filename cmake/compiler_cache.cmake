# SPDX-License-Identifier: MIT
# Compiles through ccache where it is there, unless a launcher is named, an empty one too.
find_program(CCACHE ccache)
if(NOT CCACHE OR DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
  return()
endif()
# Where it cannot write to its folder, as for users without a home, it fails whatever it compiles.
file(WRITE ${CMAKE_BINARY_DIR}/CMakeFiles/cached.cpp "")
execute_process(COMMAND ${CCACHE} ${CMAKE_CXX_COMPILER} -c cached.cpp -o cached.o
                WORKING_DIRECTORY ${CMAKE_BINARY_DIR}/CMakeFiles
                RESULT_VARIABLE failed OUTPUT_QUIET ERROR_VARIABLE said)
if(failed)
  string(STRIP "${said}" said)
  message(STATUS "ccache: left out, it does not work here: ${said}")
else()
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
endif()
