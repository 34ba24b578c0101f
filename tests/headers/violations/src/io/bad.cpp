// SPDX-License-Identifier: MIT
#include "ph/engine/generic_engines.hpp"
#include "ph/complex/explicit.hpp"
