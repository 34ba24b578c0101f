// SPDX-License-Identifier: MIT
#include "ph/detail/generic_engines.hpp"
#include "ph/explicit.hpp"
