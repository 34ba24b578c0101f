// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "ph/detail/report/report_file.hpp"
#include "ph/persistence.hpp"
#include "ph/run_context.hpp"

namespace ph::report {

/// The data that a page cannot derive from the positions of points: when points enter, and the
/// cells that come first. Vertices have the numbers of the input.
struct ComplexArrays {
  /// Births of the points; NaN: not a vertex. Empty: all enter together.
  std::vector<float> births;
  std::vector<std::uint32_t> edges, triangles;
  std::vector<float> edge_values, triangle_values;  ///< in ascending order
  /// Edges and triangles from these values on are left out.
  std::optional<double> missing_from, triangles_missing_from;
};

/// For a Rips complex, its first edges (from which the page finds the triangles), unless it holds
/// only a forest; for a mesh with values or an alpha complex, its first edges and all triangles, or
/// the first 2 000 000 if there are more.
/// @param form of a Rips filtration. @param count number of points. @param ids their numbers in the
/// input; empty: all are there.
/// @throws Error (resource, cancelled).
ComplexArrays complex_arrays(const AnyComplex& complex, std::optional<RipsForm> form,
                             std::size_t count, std::span<const Index> ids,
                             const RunContext& context);

/// Writes points/birth and complex/….
void add_complex(ReportFile& report, const ComplexArrays& arrays);

}  // namespace ph::report
