// SPDX-License-Identifier: MIT
#pragma once
// The alpha complex of a few points, computed from its definition with exact numbers. The only code
// that it shares with libph is the type of the points.
#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <map>
#include <optional>
#include <vector>

#include "ph/points.hpp"

namespace ph::test {

using Rational = boost::multiprecision::cpp_rational;
using RationalPoint = std::vector<Rational>;

inline Rational dot(const RationalPoint& a, const RationalPoint& b) {
  Rational sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}
inline RationalPoint minus(RationalPoint a, const RationalPoint& b) {
  for (std::size_t k = 0; k < a.size(); ++k) a[k] -= b[k];
  return a;
}

/// The smallest sphere through points or, if the points have weights, orthogonal to them.
struct ExactSphere {
  RationalPoint centre;
  std::vector<Rational> barycentric;  ///< barycentric coordinates of the centre
  Rational squared_radius;
};

/// Returns nothing if the points are affinely dependent.
inline std::optional<ExactSphere> exact_sphere(const std::vector<RationalPoint>& points,
                                               const std::vector<Rational>& weights) {
  const std::size_t m = points.size() - 1;
  std::vector<RationalPoint> to;
  for (std::size_t i = 1; i <= m; ++i) to.push_back(minus(points[i], points[0]));
  // Solves 2 <to_i, Σ x_j to_j> = |to_i|² - w_i + w_0 by Gaussian elimination.
  std::vector<RationalPoint> rows(m, RationalPoint(m + 1));
  for (std::size_t i = 0; i < m; ++i) {
    for (std::size_t j = 0; j < m; ++j) rows[i][j] = 2 * dot(to[i], to[j]);
    rows[i][m] = dot(to[i], to[i]) - weights[i + 1] + weights[0];
  }
  for (std::size_t i = 0; i < m; ++i) {
    std::size_t pivot = i;
    while (pivot < m && rows[pivot][i] == 0) ++pivot;
    if (pivot == m) return std::nullopt;
    std::swap(rows[i], rows[pivot]);
    for (std::size_t j = 0; j < m; ++j) {
      if (j == i) continue;
      const Rational factor = rows[j][i] / rows[i][i];
      for (std::size_t k = 0; k <= m; ++k) rows[j][k] -= factor * rows[i][k];
    }
  }
  ExactSphere sphere{points[0], {1}, 0};
  for (std::size_t i = 0; i < m; ++i) {
    const Rational x = rows[i][m] / rows[i][i];
    sphere.barycentric.push_back(x);
    sphere.barycentric[0] -= x;
    for (std::size_t k = 0; k < sphere.centre.size(); ++k) sphere.centre[k] += x * to[i][k];
  }
  const RationalPoint radius = minus(sphere.centre, points[0]);
  sphere.squared_radius = dot(radius, radius) - weights[0];
  return sphere;
}

struct OracleBar {
  int dim;
  Rational birth;
  std::optional<Rational> death;
};

/// The bars of positive length over Z/p, by the standard reduction.
/// @param order the simplices with their values, each simplex after its faces.
/// @param visit_facets(simplex, visit) calls visit(facet, sign) for each facet.
template <class Simplex, class Dim, class VisitFacets>
std::vector<OracleBar> oracle_bars(const std::vector<std::pair<Rational, Simplex>>& order, int p,
                                   Dim&& dim_of, VisitFacets&& visit_facets) {
  std::map<Simplex, std::size_t> place;
  std::vector<std::map<std::size_t, int>> columns(order.size());
  std::map<std::size_t, std::size_t> column_of_pivot;
  std::vector<bool> is_paired(order.size(), false);
  std::vector<OracleBar> result;
  const auto add = [&](std::map<std::size_t, int>& column, std::size_t row, int a) {
    if ((column[row] = ((column[row] + a) % p + p) % p) == 0) column.erase(row);
  };
  for (std::size_t i = 0; i < order.size(); ++i) {
    place[order[i].second] = i;
    auto& column = columns[i];
    visit_facets(order[i].second,
                 [&](const Simplex& facet, int sign) { add(column, place.at(facet), sign); });
    while (!column.empty() && column_of_pivot.contains(column.rbegin()->first)) {
      const auto& other = columns[column_of_pivot.at(column.rbegin()->first)];
      int factor = 0;
      while ((column.rbegin()->second + factor * other.rbegin()->second) % p != 0) ++factor;
      for (const auto& [row, a] : other) add(column, row, factor * a);
    }
    if (column.empty()) continue;
    const std::size_t born = column.rbegin()->first;
    column_of_pivot[born] = i;
    is_paired[born] = is_paired[i] = true;
    if (order[born].first < order[i].first)
      result.push_back({dim_of(order[born].second), order[born].first, order[i].first});
  }
  for (std::size_t i = 0; i < order.size(); ++i)
    if (!is_paired[i]) result.push_back({dim_of(order[i].second), order[i].first, std::nullopt});
  return result;
}

/// A simplex is a set of points, stored as bits. It is in the complex if the Voronoi cells (with
/// weights, the power cells) of its points meet. Its value is the least power in the intersection,
/// that is, the least power of a place there with respect to the points of the simplex. All such
/// simplices are listed, although a triangulation has fewer for cospherical points. The simplices
/// up to a value form the nerve of the balls restricted to Voronoi cells, and this nerve has the
/// homology of the union of the balls.
class AlphaOracle {
 public:
  AlphaOracle(PointsView points, const std::vector<double>& weights) {
    for (Index i = 0; i < points.rows(); ++i) {
      points_.emplace_back();
      for (Index k = 0; k < points.cols(); ++k) points_.back().emplace_back(points(i, k));
      weights_.emplace_back(weights.empty() ? 0.0 : weights[static_cast<std::size_t>(i)]);
    }
    find_spheres(static_cast<std::size_t>(points.cols()));
    const unsigned all = 1U << points_.size();
    for (unsigned simplex = 1; simplex < all; ++simplex)
      for (const EmptySphere& sphere : spheres_) {
        if ((simplex & ~sphere.on) != 0) continue;
        const auto [at, is_new] = values_.emplace(simplex, sphere.squared_radius);
        if (!is_new && sphere.squared_radius < at->second) at->second = sphere.squared_radius;
      }
  }

  /// The value of each simplex.
  const std::map<unsigned, Rational>& values() const { return values_; }

  /// True if the centre of some empty sphere has less power with respect to this point than with
  /// respect to every other point. A hidden point has no such centre.
  bool is_ever_alone(std::size_t point) const {
    return std::ranges::any_of(spheres_, [&](const auto& s) { return s.on == 1U << point; });
  }

  /// The rounded centres and squared radii of the smallest spheres through all sets of affinely
  /// independent points, including spheres with other points inside.
  std::vector<std::pair<std::vector<double>, double>> centres() const {
    std::vector<std::pair<std::vector<double>, double>> result;
    for (unsigned set = 1; set < 1U << points_.size(); ++set)
      if (const auto centre = centre_of(set)) {
        std::vector<double> rounded;
        for (const Rational& x : *centre) rounded.push_back(static_cast<double>(x));
        const auto first = static_cast<std::size_t>(__builtin_ctz(set));
        result.emplace_back(rounded, static_cast<double>(power(*centre, first)));
      }
    return result;
  }

  /// The bars of positive length over Z/p.
  std::vector<OracleBar> bars(int p) const {
    std::vector<std::pair<Rational, unsigned>> order;
    for (const auto& [simplex, value] : values_) order.emplace_back(value, simplex);
    std::sort(order.begin(), order.end(), [](const auto& a, const auto& b) {
      if (a.first != b.first) return a.first < b.first;
      const int m = __builtin_popcount(a.second), n = __builtin_popcount(b.second);
      return m != n ? m < n : a.second < b.second;
    });
    return oracle_bars(order, p, dim_of, [](unsigned simplex, auto&& visit) {
      int sign = 1;
      if (__builtin_popcount(simplex) > 1)
        for (unsigned left = simplex; left != 0; left &= left - 1, sign = -sign)
          visit(simplex & ~(left & -left), sign);
    });
  }

 private:
  struct EmptySphere {
    Rational squared_radius;
    unsigned on;  // the points on the sphere
  };
  static int dim_of(unsigned simplex) { return __builtin_popcount(simplex) - 1; }
  Rational power(const RationalPoint& centre, std::size_t i) const {
    const RationalPoint to = minus(points_[i], centre);
    return dot(to, to) - weights_[i];
  }

  std::optional<RationalPoint> centre_of(unsigned set) const {
    std::vector<RationalPoint> members;
    std::vector<Rational> weights;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if ((set >> i & 1) == 0) continue;
      members.push_back(points_[i]);
      weights.push_back(weights_[i]);
    }
    const auto sphere = exact_sphere(members, weights);
    return sphere ? std::optional(sphere->centre) : std::nullopt;
  }

  /// Stores the empty spheres. The least power of each intersection of cells is attained at a
  /// centre of such a sphere.
  void find_spheres(std::size_t dim) {
    for (unsigned set = 1; set < 1U << points_.size(); ++set) {
      if (__builtin_popcount(set) > static_cast<int>(dim) + 1) continue;
      const std::optional<RationalPoint> centre = centre_of(set);
      if (!centre) continue;
      const Rational radius = power(*centre, static_cast<std::size_t>(__builtin_ctz(set)));
      unsigned on = 0;
      bool is_empty = true;
      for (std::size_t i = 0; i < points_.size() && is_empty; ++i) {
        const Rational of_point = power(*centre, i);
        if (of_point < radius) is_empty = false;
        if (of_point == radius) on |= 1U << i;
      }
      if (is_empty) spheres_.push_back({radius, on});
    }
  }

  std::vector<RationalPoint> points_;
  std::vector<Rational> weights_;
  std::vector<EmptySphere> spheres_;
  std::map<unsigned, Rational> values_;
};

}  // namespace ph::test
