# SPDX-License-Identifier: MIT
# Compiles through ccache if it is installed and no launcher is set. An empty launcher also counts
# as set.
find_program(CCACHE ccache)
if(NOT CCACHE OR DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
  return()
endif()
# Tries ccache first: if it cannot write to its folder, for example because the user has no home
# directory, every compilation would fail.
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
