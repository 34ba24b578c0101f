# SPDX-License-Identifier: MIT
# ph_choice(NAME WORD DOC WORDS…): adds an option that accepts only these words; WORD is the
# default. Any other word is refused. Case does not matter, and ON, TRUE, YES and 1 mean the same,
# as everywhere in CMake.
function(ph_choice name word doc)
  set(${name} ${word} CACHE STRING "${doc}")
  set_property(CACHE ${name} PROPERTY STRINGS ${ARGN})
  string(TOUPPER "${${name}}" given)
  string(REGEX REPLACE "^(TRUE|YES|1)$" ON given "${given}")
  string(REGEX REPLACE "^(FALSE|NO|0)$" OFF given "${given}")
  if(NOT given IN_LIST ARGN)
    list(JOIN ARGN ", " words)
    message(FATAL_ERROR "${name}: found '${${name}}', expected one of ${words}")
  endif()
  set(${name} ${given} PARENT_SCOPE)
endfunction()
