// SPDX-License-Identifier: MIT
#pragma once
#include <fmt/format.h>
#include <vector>

#include <functional>
#include <string>

#include "apps/barcode/arguments/arguments.hpp"
#include "ph/merge_tree.hpp"
#include "ph/points.hpp"

namespace ph::barcode {

/// A complex, and the facts about it that are reported to the user.
struct BuiltComplex {
  AnyComplex complex;
  std::string name;  ///< "rips", "cubical", "explicit", "lower-star", "alpha", …
  /// The threshold of its values; empty if all values are present.
  std::optional<double> threshold;
  bool empty = false;               ///< true if there are no points or cells at all
  std::string vertex_weights = {};  ///< as in BarcodeInfo
  std::optional<CubicalOptions> cubical = std::nullopt;  ///< for an image
  std::optional<BarcodeInfo::Subsample> subsample = std::nullopt;
  std::optional<BarcodeInfo::VoxelGrid> voxels = std::nullopt;  ///< for points as voxels
  std::optional<BarcodeInfo::AlphaValues> alpha = std::nullopt;
  /// Makes the same complex again, listed cube by cube, for the oracle of --check. If the function
  /// is null, the oracle uses the complex itself.
  std::function<AnyComplex(const RunContext& context)> by_definition = nullptr;
};

/// One line about the points that are not part of an alpha complex. Empty if there are no such
/// points.
std::optional<std::string> hidden_points(const BuiltComplex& built);

/// Adds the threshold and the subsample of a Rips complex, which are known only once the complex is
/// built.
void take_facts(BuiltComplex& built, const RunFacts& facts);
/// One line about the accuracy of an approximation or a subsample. Empty if the complex is neither.
std::optional<std::string> promise_of(const BuiltComplex& built, const RunFacts& facts);

/// The merge tree of all points. Empty if the complex was sampled, approximated or cut off, or if
/// report::whole_tree returns none. @throws Error (resource, cancelled).
std::optional<MergeTree> tree_of(const BuiltComplex& built, const RunContext& context);

/// Calls `work`. If `work` throws an error of kind bad_data, puts the name of the input before the
/// message. Data may be wrong in ways that no reader can detect. Examples are a point without a
/// direction, and distances that overflow. @throws Error (bad_data) "name: …"; other errors
/// unchanged.
template <class Work>
decltype(auto) in_name_of(const std::string& name, Work&& work) {
  try {
    return work();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::bad_data) throw;
    throw Error(error.kind(), fmt::format("{}: {}", mark_place(name), error.marked()));
  }
}

/// Chooses the complex that the arguments request, or otherwise the complex that suits the data. A
/// Rips complex refers to the points of the input, which must live as long as the complex.
/// @param name the name of the input, for messages. @param dropped the number of points of the
/// input that were left out.
/// @throws Error (usage) if an option does not fit the data; Error (bad_data) "name: …".
BuiltComplex build_complex(ReadResult&& input, const std::string& name, std::size_t dropped,
                           const Job& job, const RunContext& context);
/// Does the same for data that are needed again. The complex gets a copy of the data where it must
/// own them.
BuiltComplex build_complex(const ReadResult& input, const std::string& name, std::size_t dropped,
                           const Job& job, const RunContext& context);

/// The alpha complex of points, or another complex of their Delaunay triangulation.
/// @param weights one weight for each point, or none. @param ids the numbers of the points in the
/// input; if empty, they are the indices of the points.
/// @throws Error (usage) if an option does not fit the points; Error (bad_data).
BuiltComplex build_alpha(const Points& points, std::vector<double> weights,
                         const std::vector<Index>& ids, const std::string& name, const Job& job,
                         const RunContext& context);

}  // namespace ph::barcode
