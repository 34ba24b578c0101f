// SPDX-License-Identifier: MIT
#include <ph/persistence.hpp>
