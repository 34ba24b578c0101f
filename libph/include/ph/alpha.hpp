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
#include "ph/explicit.hpp"
#include "ph/points.hpp"
#include "ph/run_context.hpp"

// The constructor of Alpha, and alpha_support, are in a library of their own, ph::alpha. It uses
// triangulations of CGAL, which are under the GNU General Public License: so is a program that
// links it. All else is in ph::core.

namespace ph {

namespace alpha {
struct AlphaCells;
}

/// What triangulates, by name and version; empty if nothing does: then the constructor of Alpha
/// throws Error (not_built_in).
std::string alpha_support();

/// What an alpha complex is made of.
struct AlphaOptions {
  /// One for each point, or none: the square of a ball's radius where that is 0 at first. The power
  /// distance |x - p|² - w takes the place of the square of the distance.
  std::vector<double> weights = {};
  /// Of a periodic space: the length of each axis after which it closes up, or 0 of one that does
  /// not. None: no axis does. Points may lie anywhere; coordinates are taken modulo the lengths.
  std::vector<double> period = {};
  /// What is asked of a simplex of the triangulation, in radii.
  enum class Value {
    alpha,  ///< that its balls meet, each cut to its Voronoi cell
    /// that its balls meet. The bars are those of `alpha`, the cells may be others.
    delaunay_cech,
    delaunay_rips,  ///< that each two of its balls meet: half its longest edge
  } value = Value::alpha;
  /// Of what values are. Those of weighted points may be negative: `squared` only.
  enum class Unit {
    radius,   ///< the radius of the balls
    squared,  ///< its square
  } unit = Unit::radius;
  double threshold = kInfinity;  ///< largest value that enters, inclusive
};

/// The alpha complex of points of R², R³ (or R¹): the simplices of their Delaunay triangulation. A
/// simplex enters when the balls around its vertices, each cut to the Voronoi cell of its centre,
/// meet. Its bars are those of the union of balls of that radius, which is why they are half as
/// long as those of edges.
///
/// Any finite points will do. Coplanar and collinear ones have the triangulation of their affine
/// hull. A copy is joined to the first of its kind by an edge of value 0, or hidden, of weighted
/// points. Which simplices there are and which values are equal is decided exactly; values have an
/// error of some last places, and no face has a larger one than a coface. (Radii below
/// 1e-150 or beyond 1e150 times the largest coordinate are less precise.) Among
/// cospherical points some triangulation is taken that depends on where they are alone, not on
/// their order.
///
/// Other values than alpha are for points without weights, and are computed simplex by simplex, by
/// engines for any filtration: they take several times as long.
///
/// In a periodic space the balls grow around a torus, or around a cylinder if not all axes close
/// up. Any number of points will do, one as well. A cell is known by its points all the same,
/// though it may have one of them several times (an edge of a point with its own image is [v, v])
/// and two cells may have the same ones. Coordinates of axes that close up, and their lengths, are
/// rounded to multiples of a power of two, at most 2^-50 of the diagonal of the box, so that
/// translates are the same to the last bit; numbers that are such multiples stay what they are.
/// Points that are the same modulo the lengths are copies. On a torus the complex ends with the
/// Betti numbers 1, 3, 3, 1, in the plane 1, 2, 1.
///
/// Holds the triangulation: about 110 bytes a tetrahedron. What generic engines need, each simplex
/// by itself, is made once, by `prepare` or else when a cell is first asked for. Order: (value,
/// dimension, vertices in an order of space, the last one first).
class Alpha {
 public:
  using Cell = ExplicitComplex::Cell;
  static constexpr bool first_equal_cofacet_is_oldest =
      ExplicitComplex::first_equal_cofacet_is_oldest;

  /// O(n log n) for points that lie evenly, O(n²) at worst. On threads, but for the triangulation.
  /// @param context outlives the filtration.
  /// @throws Error (usage) on points of R^4 or beyond, weights that are not one a point, and radii
  ///         or other values of weighted points; on lengths that are not one an axis, negative or
  ///         not finite, and other values in a periodic space; Error (bad_data) on numbers that are
  ///         not finite, on coordinates whose magnitudes differ beyond what doubles can square, and
  ///         of squared values on coordinates of which no double can be the square; Error
  ///         (resource, cancelled, not_built_in).
  explicit Alpha(PointsView points, const AlphaOptions& options = {},
                 const RunContext& context = default_context());

  /// Points that have no part in the complex, ascending: other points with large weights outdo them
  /// everywhere.
  std::span<const std::uint32_t> hidden() const;
  /// Copies of other points, ascending; empty if points are weighted.
  std::vector<Index> copies() const;
  /// Simplices by dimension, those beyond the threshold and edges of copies included.
  std::vector<std::size_t> simplex_counts() const;

  /// Makes every simplex, unless they are there. It takes about 5 kB a point of R³ and stays
  /// with the filtration. Thread-safe. @throws Error (resource) and (cancelled).
  void prepare(const RunContext& context) const;
  /// The same complex, simplex by simplex, as the other parts of libph take it. Made by `prepare`
  /// or by the first call. Values are squares in units that are a power of two.
  const ExplicitComplex& listed() const;

  int top_dim() const { return top_dim_; }
  double value(Cell c) const { return to_value(listed().value(c)); }
  std::uint32_t key(Cell c) const { return listed().key(c); }
  static bool precedes(Cell a, Cell b) { return ExplicitComplex::precedes(a, b); }
  std::size_t slot_count() const { return listed().slot_count(); }
  static std::size_t slot(Cell c) { return ExplicitComplex::slot(c); }
  /// Not in a periodic space: an edge may be a loop.
  bool edges_join_vertices() const { return !is_periodic(); }
  static CellKind cell_kind() { return CellKind::vertices; }
  /// In a periodic space a point may come several times.
  void append_input_cell(int dim, Cell cell, std::vector<Index>& numbers) const;
  /// How many points the input has, those without a part in the complex included.
  std::size_t vertex_count() const;
  /// The point of the input that is a vertex.
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

  /// For engines: the triangulation with its intervals.
  const alpha::AlphaCells& cells() const { return *cells_; }
  /// A squared radius of it as a value of this filtration.
  double to_value(double squared_radius) const;
  double threshold() const { return threshold_; }
  AlphaOptions::Value value_kind() const { return kind_; }
  AlphaOptions::Unit unit() const { return unit_; }
  bool is_weighted() const;
  /// Whether an axis closes up.
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

/// Triangles on the surface of a set of simplices, each by its points.
struct SurfaceMesh {
  std::vector<std::array<Index, 3>> triangles;
  /// The first so many have a tetrahedron on one side, and are counterclockwise as seen from the
  /// other. Those behind, *singular* ones, have none on either side.
  std::size_t regular = 0;
};

/// The surface of the simplices up to a value, in the unit of the complex, whatever its threshold:
/// what the balls of that radius enclose, as a polyhedron. Of points in a plane all triangles up to
/// it, counterclockwise if they are points of R². O(triangles · log). @throws Error (usage) on NaN,
/// on values other than alpha, and in a periodic space: a triangle across a face of the box has no
/// points for its corners.
SurfaceMesh alpha_shape(const Alpha& alpha, double value);

/// The same of the wrap complex (Edelsbrunner, Surface reconstruction by wrapping finite sets in
/// space, 2003): the critical simplices up to a value with all that lies below them. It has the
/// shape of the alpha complex, up to homotopy, and is a part of it without its frayed edges.
/// O(tetrahedra). @throws Error (usage) as alpha_shape; Error (resource, cancelled).
SurfaceMesh wrap(const Alpha& alpha, double value, const RunContext& context = default_context());

}  // namespace ph
