# SPDX-License-Identifier: MIT
# Sets PH_FMT, the target to link for fmt, to a static library. It is built here, because Debian has
# fmt only as a shared library and as headers.
add_library(ph_fmt STATIC ${CMAKE_CURRENT_LIST_DIR}/fmt_functions.cpp)
ph_position_independent(ph_fmt)
target_compile_options(ph_fmt PRIVATE ${PH_EXACT} -w -ffunction-sections -fkeep-inline-functions $<$<CONFIG:Release>:-O2>)
target_link_libraries(ph_fmt PRIVATE fmt::fmt-header-only)
set(PH_FMT $<BUILD_INTERFACE:ph_fmt> $<INSTALL_INTERFACE:fmt::fmt>)
