// SPDX-License-Identifier: MIT
#pragma once
#include "io/bytes/input.hpp"
