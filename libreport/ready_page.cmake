# SPDX-License-Identifier: MIT
# Finds a page that was bundled elsewhere: an archive of the sources contains one for builds without
# npm or a network.

# ph_page_digest(VIEWER DIGEST): one SHA-256 of all files below VIEWER from which a page is made,
# computed from the output of `sha256sum` for these files in the order of their names.
# viewer/build.mjs writes it into the page.
function(ph_page_digest viewer digest)
  file(GLOB_RECURSE sources RELATIVE ${viewer} ${viewer}/src/*)
  list(APPEND sources build.mjs package-lock.json)
  list(SORT sources COMPARE STRING)
  set(lines "")
  foreach(source ${sources})
    file(SHA256 ${viewer}/${source} sum)
    string(APPEND lines "${sum}  ${source}\n")
  endforeach()
  string(SHA256 sum "${lines}")
  set(${digest} ${sum} PARENT_SCOPE)
endfunction()

# ph_page_belongs(PAGE DIGEST RESULT): true if PAGE exists and was made from the sources with this
# digest.
function(ph_page_belongs page digest result)
  set(${result} FALSE PARENT_SCOPE)
  if(EXISTS ${page})
    file(STRINGS ${page} stated REGEX "^<meta name=\"sources\" content=\"[0-9a-f]+\">$" LIMIT_COUNT 1)
    if(stated MATCHES "content=\"${digest}\"")
      set(${result} TRUE PARENT_SCOPE)
    endif()
  endif()
endfunction()

# The last lines of a text that are not empty, at most `most` of them.
function(ph_last_lines text most result)
  string(REGEX REPLACE "[\r\n]+" "\n" text "${text}")
  string(STRIP "${text}" text)
  set(lines "")
  foreach(line RANGE 1 ${most})
    string(FIND "${text}" "\n" place REVERSE)
    math(EXPR begin "${place} + 1")
    string(SUBSTRING "${text}" ${begin} -1 last)
    string(PREPEND lines "  ${last}\n")
    if(place LESS 0)
      break()
    endif()
    string(SUBSTRING "${text}" 0 ${place} text)
  endforeach()
  set(${result} "${lines}" PARENT_SCOPE)
endfunction()
