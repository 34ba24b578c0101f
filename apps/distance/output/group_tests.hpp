// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <vector>

#include "apps/distance/arguments/arguments.hpp"
#include "apps/distance/data/groups.hpp"
#include "apps/distance/data/pairs.hpp"
#include "ph/detail/io/output_file.hpp"

namespace ph::distance_program {

/// Tests in each dimension whether the groups differ.
/// @throws Error (bad_data) on an infinite distance, with the names of both barcodes; Error
///     (cancelled).
std::vector<PermutationTest> tests_of(const PairDistances& distances, const Groups& groups,
                                      const std::vector<Barcode>& barcodes,
                                      const std::vector<std::string>& inputs,
                                      const Arguments& arguments, const RunContext& context);

/// Writes the tests, one for each dimension. In JSON, the distances are also written.
void write_tests(OutputFile& file, const std::vector<PermutationTest>& tests,
                 const PairDistances& distances, const Groups& groups,
                 const std::vector<std::string>& inputs, const Arguments& arguments);

}  // namespace ph::distance_program
