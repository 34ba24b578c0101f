// SPDX-License-Identifier: MIT
#pragma once
// The alpha complex of a few points in a periodic space, computed from its definition with exact
// numbers. The only code that it shares with libph is the type of the points.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "ph/points.hpp"
#include "tests/libph/alpha/alpha_oracle.hpp"

namespace ph::test {

/// An image of a point, given by the number of periods along each axis.
struct Image {
  std::array<int, 3> periods{};
  std::size_t point = 0;

  friend auto operator<=>(const Image& a, const Image& b) {
    return a.point != b.point ? a.point <=> b.point : a.periods <=> b.periods;
  }
  friend bool operator==(const Image&, const Image&) = default;
};

/// The points are repeated periodically in space. A simplex is a set of images that lie on an empty
/// sphere. Two sets that differ by a translation by periods are the same simplex. The simplices are
/// listed up to the radius at which the balls cover the convex hull, because nothing changes beyond
/// this radius.
class PeriodicOracle {
 public:
  /// Images in ascending order; the first image is not translated.
  using Simplex = std::vector<Image>;

  PeriodicOracle(PointsView points, const std::vector<double>& period,
                 const std::vector<double>& weights) {
    for (Index i = 0; i < points.rows(); ++i) {
      points_.emplace_back();
      for (Index k = 0; k < points.cols(); ++k) points_.back().emplace_back(points(i, k));
      weights_.emplace_back(weights.empty() ? 0.0 : weights[static_cast<std::size_t>(i)]);
    }
    for (const double length : period) period_.emplace_back(length);
    Rational lightest = weights_[0], heaviest = weights_[0];
    for (const Rational& w : weights_) {
      lightest = std::min(lightest, w);
      heaviest = std::max(heaviest, w);
    }
    for (std::size_t k = 0; k < period_.size(); ++k) {
      Rational low = points_[0][k], high = low;
      for (const Point& p : points_) {
        low = std::min(low, p[k]);
        high = std::max(high, p[k]);
      }
      most_ += period_[k] != 0 ? Rational(period_[k] * period_[k] / 4)
                               : Rational((high - low) * (high - low));
    }
    const Rational reach = most_ + heaviest - lightest;
    most_ -= lightest;
    for (std::size_t first = 0; first < points_.size(); ++first) {
      const std::size_t home = find_neighbours(first, 4 * reach);
      add_spheres({home}, 0);
    }
  }

  const std::map<Simplex, Rational>& values() const { return values_; }

  /// The bars of positive length over Z/p.
  std::vector<OracleBar> bars(int p) const {
    std::vector<std::pair<Rational, Simplex>> order;
    for (const auto& [simplex, value] : values_) order.emplace_back(value, simplex);
    std::sort(order.begin(), order.end(), [](const auto& a, const auto& b) {
      if (a.first != b.first) return a.first < b.first;
      if (a.second.size() != b.second.size()) return a.second.size() < b.second.size();
      return a.second < b.second;
    });
    const auto dim_of = [](const Simplex& simplex) { return static_cast<int>(simplex.size()) - 1; };
    return oracle_bars(order, p, dim_of, [](const Simplex& simplex, auto&& visit) {
      for (std::size_t k = 0; simplex.size() > 1 && k < simplex.size(); ++k) {
        Simplex facet = simplex;
        facet.erase(facet.begin() + static_cast<std::ptrdiff_t>(k));
        visit(brought_home(facet), k % 2 == 0 ? 1 : -1);
      }
    });
  }

 private:
  using Point = std::vector<Rational>;

  static Rational dot(const Point& a, const Point& b) {
    Rational sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
    return sum;
  }
  static Point minus(Point a, const Point& b) {
    for (std::size_t k = 0; k < a.size(); ++k) a[k] -= b[k];
    return a;
  }
  Point at(const Image& image) const {
    Point p = points_[image.point];
    for (std::size_t k = 0; k < p.size(); ++k) p[k] += image.periods[k] * period_[k];
    return p;
  }
  static Simplex brought_home(Simplex simplex) {
    std::sort(simplex.begin(), simplex.end());
    const auto by = simplex[0].periods;
    for (Image& image : simplex)
      for (std::size_t k = 0; k < 3; ++k) image.periods[k] -= by[k];
    return simplex;
  }

  /// Finds the images whose squared distance to a point in the box is at most `squared`.
  /// @return the index of the point among these images.
  std::size_t find_neighbours(std::size_t of, const Rational& squared) {
    neighbours_.clear();
    places_.clear();
    rounded_.clear();
    weights_of_places_.clear();
    rounded_weights_.clear();
    std::size_t home = 0;
    std::array<int, 3> most{};
    const double distance = std::sqrt(static_cast<double>(squared));
    for (std::size_t k = 0; k < period_.size(); ++k)
      if (period_[k] != 0) {
        double widest = 0;
        for (const Point& p : points_)
          widest = std::max(widest, std::abs(static_cast<double>(Rational(p[k] - points_[of][k]))));
        most[k] = static_cast<int>((distance + widest) / static_cast<double>(period_[k])) + 1;
      }
    for (std::size_t i = 0; i < points_.size(); ++i)
      for (int x = -most[0]; x <= most[0]; ++x)
        for (int y = -most[1]; y <= most[1]; ++y)
          for (int z = -most[2]; z <= most[2]; ++z) {
            const Image image{{x, y, z}, i};
            const Point p = at(image), to = minus(p, points_[of]);
            if (dot(to, to) > squared) continue;
            if (image == Image{{}, of}) home = neighbours_.size();
            neighbours_.push_back(image);
            places_.push_back(p);
            weights_of_places_.push_back(weights_[i]);
            rounded_.emplace_back();
            for (std::size_t k = 0; k < p.size(); ++k)
              rounded_.back()[k] = static_cast<double>(p[k]);
            rounded_weights_.push_back(static_cast<double>(weights_[i]));
          }
    return home;
  }

  using Places = std::vector<std::size_t>;  // indices of some neighbours

  /// Adds the spheres through the images in `set`, and through these images together with
  /// neighbours from the index `next` on.
  void add_spheres(const Places& set, std::size_t next) {
    if (!add_sphere(set) || set.size() > period_.size()) return;
    for (std::size_t i = next; i < neighbours_.size(); ++i) {
      if (neighbours_[i] <= neighbours_[set.back()]) continue;
      Places larger = set;
      larger.push_back(i);
      add_spheres(larger, i + 1);
    }
  }

  /// @return true if a larger set of images may have an empty sphere of at most the required
  /// radius.
  bool add_sphere(const Places& set) {
    // Most spheres are too large or not empty, and arithmetic with doubles is enough to show this.
    constexpr double flat = 1e-6, room = 1e-6;
    if (const auto centre = centre_of<double>(set, flat, rounded_, rounded_weights_)) {
      const auto power_of = [&](std::size_t i) {
        double sum = -rounded_weights_[i];
        for (std::size_t k = 0; k < period_.size(); ++k)
          sum += (rounded_[i][k] - (*centre)[k]) * (rounded_[i][k] - (*centre)[k]);
        return sum;
      };
      const double radius = power_of(set[0]);
      if (radius > static_cast<double>(most_) + room) return false;
      for (std::size_t i = 0; i < neighbours_.size(); ++i)
        if (power_of(i) < radius - room) return true;
    }
    const auto centre = centre_of<Rational>(set, 0, places_, weights_of_places_);
    if (!centre) return false;
    const Rational radius = power(*centre, set[0]);
    if (radius > most_) return false;  // larger sets have larger radii
    Simplex on;
    for (std::size_t i = 0; i < neighbours_.size(); ++i) {
      const Rational of_image = power(*centre, i);
      if (of_image < radius) return true;
      if (of_image == radius) on.push_back(neighbours_[i]);
    }
    // Visits each subset of the images on the sphere.
    for (unsigned part = 1; part < 1U << on.size(); ++part) {
      Simplex simplex;
      for (std::size_t i = 0; i < on.size(); ++i)
        if ((part >> i & 1) != 0) simplex.push_back(on[i]);
      const auto [found, is_new] = values_.emplace(brought_home(simplex), radius);
      if (!is_new && radius < found->second) found->second = radius;
    }
    return true;
  }
  Rational power(const Point& centre, std::size_t i) const {
    const Point to = minus(places_[i], centre);
    return dot(to, to) - weights_of_places_[i];
  }

  /// The point in the affine hull that has the same power with respect to all points; nothing if
  /// the points are affinely dependent.
  template <class Number, class AnyPoint>
  std::optional<std::vector<Number>> centre_of(const Places& set, const Number& flat,
                                               const std::vector<AnyPoint>& places,
                                               const std::vector<Number>& weights) const {
    const std::size_t m = set.size() - 1, dim = period_.size();
    std::vector<std::vector<Number>> to(m, std::vector<Number>(dim));
    std::vector<std::vector<Number>> rows(m, std::vector<Number>(m + 1));
    for (std::size_t i = 0; i < m; ++i)
      for (std::size_t k = 0; k < dim; ++k) to[i][k] = places[set[i + 1]][k] - places[set[0]][k];
    for (std::size_t i = 0; i < m; ++i) {
      for (std::size_t j = 0; j < m; ++j)
        for (std::size_t k = 0; k < dim; ++k) rows[i][j] += 2 * to[i][k] * to[j][k];
      rows[i][m] = rows[i][i] / 2 + weights[set[0]] - weights[set[i + 1]];
    }
    for (std::size_t i = 0; i < m; ++i) {
      std::size_t pivot = i;
      for (std::size_t r = i; r < m; ++r)
        if (magnitude(rows[r][i]) > magnitude(rows[pivot][i])) pivot = r;
      if (!(magnitude(rows[pivot][i]) > flat)) return std::nullopt;
      std::swap(rows[i], rows[pivot]);
      for (std::size_t r = 0; r < m; ++r) {
        if (r == i) continue;
        const Number factor = rows[r][i] / rows[i][i];
        for (std::size_t c = 0; c <= m; ++c) rows[r][c] -= factor * rows[i][c];
      }
    }
    std::vector<Number> centre(dim);
    for (std::size_t k = 0; k < dim; ++k) centre[k] = places[set[0]][k];
    for (std::size_t i = 0; i < m; ++i)
      for (std::size_t k = 0; k < dim; ++k) centre[k] += rows[i][m] / rows[i][i] * to[i][k];
    return centre;
  }
  static double magnitude(double x) { return std::abs(x); }
  static Rational magnitude(const Rational& x) { return x < 0 ? Rational(-x) : x; }

  std::vector<Point> points_;
  std::vector<Rational> weights_;
  Point period_;
  Rational most_ = 0;              // the largest required radius, squared
  std::vector<Image> neighbours_;  // the neighbours of the first image
  std::vector<Point> places_;
  std::vector<Rational> weights_of_places_;
  std::vector<std::array<double, 3>> rounded_;  // the same points as doubles
  std::vector<double> rounded_weights_;
  std::map<Simplex, Rational> values_;
};

}  // namespace ph::test
