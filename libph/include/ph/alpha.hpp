// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ph/barcode.hpp"
#include "ph/detail/core/names.hpp"
#include "ph/explicit.hpp"
#include "ph/points.hpp"
#include "ph/run_context.hpp"

// The constructor of Alpha and the function alpha_support are in a separate library, ph::alpha.
// That library uses CGAL's triangulations, which are under the GNU General Public License. A
// program that links ph::alpha is therefore under that licence as well. Everything else is in
// ph::core.

namespace ph {

namespace alpha {
struct AlphaCells;
}

/// Name and version of the triangulation library. Empty if libph was built without one; the
/// constructor of Alpha then throws Error (not_built_in).
std::string alpha_support();

/// The settings of an alpha complex.
struct AlphaOptions {
  /// One weight per point, or no weights. A weight is the square of the radius that the point's
  /// ball has when the filtration's radius is 0. The power distance |x - p|² - w replaces the
  /// squared distance.
  std::vector<double> weights = {};
  /// For a periodic space: for each axis, the length after which the axis closes up, or 0 if it
  /// does not close up. If empty, no axis closes up. Points may lie anywhere; coordinates are taken
  /// modulo the lengths.
  std::vector<double> period = {};
  /// The condition under which a simplex of the triangulation enters, in terms of radii.
  enum class Value {
    alpha,  ///< the balls around its vertices, each cut to its Voronoi cell, meet
    /// the balls around its vertices meet; the bars are the same as with `alpha`, but the cells may
    /// differ
    delaunay_cech,
    delaunay_rips,  ///< all pairs of these balls meet: the value is half the longest edge
  } value = Value::alpha;
  /// The unit of values. Weighted points require `squared`, because their values may be negative.
  enum class Unit {
    radius,   ///< radius of the balls
    squared,  ///< square of that radius
  } unit = Unit::radius;
  double threshold = kInfinity;  ///< simplices with larger values are left out
};

template <>
inline constexpr std::array names_of<AlphaOptions::Value>{
    Named{AlphaOptions::Value::alpha, "alpha"},
    Named{AlphaOptions::Value::delaunay_cech, "delaunay-cech"},
    Named{AlphaOptions::Value::delaunay_rips, "delaunay-rips"},
};

template <>
inline constexpr std::array names_of<AlphaOptions::Unit>{
    Named{AlphaOptions::Unit::radius, "radius"},
    Named{AlphaOptions::Unit::squared, "squared"},
};

/// The alpha complex of points in R³, R² or R¹: the simplices of their Delaunay triangulation. A
/// simplex enters when the balls around its vertices, each cut to the Voronoi cell of its centre,
/// meet. The bars describe the growing union of these balls. Births and deaths are radii, which are
/// half as large as the corresponding diameters.
///
/// Any finite points are allowed. Coplanar and collinear points are triangulated in their affine
/// hull. If several points are equal, an edge of value 0 joins each copy to the first of them;
/// weighted copies are hidden instead. libph decides exactly which simplices exist and which values
/// are equal. The values themselves have rounding errors in the last few places, and no face has a
/// larger value than its cofaces. (Radii below 1e-150 or beyond 1e150 times the largest coordinate
/// are less precise.) Cospherical points have several triangulations; the choice depends on their
/// coordinates alone, not on their order.
///
/// Kinds of value other than `alpha` require points without weights. With these kinds, engines for
/// any filtration compute the bars simplex by simplex, which takes several times as long.
///
/// In a periodic space the balls grow in a torus, or in a cylinder if not all axes close up. Any
/// number of points is allowed, even one. A cell is still named by its points. One point may occur
/// several times in a cell (the edge from a point to its own periodic image is [v, v]), and two
/// cells may have the same points. Along axes that close up, coordinates and lengths are rounded to
/// multiples of a power of two, which is at most 2^-50 of the diagonal of the box. Translates are
/// therefore equal to the last bit. Numbers that already are such multiples do not change. Points
/// that are the same modulo the lengths are copies. The final complex of a three-dimensional torus
/// has the Betti numbers 1, 3, 3, 1; for a two-dimensional torus, they are 1, 2, 1.
///
/// The filtration stores the triangulation in about 110 bytes per tetrahedron. Engines for any
/// filtration need the individual simplices, which are made once: by `prepare`, or when a cell is
/// first requested. The order of the cells is (value, dimension, vertices along a space-filling
/// curve, last vertex first).
class Alpha {
 public:
  using Cell = ExplicitComplex::Cell;
  static constexpr bool first_equal_cofacet_is_oldest =
      ExplicitComplex::first_equal_cofacet_is_oldest;

  /// O(n log n) for evenly spread points, O(n²) in the worst case. Everything except the
  /// triangulation uses several threads.
  /// @param context must outlive the filtration.
  /// @throws Error (usage) on points in R⁴ or a higher dimension; if the number of weights is not
  ///         the number of points; on Unit::radius, or kinds of value other than `alpha`, for
  ///         weighted points; on a threshold that is NaN; on lengths that are negative, not finite
  ///         or not one per axis; and on kinds of value other than `alpha` in a periodic space.
  ///         Error (bad_data) on numbers that are not finite, on coordinates whose magnitudes
  ///         differ too much for their squares to be doubles, and, for squared values, on
  ///         coordinates whose square is not a double. Error (resource, cancelled, not_built_in).
  explicit Alpha(PointsView points, const AlphaOptions& options = {},
                 const RunContext& context = default_context());

  /// The points that are not part of the complex, ascending. Other points with large weights
  /// outweigh a hidden point everywhere.
  std::span<const std::uint32_t> hidden() const;
  /// Points that are equal to an earlier point, ascending; empty if points are weighted.
  std::vector<Index> copies() const;
  /// Number of simplices by dimension, including simplices beyond the threshold and the edges that
  /// join copies.
  std::vector<std::size_t> simplex_counts() const;

  /// Makes all simplices, unless they exist. The simplices take about 5 kB per point in R³, and the
  /// filtration keeps them. Thread-safe. @throws Error (resource) and (cancelled).
  void prepare(const RunContext& context) const;
  /// This complex as a list of simplices, in the form that other parts of libph use. The list is
  /// made by `prepare` or by the first call. Its values are squared radii, scaled by a power of
  /// two.
  const ExplicitComplex& listed() const;

  int top_dim() const { return top_dim_; }
  double value(Cell c) const { return to_value(listed().value(c)); }
  std::uint32_t key(Cell c) const { return listed().key(c); }
  static bool precedes(Cell a, Cell b) { return ExplicitComplex::precedes(a, b); }
  std::size_t slot_count() const { return listed().slot_count(); }
  static std::size_t slot(Cell c) { return ExplicitComplex::slot(c); }
  /// False in a periodic space, where an edge may be a loop.
  bool edges_join_vertices() const { return !is_periodic(); }
  static CellKind cell_kind() { return CellKind::vertices; }
  /// In a periodic space a point may occur several times.
  void append_input_cell(int dim, Cell cell, std::vector<Index>& numbers) const;
  /// Number of points of the input, including points that are not in the complex.
  std::size_t vertex_count() const;
  /// The number of the input point that a vertex stands for.
  std::size_t vertex_number(Cell vertex) const;
  template <class Visit>
  void for_each_cell(int dim, Visit&& visit) const {
    listed().for_each_cell(dim, visit);
  }
  template <class Visit>
  void for_each_facet(int dim, Cell cell, Visit&& visit) const {
    listed().for_each_facet(dim, cell, visit);
  }
  template <class Visit>
  void for_each_cofacet(int dim, Cell cell, Visit&& visit) const {
    listed().for_each_cofacet(dim, cell, visit);
  }

  /// The triangulation with its intervals, for engines.
  const alpha::AlphaCells& cells() const { return *cells_; }
  /// Converts a squared radius of the triangulation into a value of this filtration.
  double to_value(double squared_radius) const;
  double threshold() const { return threshold_; }
  AlphaOptions::Value value_kind() const { return kind_; }
  AlphaOptions::Unit unit() const { return unit_; }
  bool is_weighted() const;
  /// True if an axis closes up.
  bool is_periodic() const;

 private:
  struct Lazy;

  std::shared_ptr<const alpha::AlphaCells> cells_;
  std::shared_ptr<Lazy> lazy_;
  AlphaOptions::Unit unit_;
  AlphaOptions::Value kind_;
  double threshold_;
  int top_dim_ = -1;
};

/// Triangles on the surface of a set of simplices; each triangle is given by its points.
struct SurfaceMesh {
  std::vector<std::array<Index, 3>> triangles;
  /// The first `regular` triangles have a tetrahedron on exactly one side, and are counterclockwise
  /// as seen from the other side. The remaining triangles are *singular*: they have no tetrahedron
  /// on either side. For points in a plane, all triangles count as regular.
  std::size_t regular = 0;
};

/// The surface of all simplices with values up to `value`, in the unit of the complex; the
/// threshold of the complex is ignored. These simplices form a polyhedron that is homotopy
/// equivalent to the union of the balls. For points in a plane, the result has all triangles with
/// values up to `value`, counterclockwise if the points are in R². O(triangles · log). @throws
/// Error (usage) on NaN, on kinds of value other than `alpha`, and in a periodic space, because
/// there a corner of a triangle may be a periodic image of a point.
SurfaceMesh alpha_shape(const Alpha& alpha, double value);

/// The surface of the wrap complex (Edelsbrunner, Surface reconstruction by wrapping finite sets in
/// space, 2003): the critical simplices up to a value, and all simplices below them in the order of
/// the gradient. The alpha complex collapses onto the wrap complex; the two are therefore homotopy
/// equivalent. O(tetrahedra). @throws Error (usage) as alpha_shape; Error (resource, cancelled).
SurfaceMesh wrap(const Alpha& alpha, double value, const RunContext& context = default_context());

}  // namespace ph
