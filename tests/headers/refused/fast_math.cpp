// SPDX-License-Identifier: MIT
#if defined __FAST_MATH__ || __FINITE_MATH_ONLY__
#error "expected numbers that may be NaN"
#endif
