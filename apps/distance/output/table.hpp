// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "apps/distance/arguments/arguments.hpp"
#include "apps/distance/data/pairs.hpp"
#include "ph/detail/io/output_file.hpp"

namespace ph::distance_program {

/// The columns that describe a distance, and their cells.
inline constexpr std::string_view kChoiceColumns = "distance,order,ground,directions";
std::string choice_cells(const app::DistanceChoice& choice);
/// The members of a document that state its format and its distance, without braces.
/// @param format the name of the format.
std::string document_members(std::string_view format, const app::DistanceChoice& choice,
                             const std::vector<std::string>& inputs);
/// The first line of text, such as "bottleneck distance (…) of a.csv and b.csv".
std::string heading(const app::DistanceChoice& choice, const std::vector<std::string>& inputs);

/// Writes the distances by dimension, then in the order of the inputs.
void write_distances(OutputFile& file, const PairDistances& distances,
                     const std::vector<Barcode>& barcodes, const std::vector<std::string>& inputs,
                     const Arguments& arguments);

/// Writes the distances of the only dimension as a square, in NPY or in CSV with the names of the
/// inputs.
void write_matrix(OutputFile& file, const PairDistances& distances, bool is_npy,
                  const std::vector<std::string>& inputs);

/// Writes the distances as the member "distances": […] of a JSON document.
void write_distance_rows(OutputFile& file, const PairDistances& distances);

}  // namespace ph::distance_program
