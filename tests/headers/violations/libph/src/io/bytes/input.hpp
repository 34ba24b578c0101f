// SPDX-License-Identifier: MIT
#include "io/points/table.hpp"
