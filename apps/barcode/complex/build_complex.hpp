// SPDX-License-Identifier: MIT
#pragma once
#include <fmt/format.h>

#include <functional>
#include <string>

#include "barcode/arguments/arguments.hpp"
#include "ph/merge_tree.hpp"

namespace ph::barcode {

/// A complex with what the user is told about it.
struct BuiltComplex {
  AnyComplex complex;
  std::string name;                 ///< "rips", "cubical", "explicit", "lower-star", "alpha", …
  std::optional<double> threshold;  ///< that its values obey; nothing: all are there
  bool empty = false;               ///< there are no points or cells at all
  // As in BarcodeInfo.
  std::string vertex_weights = {};
  std::string metric = {};
  std::optional<CubicalOptions> cubical = std::nullopt;  ///< of an image
  std::optional<BarcodeInfo::Subsample> subsample = std::nullopt;
  std::optional<BarcodeInfo::VoxelGrid> voxels = std::nullopt;  ///< of points
  std::optional<BarcodeInfo::AlphaValues> alpha = std::nullopt;
  /// The same image listed cube by cube, which the oracle of --check takes; null: it takes the
  /// complex itself.
  std::function<AnyComplex(const RunContext& context)> by_definition = nullptr;
};

/// The points of an alpha complex that have no part in it, one line; nothing if all have.
std::optional<std::string> hidden_points(const BuiltComplex& built);

/// Gives a Rips complex, which is known once it is built as planned, its threshold and subsample.
void take_facts(BuiltComplex& built, const RunFacts& facts);
/// What an approximation or a subsample is worth, one line; nothing if there is none.
std::optional<std::string> promise_of(const BuiltComplex& built, const RunFacts& facts);

/// The merge tree of all points. Nothing where the complex was sampled, approximated or cut, and
/// where report::whole_tree has none. @throws Error (resource, cancelled).
std::optional<MergeTree> tree_of(const BuiltComplex& built, const RunContext& context);

/// Calls `work`. Data may be wrong in a way that no reader can know, such as a point without
/// direction or distances that overflow. @throws Error (bad_data) "name: …"; others as they are.
template <class Work>
decltype(auto) in_name_of(const std::string& name, Work&& work) {
  try {
    return work();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::bad_data) throw;
    throw Error(error.kind(), fmt::format("{}: {}", mark_place(name), error.marked()));
  }
}

/// Chooses the complex that the arguments ask for, or the one that suits the data. A Rips complex
/// refers to the points of the input, which stay as long as it has its input.
/// @param name of the input, for messages. @param dropped how many points were left out of it.
/// @throws Error (usage) if an option does not fit the data; Error (bad_data) "name: …".
BuiltComplex build_complex(ReadResult&& input, const std::string& name, std::size_t dropped,
                           const Arguments& arguments, const RunContext& context);
/// The same from data that are needed again.
BuiltComplex build_complex(const ReadResult& input, const std::string& name, std::size_t dropped,
                           const Arguments& arguments, const RunContext& context);

}  // namespace ph::barcode
