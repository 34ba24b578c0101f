// SPDX-License-Identifier: MIT
#pragma once
#include <functional>
#include <span>
#include <string_view>

#include "ph/explicit.hpp"
#include "ph/points.hpp"

namespace ph::barcode {

/// A complex of points that a program adds to the choices of --complex.
struct OwnComplex {
  std::string_view name;  ///< the name as in --complex NAME
  std::string_view what;  ///< one phrase, for --help
  /// Builds the whole complex. A threshold is applied to the bars afterwards. Vertex i of the
  /// complex is point i.
  std::function<ExplicitComplex(PointsView points, const RunContext& context)> of_points;
};

/// Adds a complex to the choices of --complex. Must be called before the command line is read.
/// @throws Error (usage) if the name is taken.
void add_complex(OwnComplex complex);

/// The complexes added so far.
std::span<const OwnComplex> own_complexes();
/// The names that --complex knows, with "auto" first.
std::span<const std::string_view> complex_names();

}  // namespace ph::barcode
