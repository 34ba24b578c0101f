// SPDX-License-Identifier: MIT
#pragma once
#include <charconv>

namespace ph {

/// Does the same as std::from_chars for a float or a double, but uses strtod in the locale "C". It
/// is needed for C++ libraries whose from_chars supports only integers.
/// @returns the end of the number, and std::errc{}, invalid_argument or result_out_of_range.
std::from_chars_result floating_by_strtod(const char* first, const char* last, float& value);
std::from_chars_result floating_by_strtod(const char* first, const char* last, double& value);

/// std::from_chars for a float or a double, with any C++ library.
template <class T>
std::from_chars_result floating_from_chars(const char* first, const char* last, T& value) {
  if constexpr (requires { std::from_chars(first, last, value); })
    return std::from_chars(first, last, value);
  else
    return floating_by_strtod(first, last, value);
}

}  // namespace ph
