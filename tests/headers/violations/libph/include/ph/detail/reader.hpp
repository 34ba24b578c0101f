// SPDX-License-Identifier: MIT
#pragma once
#include "libph/src/io/bytes/input.hpp"
