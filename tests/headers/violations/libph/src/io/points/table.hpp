// SPDX-License-Identifier: MIT
// A circle of folders: bytes/ includes this file.
#include "io/bytes/input.hpp"
