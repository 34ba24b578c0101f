// SPDX-License-Identifier: MIT
#pragma once
#include <charconv>

namespace ph {

/// What std::from_chars does with a float or a double, by strtod of the locale "C". For C++
/// libraries whose from_chars takes integers only.
/// @returns where the number ends, and std::errc{}, invalid_argument or result_out_of_range.
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
