// SPDX-License-Identifier: MIT
// A circle of folders: bytes/ includes this file.
#include "libph/src/io/bytes/input.hpp"
