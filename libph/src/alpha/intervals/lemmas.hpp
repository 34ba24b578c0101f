// SPDX-License-Identifier: MIT
#pragma once
#include "alpha/intervals/intervals.hpp"

namespace ph::alpha {

/// Asserts what the pairing stands on, in builds with assertions; does nothing in others. Each
/// simplex lies in exactly one interval, by exact signs, and has its value. No face has a larger
/// value than a coface. The Euler characteristic is 1, of all simplices and of the critical ones.
/// Not of more than 20 000 cells, for it takes ten times as long as all else.
void check_lemmas(const AlphaCells& cells);

}  // namespace ph::alpha
