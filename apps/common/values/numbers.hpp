// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace ph::app {

// Values of options as the user typed them. The parsing is strict, and the same in every locale.
// All functions throw ph::Error (usage) that names the option, what was found and what was
// expected.

/// A number; `inf` is accepted, NaN is not.
double parse_number(std::string_view option, std::string_view text);
/// Several numbers separated by commas. @param count the required number of values; 0: one or more.
std::vector<double> parse_numbers(std::string_view option, std::string_view text,
                                  std::size_t count = 0);
/// A whole number from `least` to `most`.
std::int64_t parse_integer(std::string_view option, std::string_view text, std::int64_t least,
                           std::int64_t most = INT64_MAX);
/// Several whole numbers separated by commas, at least one.
std::vector<std::int64_t> parse_integers(std::string_view option, std::string_view text,
                                         std::int64_t least, std::int64_t most = INT64_MAX);
/// A number of bytes: `4GiB`, `500MB`, `1e9`, `64k` (binary: Ki Mi Gi Ti; decimal: k M G T).
std::uint64_t parse_size(std::string_view option, std::string_view text);
/// "57 bars"
std::string count_of(std::size_t count, std::string_view what);

}  // namespace ph::app
