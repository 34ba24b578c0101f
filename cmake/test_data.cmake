# SPDX-License-Identifier: MIT
# The folder of test data that are not in the repository: docs/development/test-data.md.
if(NOT DEFINED PH_TEST_DATA)
  cmake_path(SET default NORMALIZE ${PROJECT_SOURCE_DIR}/../shared)
  if(NOT IS_DIRECTORY ${default})
    set(default "")
  endif()
endif()
set(PH_TEST_DATA "${default}" CACHE PATH
    "Folder of the optional test data; without it the tests that need it are skipped")
if(NOT PH_TEST_DATA)
  message(STATUS "PH_TEST_DATA is empty: tests of real scenes, published data sets and reference "
                 "barcodes are skipped")
elseif(NOT IS_DIRECTORY "${PH_TEST_DATA}")
  message(FATAL_ERROR "PH_TEST_DATA: found no folder ${PH_TEST_DATA}; -DPH_TEST_DATA= skips the "
                      "tests that need it")
endif()
