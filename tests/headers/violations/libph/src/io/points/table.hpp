// SPDX-License-Identifier: MIT
// Makes two folders include each other: a file in bytes/ includes this file.
#include "libph/src/io/bytes/input.hpp"
