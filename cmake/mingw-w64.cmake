# SPDX-License-Identifier: MIT
# Debian's cross compiler for 64-bit Windows; its programs run here under Wine. scripts/platforms.sh
# unpacks headers into PH_MINGW_ROOT.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
# This variant of the compiler uses POSIX threads; the other variant has no std::thread.
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)

set(PH_MINGW_ROOT ${CMAKE_CURRENT_LIST_DIR}/../build/mingw-root
    CACHE PATH "The folder that packages of headers were unpacked into")
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES PH_MINGW_ROOT)
set(CMAKE_FIND_ROOT_PATH ${PH_MINGW_ROOT}/usr/x86_64-w64-mingw32 ${PH_MINGW_ROOT} /usr/x86_64-w64-mingw32)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
# fmt's headers work on any system. The folder of its CMake package is named after the host.
file(GLOB fmt_DIR ${PH_MINGW_ROOT}/usr/lib/*/cmake/fmt)

# Links the compiler's libraries statically, because the programs would otherwise need the DLLs of
# these libraries.
set(CMAKE_EXE_LINKER_FLAGS_INIT -static)
set(CMAKE_CROSSCOMPILING_EMULATOR /usr/lib/wine/wine64)
