# SPDX-License-Identifier: MIT
# Debian's cross compiler for 64-bit ARM; its programs run here under QEMU. scripts/platforms.sh
# unpacks the libraries into PH_AARCH64_ROOT.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)

set(PH_AARCH64_ROOT ${CMAKE_CURRENT_LIST_DIR}/../build/aarch64-root
    CACHE PATH "The folder that packages for arm64 were unpacked into")
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES PH_AARCH64_ROOT)
set(CMAKE_FIND_ROOT_PATH ${PH_AARCH64_ROOT} /usr/aarch64-linux-gnu)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)

# -L names the folder with the dynamic linker and the C++ library of the other processor.
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64-static -L /usr/aarch64-linux-gnu)
