// SPDX-License-Identifier: MIT
#include "ph/rips.hpp"
#include "ph/core/good.hpp"
