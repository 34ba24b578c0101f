# SPDX-License-Identifier: MIT
# Compiles through ccache if it is installed, unless a launcher is set, which may be empty.
find_program(CCACHE ccache)
if(NOT CCACHE OR DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
  return()
endif()
# If ccache cannot write to its folder, for example for users without a home directory, every
# compilation fails.
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
