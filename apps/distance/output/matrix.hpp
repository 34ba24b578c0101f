// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <vector>

#include "distance/data/pairs.hpp"
#include "ph/detail/io/output_file.hpp"

namespace ph::distance_program {

/// Writes the distances of the only dimension as a square: NPY, or CSV with the names of the
/// inputs.
void write_matrix(OutputFile& file, const PairDistances& distances, bool is_npy,
                  const std::vector<std::string>& inputs);

}  // namespace ph::distance_program
