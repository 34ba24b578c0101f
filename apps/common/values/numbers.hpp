// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace ph::app {

// Functions that read values of options as the user typed them. The parsing is strict, and the same
// in every locale. All functions throw ph::Error (usage), which names the option, what was found
// and what was expected.

/// A number. `inf` is accepted, but NaN is not.
double parse_number(std::string_view option, std::string_view text);
/// Several numbers separated by commas. @param count the required number of values; 0 means one or
/// more. @param hint advice for a text that is not a list of numbers.
std::vector<double> parse_numbers(std::string_view option, std::string_view text,
                                  std::size_t count = 0, std::string_view hint = {});
/// A whole number from `least` to `most`.
std::int64_t parse_integer(std::string_view option, std::string_view text, std::int64_t least,
                           std::int64_t most = INT64_MAX);
/// One or more whole numbers separated by commas.
std::vector<std::int64_t> parse_integers(std::string_view option, std::string_view text,
                                         std::int64_t least, std::int64_t most = INT64_MAX);
/// A number of bytes, such as `4GiB`, `500MB`, `1e9` or `64k`. Binary units are Ki Mi Gi Ti, and
/// decimal units are k M G T.
std::uint64_t parse_size(std::string_view option, std::string_view text);
/// Returns a text such as "57 bars".
std::string count_of(std::size_t count, std::string_view what);

}  // namespace ph::app
