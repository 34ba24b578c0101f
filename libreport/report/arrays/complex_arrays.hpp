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

/// The data that a page cannot derive from the positions of points. They are the values at which
/// the points enter, and the first cells. Vertices have the numbers of the input.
struct ComplexArrays {
  /// The birth of each point; NaN if the point is not a vertex. Empty if all points enter together.
  std::vector<float> births;
  std::vector<std::uint32_t> edges, triangles;
  std::vector<float> edge_values, triangle_values;  ///< in ascending order
  /// The least value of an edge, and of a triangle, that is left out; empty if none is left out.
  std::optional<double> missing_from, triangles_missing_from;
};

/// The cells of a complex that a page shows. For a Rips complex, these are its first edges, from
/// which the page finds the triangles. A Rips complex that has only a forest has no cells on the
/// page. For a mesh with values or an alpha complex, they are its first edges and its first 2 000
/// 000 triangles.
/// @param form the form of the Rips filtration; ignored for other complexes.
/// @param count the number of points. @param ids the numbers of the points in the input; empty if
/// the input has no other points.
/// @throws Error (resource, cancelled).
ComplexArrays complex_arrays(const AnyComplex& complex, std::optional<RipsForm> form,
                             std::size_t count, std::span<const Index> ids,
                             const RunContext& context);

/// Writes points/birth and complex/….
void add_complex(ReportFile& report, const ComplexArrays& arrays);

}  // namespace ph::report
