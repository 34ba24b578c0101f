// SPDX-License-Identifier: MIT
#include "libph/src/io/bytes/input.hpp"
