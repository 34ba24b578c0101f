// SPDX-License-Identifier: MIT
// Makes a circle of folders: bytes/ includes this file.
#include "libph/src/io/bytes/input.hpp"
