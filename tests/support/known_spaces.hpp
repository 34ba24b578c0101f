// SPDX-License-Identifier: MIT
#pragma once
// Spaces with well-known homology: triangulations given by their largest simplices, finite metric
// spaces, images.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>
#include <vector>

#include "ph/barcode.hpp"
#include "ph/explicit.hpp"
#include "ph/image.hpp"
#include "ph/rips.hpp"

namespace ph::test {

// The largest simplices; their faces are implied.
using Simplices = std::vector<std::vector<Index>>;

// ---- triangulations

/// Moebius' torus on seven vertices, every two of which are joined.
inline Simplices torus_of_seven_vertices() {
  Simplices s;
  for (Index i = 0; i < 7; ++i) {
    s.push_back({i, (i + 1) % 7, (i + 3) % 7});
    s.push_back({i, (i + 2) % 7, (i + 3) % 7});
  }
  return s;
}

/// The projective plane on six vertices: the icosahedron with opposite points identified.
inline Simplices projective_plane() {
  return {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 1},
          {1, 2, 4}, {2, 3, 5}, {3, 4, 1}, {4, 5, 2}, {5, 1, 3}};
}

/// A grid of n x n squares, each cut into two triangles, with opposite sides glued. For a torus,
/// the sides are glued directly. For a Klein bottle, one pair is reversed. The result is a
/// simplicial complex if n is at least 4.
inline Simplices glued_grid(Index n, bool reversed) {
  const auto vertex = [&](Index i, Index j) {
    if (i >= n) {
      i -= n;
      if (reversed) j = n - j;
    }
    return i * n + (j + n) % n;
  };
  Simplices s;
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) {
      s.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      s.push_back({vertex(i, j), vertex(i, j + 1), vertex(i + 1, j + 1)});
    }
  }
  return s;
}
inline Simplices klein_bottle() { return glued_grid(4, true); }

/// All proper faces of a simplex on dim + 2 vertices: a sphere of dimension `dim`.
inline Simplices simplex_boundary(int dim) {
  Simplices s;
  for (Index gone = 0; gone < dim + 2; ++gone) {
    std::vector<Index> face;
    for (Index v = 0; v < dim + 2; ++v)
      if (v != gone) face.push_back(v);
    s.push_back(face);
  }
  return s;
}

/// The boundary of the cross-polytope, which is a sphere of dimension `dim`. There are dim + 1
/// pairs of opposite vertices, 2k and 2k + 1, and each largest simplex has one vertex of each pair.
/// For dim = 2, this is the octahedron.
inline Simplices cross_polytope(int dim) {
  Simplices s;
  for (unsigned choice = 0; choice < (1U << (dim + 1)); ++choice) {
    std::vector<Index> face;
    for (Index k = 0; k <= dim; ++k) face.push_back(2 * k + (choice >> k & 1));
    s.push_back(face);
  }
  return s;
}

inline Index vertex_count(const Simplices& simplices) {
  Index count = 0;
  for (const auto& simplex : simplices)
    count = std::max(count, *std::max_element(simplex.begin(), simplex.end()) + 1);
  return count;
}

/// The suspension: two cones over the same base. Its reduced homology is the reduced homology of
/// the base, one dimension higher.
inline Simplices suspension(const Simplices& base) {
  const Index north = vertex_count(base), south = north + 1;
  Simplices s;
  for (const auto& simplex : base) {
    for (const Index pole : {north, south}) {
      s.push_back(simplex);
      s.back().push_back(pole);
    }
  }
  return s;
}

/// Two spaces that share only vertex 0. Above dimension 0, the homology is the direct sum of the
/// homologies of the two spaces.
inline Simplices wedge(const Simplices& a, const Simplices& b) {
  Simplices s = a;
  const Index shift = vertex_count(a) - 1;
  for (auto simplex : b) {
    for (Index& v : simplex)
      if (v != 0) v += shift;
    s.push_back(simplex);
  }
  return s;
}

/// The lower-star filtration of a space. @param values the values of the vertices.
inline ExplicitComplex filtered(const Simplices& simplices, std::span<const double> values) {
  SimplexList list;
  for (const auto& simplex : simplices) list.add(simplex, 0);
  return lower_star(list, values);
}
/// The whole space. All its cells enter at value 0.
inline ExplicitComplex all_at_once(const Simplices& simplices) {
  const std::vector<double> zeros(static_cast<std::size_t>(vertex_count(simplices)), 0.0);
  return filtered(simplices, zeros);
}
/// The space built vertex by vertex. Vertex i enters at i.
inline ExplicitComplex vertex_by_vertex(const Simplices& simplices) {
  std::vector<double> values(static_cast<std::size_t>(vertex_count(simplices)));
  std::iota(values.begin(), values.end(), 0.0);
  return filtered(simplices, values);
}

// ---- metric spaces

/// n evenly spaced points on the unit circle.
inline Points circle(Index n) {
  Points p(n, 2);
  for (Index i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
    p(i, 0) = std::cos(angle);
    p(i, 1) = std::sin(angle);
  }
  return p;
}
/// The distance between two points of the circle that are `steps` apart.
inline double chord(Index n, Index steps) {
  return 2 * std::sin(std::numbers::pi * static_cast<double>(steps) / static_cast<double>(n));
}

/// The points of a grid of columns x rows with integer coordinates, on a flat torus or a flat Klein
/// bottle. The distance is the larger difference of coordinates, where each difference is measured
/// the shorter way round.
struct FlatSurface {
  Index columns, rows;
  bool reversed = false;  ///< going once around the columns flips the rows: a Klein bottle

  Index size() const { return columns * rows; }
  double operator()(Index a, Index b) const {
    const Index x = a / rows, y = a % rows;
    Index best = columns + rows;
    for (Index turns = -2; turns <= 2; ++turns) {
      const Index bx = b / rows + turns * columns;
      const Index by = reversed && turns % 2 != 0 ? -(b % rows) : b % rows;
      const Index dy = ((by - y) % rows + rows) % rows;
      best = std::min(best, std::max(std::abs(bx - x), std::min(dy, rows - dy)));
    }
    return static_cast<double>(best);
  }
};

// ---- barcodes in words

/// For each dimension 0 … top, the number of bars that contain `value`.
inline std::vector<int> betti_at(const Barcode& barcode, double value, int top) {
  std::vector<int> betti(static_cast<std::size_t>(top) + 1, 0);
  for (const Bar& bar : barcode)
    if (bar.dim <= top && bar.birth <= value && value < bar.death)
      ++betti[static_cast<std::size_t>(bar.dim)];
  return betti;
}
/// For each dimension 0 … top, the number of bars that never die.
inline std::vector<int> betti_at_the_end(const Barcode& barcode, int top) {
  std::vector<int> betti(static_cast<std::size_t>(top) + 1, 0);
  for (const Bar& bar : barcode)
    if (bar.is_infinite()) ++betti[static_cast<std::size_t>(bar.dim)];
  return betti;
}
/// The bars of one dimension, as pairs of numbers.
inline std::vector<std::pair<double, double>> intervals(const Barcode& barcode, int dim) {
  std::vector<std::pair<double, double>> result;
  for (const Bar& bar : barcode.bars(dim)) result.emplace_back(bar.birth, bar.death);
  return result;
}
inline std::vector<Bar> bars_of(const Barcode& barcode) { return {barcode.begin(), barcode.end()}; }

}  // namespace ph::test
