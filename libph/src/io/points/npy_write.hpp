// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <span>

#include "ph/detail/io/output_file.hpp"

namespace ph {

/// The beginning of a file of NumPy's format 1.0 with float64 numbers in C order.
void write_npy_header(OutputFile& file, std::span<const std::size_t> shape);

/// The numbers that follow it: little endian on every machine, -0 as 0.
void write_npy_numbers(OutputFile& file, std::span<const double> numbers);

}  // namespace ph
