// SPDX-License-Identifier: MIT
#include "io/bytes/input.hpp"
