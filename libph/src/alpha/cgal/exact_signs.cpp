// SPDX-License-Identifier: MIT
#include <CGAL/Exact_rational.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <limits>
#include <random>

#include "libph/src/alpha/cgal/kernel.hpp"
#include "libph/src/alpha/sites/squared_radius.hpp"
#include "libph/src/alpha/triangulation/triangulations.hpp"

namespace ph::alpha {
namespace {

bool has_weights(std::span<const WeightedSite> sites) {
  return std::ranges::any_of(sites, [](const WeightedSite& s) { return s.weight != 0; });
}

}  // namespace

bool is_inside(std::span<const WeightedSite> others, const WeightedSite& site) {
  const Kernel kernel;
  if (!has_weights(others) && site.weight == 0) {
    const auto side = kernel.side_of_bounded_sphere_3_object();
    const auto p = [&](std::size_t i) { return point_of(others[i].point); };
    const auto q = point_of(site.point);
    const CGAL::Bounded_side found = others.size() == 1   ? CGAL::ON_UNBOUNDED_SIDE
                                     : others.size() == 2 ? side(p(0), p(1), q)
                                                          : side(p(0), p(1), p(2), q);
    return found == CGAL::ON_BOUNDED_SIDE;  // mutant: alpha-on-sphere
  }
  const auto weighted = [](const WeightedSite& s) {
    return Kernel::Weighted_point_3(point_of(s.point), s.weight);
  };
  const auto side = kernel.power_side_of_bounded_power_sphere_3_object();
  const auto p = [&](std::size_t i) { return weighted(others[i]); };
  const auto q = weighted(site);
  const CGAL::Bounded_side found = others.size() == 1   ? side(p(0), q)
                                   : others.size() == 2 ? side(p(0), p(1), q)
                                                        : side(p(0), p(1), p(2), q);
  return found == CGAL::ON_BOUNDED_SIDE;  // mutant: alpha-on-orthosphere
}

bool are_collinear(const std::array<Vector<double>, 3>& points) {
  return CGAL::collinear(point_of(points[0]), point_of(points[1]), point_of(points[2]));
}

double exact_squared_radius(std::span<const WeightedSite> sites) {
  using Number = CGAL::Exact_rational;
  std::array<Vector<Number>, 4> points;
  std::array<Number, 4> weights;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const auto& p = sites[i].point;
    points[i] = {Number(p.x), Number(p.y), Number(p.z)};
    weights[i] = Number(sites[i].weight);
  }
  const Number radius =
      squared_radius<Number>(std::span(points).first(sites.size()), std::span(weights));
  // A simplex with an infinite value would never enter the filtration.
  constexpr double largest = std::numeric_limits<double>::max();
  if (radius > Number(largest)) return largest;  // mutant: alpha-infinite-radius
  return CGAL::to_double(radius);
}

std::pmr::vector<std::uint32_t> insertion_order(const Sites& sites,
                                                std::pmr::memory_resource* memory) {
  constexpr std::size_t few = 512;  // the number of sites in the first round
  int rounds = 1;
  for (std::size_t left = sites.size(); left > few; left /= 8) ++rounds;
  std::mt19937_64 random(7);  // a fixed seed gives the same order in each run
  std::pmr::vector<std::uint8_t> round(sites.size(), memory);
  for (std::uint8_t& r : round)
    for (r = 0; r + 1 < rounds && (random() & 7) == 0;) ++r;
  std::pmr::vector<std::uint32_t> order(memory);
  order.reserve(sites.size());
  for (int r = rounds - 1; r >= 0; --r)
    for (std::uint32_t i = 0; i < sites.size(); ++i)
      if (round[i] == r) order.push_back(sites.path.empty() ? i : sites.path[i]);
  return order;
}

}  // namespace ph::alpha
