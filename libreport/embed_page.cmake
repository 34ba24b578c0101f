# SPDX-License-Identifier: MIT
# cmake -DPAGE=FILE.html -DCODE=FILE.cpp -P embed_page.cmake: writes the template as a C++ string,
# which is empty without PAGE. The template is one raw string, because compilers read it faster than
# an array of numbers, and no character needs an escape.
set(delimiter "ph_page")
set(text "")
if(PAGE)
  file(READ "${PAGE}" text)
  foreach(unfit ")${delimiter}\"" "\r")
    string(FIND "${text}" "${unfit}" place)
    if(NOT place EQUAL -1)
      message(FATAL_ERROR "${PAGE}: found '${unfit}', which a raw string cannot hold")
    endif()
  endforeach()
endif()
file(WRITE "${CODE}" "// Generated from ${PAGE}; do not edit.
#include \"ph/detail/report/page_template.hpp\"

namespace ph::report {

std::string_view page_template() {
  using namespace std::string_view_literals;
  return R\"${delimiter}(${text})${delimiter}\"sv;
}

}  // namespace ph::report
")
