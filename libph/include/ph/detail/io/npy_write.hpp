// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "ph/detail/io/output_file.hpp"

namespace ph {

/// Writes the beginning of a file in NumPy's format 1.0, in C order.
/// @param type "<f8" for float64, "<i8" for int64.
void write_npy_header(OutputFile& file, std::span<const std::size_t> shape,
                      std::string_view type = "<f8");

/// Writes the numbers that follow the header: little endian on every machine, with -0 as 0.
void write_npy_numbers(OutputFile& file, std::span<const double> numbers);
void write_npy_numbers(OutputFile& file, std::span<const std::int64_t> numbers);

}  // namespace ph
