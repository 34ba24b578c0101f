// SPDX-License-Identifier: MIT
#pragma once
#include <functional>
#include <string>

#include "barcode/arguments/arguments.hpp"

namespace ph::barcode {

/// A complex with what the user is told about it.
struct BuiltComplex {
  AnyComplex complex;
  std::string name;                 ///< "rips", "cubical", "explicit", "lower-star", "alpha", …
  std::optional<double> threshold;  ///< that its values obey; nothing: all are there
  bool empty = false;               ///< there are no points or cells at all
  /// A threshold that has to be applied to the bars, because the complex holds larger values too.
  std::optional<double> cut;
  // As in BarcodeInfo.
  std::string vertex_weights = {};
  std::string metric = {};
  std::optional<CubicalOptions> cubical = std::nullopt;  ///< of an image
  std::optional<BarcodeInfo::Subsample> subsample = std::nullopt;
  std::optional<BarcodeInfo::VoxelGrid> voxels = std::nullopt;  ///< of points
  std::optional<std::string> promise = std::nullopt;  ///< what an approximation is worth, one line
  std::optional<BarcodeInfo::AlphaValues> alpha = std::nullopt;
  /// The same complex made by another path, for the oracle of --check; null: there is none.
  std::function<AnyComplex(const RunContext& context)> by_definition = nullptr;
};

/// The points of an alpha complex that have no part in it, one line; nothing if all have.
std::optional<std::string> hidden_points(const BuiltComplex& built);

/// Builds the complex that the arguments ask for, or the one that suits the data.
/// @param name of the input, for messages. @param dropped how many points were left out of it.
/// @throws Error (usage) if an option does not fit the data; Error (bad_data) "name: …".
BuiltComplex build_complex(ReadResult&& input, const std::string& name, std::size_t dropped,
                           const Arguments& arguments, const RunContext& context);
/// The same from data that are needed again.
BuiltComplex build_complex(const ReadResult& input, const std::string& name, std::size_t dropped,
                           const Arguments& arguments, const RunContext& context);

}  // namespace ph::barcode
