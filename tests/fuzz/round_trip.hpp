// SPDX-License-Identifier: MIT
#pragma once
#include "tests/fuzz/content.hpp"

namespace ph::fuzz {

// Each function writes its argument in every format that can hold it, and reads it again. It throws
// Violation if the result differs from the argument.
void write_and_read_again(const Barcode& barcode);
void write_and_read_again(const Cloud& cloud);
void write_and_read_again(const Raster& raster);
void write_and_read_again(const segment::SceneTree& scene);
/// libph does not write other types.
template <class T>
void write_and_read_again(const T&) {}

}  // namespace ph::fuzz
