// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <span>
#include <string>
#include <vector>

#include "apps/common/distances/distance_choice.hpp"
#include "ph/detail/io/output_file.hpp"

namespace ph::distance_program {

/// The matching of the bars of one dimension.
struct DimMatching {
  int dim;
  std::array<std::span<const Bar>, 2> bars;
  app::DiagramMatching matching;
};

/// Writes all pairs, the ends of their bars, and the cost of each pair, which is its distance in
/// the ground norm. If a bar is paired with the diagonal, its partner is the nearest point of the
/// diagonal.
void write_matching(OutputFile& file, std::span<const DimMatching> matchings, bool is_json,
                    const app::DistanceChoice& choice, const std::vector<std::string>& inputs);

}  // namespace ph::distance_program
