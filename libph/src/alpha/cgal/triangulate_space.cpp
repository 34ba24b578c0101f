// SPDX-License-Identifier: MIT
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include "alpha/cgal/cells_of.hpp"

namespace ph::alpha {
namespace {

using std::uint32_t;

template <class VertexBase, class CellBase>
using Structure = CGAL::Triangulation_data_structure_3<
    CGAL::Triangulation_vertex_base_with_info_3<uint32_t, Kernel, VertexBase>,
    CGAL::Triangulation_cell_base_with_info_3<uint32_t, Kernel, CellBase>>;
using Delaunay =
    CGAL::Delaunay_triangulation_3<Kernel,
                                   Structure<CGAL::Triangulation_vertex_base_3<Kernel>,
                                             CGAL::Delaunay_triangulation_cell_base_3<Kernel>>>;
using Regular =
    CGAL::Regular_triangulation_3<Kernel,
                                  Structure<CGAL::Regular_triangulation_vertex_base_3<Kernel>,
                                            CGAL::Regular_triangulation_cell_base_3<Kernel>>>;

/// What CGAL made, in any dimension up to 3.
template <class Dt>
Triangulation copy(Dt& dt, std::size_t sites, const RunContext& context) {
  using Cell = typename Dt::Cell_handle;
  Triangulation result(&context.memory);
  result.dim = dt.dimension();
  if (result.dim == 0)
    result.cells.push_back({dt.finite_vertices_begin()->info(), kNone, kNone, kNone});
  if (result.dim == 1)
    copy_edges(result, [&](auto&& add) {
      for (auto e = dt.finite_edges_begin(); e != dt.finite_edges_end(); ++e)
        add(e->first->vertex(e->second)->info(), e->first->vertex(e->third)->info());
    });
  if (result.dim == 2)
    copy_cells<Cell>(
        result, sites,
        [&](auto&& use) {
          for (auto f = dt.all_facets_begin(); f != dt.all_facets_end(); ++f)
            use(f->first, [&] { return !dt.is_infinite(*f); });
        },
        context);
  if (result.dim == 3)
    copy_cells<Cell>(
        result, sites,
        [&](auto&& use) {
          for (auto c = dt.all_cells_begin(); c != dt.all_cells_end(); ++c)
            use(c, [&] { return !dt.is_infinite(c); });
        },
        context);
  return result;
}

template <class Dt, class PointOf>
Triangulation build(const Sites& sites, PointOf&& point_of_site, const RunContext& context) {
  using Cell = typename Dt::Cell_handle;
  Dt dt;
  MemoryClaim claim(context.memory, 0);
  const auto insert = [&](uint32_t site, Cell start) {
    const auto vertex = dt.insert(point_of_site(site), start);
    if (vertex == typename Dt::Vertex_handle()) return start;  // hidden: nothing has changed
    vertex->info() = site;
    return vertex->cell();
  };
  insert_sites<Cell>(sites, context, claim, insert, [&] {
    return dt.tds().cells().capacity() * sizeof(typename Dt::Cell) +
           dt.tds().vertices().capacity() * sizeof(typename Dt::Vertex);
  });
  return copy(dt, sites.size(), context);
}

}  // namespace

Triangulation triangulate_space(const Sites& sites, const RunContext& context) {
  if (!sites.is_weighted())
    return build<Delaunay>(
        sites, [&](uint32_t site) { return point_of(sites.points[site]); }, context);
  return build<Regular>(
      sites,
      [&](uint32_t site) {
        return Regular::Weighted_point(point_of(sites.points[site]), sites.weights[site]);
      },
      context);
}

}  // namespace ph::alpha
