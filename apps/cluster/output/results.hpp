// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <string>
#include <vector>

#include "apps/cluster/arguments/arguments.hpp"
#include "apps/cluster/data/load.hpp"
#include "ph/cluster_tree.hpp"
#include "ph/detail/io/output_file.hpp"

namespace ph::cluster {

/// The label of a point that was left out because of a NaN, as in scikit-learn.
inline constexpr Index kLeftOut = -3;

/// The results, as files state them.
struct Results {
  const Arguments& arguments;
  const Loaded& loaded;
  Index neighbours = 0;
  const ClusterTree& tree;
  Clusters clusters;
  std::vector<double> outlier_scores = {};  ///< empty unless scores are requested
};

/// Values for all points of the input, from values for those points that were not left out.
template <class T>
std::vector<T> for_all_rows(std::span<const T> values, const Loaded& loaded, T left_out) {
  const std::vector<Index>& rows = loaded.read.point_ids;
  if (loaded.rows == loaded.points) return {values.begin(), values.end()};
  std::vector<T> all(static_cast<std::size_t>(loaded.rows), left_out);
  for (std::size_t i = 0; i < values.size(); ++i)
    all[static_cast<std::size_t>(rows[i])] = values[i];
  return all;
}

/// By cluster of the tree: the label of the cluster, or -1 if it is not chosen.
std::vector<Index> labels_of_clusters(const Results& results);

/// The members of a JSON file that say what was computed, from "format" to "min_size", without the
/// brace at the end.
std::string json_head(const Results& results, std::string_view format);

/// Writes an array of JSON in pieces, because its text may be larger than all other data.
/// @param text_of the text of a value.
template <class T, class TextOf>
void write_array(OutputFile& file, std::span<const T> values, TextOf&& text_of) {
  file.write("[");
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0) file.write(", ");
    file.write(text_of(values[i]));
  }
  file.write("]");
}

/// Writes the label of each point, and its scores if they are requested.
void write_labels(OutputFile& file, const Results& results);

/// Writes the clusters of the tree. @param is_csv JSON otherwise.
void write_tree(OutputFile& file, const Results& results, bool is_csv);

}  // namespace ph::cluster
