# SPDX-License-Identifier: MIT
# Tests options with several words: synonyms mean the same, and the last word here is refused.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/../../cmake/choice.cmake)

foreach(given auto Auto AUTO on TRUE yes 1 off False NO 0)
  set(PH_WITH_IT ${given})
  ph_choice(PH_WITH_IT AUTO "It" AUTO ON OFF)
  list(APPEND taken ${PH_WITH_IT})
endforeach()
if(NOT taken STREQUAL "AUTO;AUTO;AUTO;ON;ON;ON;ON;OFF;OFF;OFF;OFF")
  message(FATAL_ERROR "taken as ${taken}")
endif()
set(PH_WITH_IT maybe)
ph_choice(PH_WITH_IT AUTO "It" AUTO ON OFF)
