// SPDX-License-Identifier: MIT
#include "libph/src/alpha/listed_simplices.hpp"

#include <algorithm>
#include <optional>

#include "libph/src/alpha/intervals/spheres.hpp"
#include "libph/src/complex/counted_list.hpp"

namespace ph::alpha {
namespace {

/// For each point of the input, its site. The site of a copy is the site of the original point.
std::pmr::vector<std::uint32_t> sites_by_point(const Sites& sites,
                                               std::pmr::memory_resource* memory) {
  std::pmr::vector<std::uint32_t> site_of(sites.size() + sites.copies.size(), kNone, memory);
  for (std::uint32_t site = 0; site < sites.size(); ++site) site_of[sites.input[site]] = site;
  for (const auto& [copy, site] : sites.copies) site_of[copy] = site;
  return site_of;
}

/// The squared radius of the smallest ball around a simplex if this ball is bounded by the
/// circumsphere of the simplex. Otherwise 0, because the smallest ball around one of the faces is
/// then the same ball.
double own_ball(const Spheres& spheres, const std::array<std::uint32_t, 4>& sites, int dim) {
  if (dim == 1) return spheres.of_edge(sites[0], sites[1]).squared_radius;
  if (dim == 2)
    return spheres.beyond_triangle(sites[0], sites[1], sites[2]) == 0
               ? spheres.triangle_radius(sites[0], sites[1], sites[2])
               : 0;
  const Sphere sphere = spheres.of_tetrahedron(sites);
  return sphere.beyond == 0 ? sphere.squared_radius : 0;  // mutant: alpha-obtuse-ball
}

}  // namespace

ExplicitComplex list_with_other_values(const AlphaCells& cells, AlphaOptions::Value value,
                                       const Enters& enters, const RunContext& context) {
  std::optional<ExplicitComplex> all(list_simplices(
      cells, [](double) { return true; }, context));
  const Spheres spheres(cells.sites);
  const auto site_of = sites_by_point(cells.sites, &context.memory);
  std::pmr::vector<double> values(all->size(), 0.0, &context.memory);
  std::size_t count = 0, vertices = 0;
  std::vector<Index> numbers;
  Ticker ticker(context, "values", all->size());
  for (int dim = 0; dim <= all->top_dim(); ++dim)
    all->for_each_cell(dim, [&](const ExplicitComplex::Cell& cell) {
      ticker.tick();
      numbers.clear();
      all->append_input_cell(dim, cell, numbers);
      double& least = values[cell.id];
      if (dim > 0)
        all->for_each_facet(dim, cell, [&](const ExplicitComplex::Cell& facet, int) {
          least = std::max(least, values[facet.id]);
        });
      std::array<std::uint32_t, 4> sites{kNone, kNone, kNone, kNone};
      for (std::size_t i = 0; i < numbers.size(); ++i)
        sites[i] = site_of[static_cast<std::size_t>(numbers[i])];
      const bool is_own = dim == 1 || (dim > 1 && value == AlphaOptions::Value::delaunay_cech);
      // The smallest ball around a copy and its site has radius 0.
      if (is_own && sites[0] != sites[1]) least = std::max(least, own_ball(spheres, sites, dim));
      if (!enters(least)) return;
      ++count;
      vertices += numbers.size();
    });
  CountedList list(count, vertices, context);
  for (int dim = 0; dim <= all->top_dim(); ++dim)
    all->for_each_cell(dim, [&](const ExplicitComplex::Cell& cell) {
      if (!enters(values[cell.id])) return;
      numbers.clear();
      all->append_input_cell(dim, cell, numbers);
      list.add(numbers, values[cell.id]);
    });
  all.reset();
  return ExplicitComplex::from_simplices(list.take(), {}, context);
}

}  // namespace ph::alpha
