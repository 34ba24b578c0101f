// SPDX-License-Identifier: MIT
#include "ph/complex/rips.hpp"
#include "ph/core/good.hpp"
