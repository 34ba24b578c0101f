// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <span>

#include "ph/detail/io/output_file.hpp"

namespace ph {

/// Writes the beginning of a file in NumPy's format 1.0, for float64 numbers in C order.
void write_npy_header(OutputFile& file, std::span<const std::size_t> shape);

/// Writes the numbers that follow the header: little endian on every machine, with -0 as 0.
void write_npy_numbers(OutputFile& file, std::span<const double> numbers);

}  // namespace ph
