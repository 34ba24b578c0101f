// SPDX-License-Identifier: MIT
#include "libph/src/io/points/table.hpp"
