// SPDX-License-Identifier: MIT
#include "ph/engine/registry.hpp"
#include "ph/complex/explicit.hpp"
