// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <string_view>
#include <vector>

#include "ph/barcode.hpp"

namespace ph::vectors {

/// The largest allowed number: larger numbers could overflow in squares and sums.
inline constexpr double kLargest = 1e100;
/// The largest allowed coordinate of a frame that is fitted to bars.
inline constexpr double kLargestPixel = 4 * kLargest;

/// @throws Error (bad_data) on a NaN, a death before its birth, or a finite number that is too
///         large. @param function the name of the calling function, for messages.
void check_bar(const Bar& bar, std::string_view function);

enum class Ends { finite, any_death, any };

/// The bars that count: bars longer than 0.
/// @throws Error (bad_data) as `check_bar`, and on a bar with ends that are not allowed.
std::vector<Bar> checked_bars(std::span<const Bar> bars, Ends allowed, std::string_view function);

/// @throws Error (usage) if an output does not have the expected size.
void check_size(std::span<const double> out, std::size_t expected, std::string_view function);

/// @throws Error (usage) unless `power` is finite and at least 0.
void check_power(double power, std::string_view function);

/// @throws Error (usage) unless `number` is finite and more than 0.
void check_positive(double number, std::string_view name, std::string_view function);

}  // namespace ph::vectors
