// SPDX-License-Identifier: MIT
#include "libph/src/alpha/triangulation/triangulations.hpp"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Regular_triangulation_2.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include "libph/src/alpha/cgal/cells_of.hpp"

namespace ph::alpha {
namespace {

using std::uint32_t;

/// CGAL's names for triangulations of the plane (2) and of space (3).
template <int dim>
struct Cgal;

template <>
struct Cgal<2> {
  template <class VertexBase, class FaceBase>
  using Structure = CGAL::Triangulation_data_structure_2<
      CGAL::Triangulation_vertex_base_with_info_2<uint32_t, Kernel, VertexBase>,
      CGAL::Triangulation_face_base_with_info_2<uint32_t, Kernel, FaceBase>>;
  using Delaunay =
      CGAL::Delaunay_triangulation_2<Kernel, Structure<CGAL::Triangulation_vertex_base_2<Kernel>,
                                                       CGAL::Triangulation_face_base_2<Kernel>>>;
  using Regular =
      CGAL::Regular_triangulation_2<Kernel,
                                    Structure<CGAL::Regular_triangulation_vertex_base_2<Kernel>,
                                              CGAL::Regular_triangulation_face_base_2<Kernel>>>;
  template <class Dt>
  using Cell = typename Dt::Face_handle;

  static Kernel::Point_2 point(const Vector<double>& site) { return {site.x, site.y}; }
  static const auto& cells(const auto& structure) { return structure.faces(); }
  static auto cell_at(const auto& vertex) { return vertex->face(); }
  static std::pair<int, int> ends(const auto& edge) {
    using Order = CGAL::Triangulation_cw_ccw_2;
    return {Order::cw(edge.second), Order::ccw(edge.second)};
  }
  static void for_each_cell(const auto& dt, auto&& use) {
    for (auto f = dt.all_faces_begin(); f != dt.all_faces_end(); ++f)
      use(f, [&] { return !dt.is_infinite(f); });
  }
};

template <>
struct Cgal<3> {
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
  template <class Dt>
  using Cell = typename Dt::Cell_handle;

  static Kernel::Point_3 point(const Vector<double>& site) { return point_of(site); }
  static const auto& cells(const auto& structure) { return structure.cells(); }
  static auto cell_at(const auto& vertex) { return vertex->cell(); }
  static std::pair<int, int> ends(const auto& edge) { return {edge.second, edge.third}; }
  /// For coplanar sites, the cells are triangles.
  static void for_each_cell(const auto& dt, auto&& use) {
    if (dt.dimension() == 3)
      for (auto c = dt.all_cells_begin(); c != dt.all_cells_end(); ++c)
        use(c, [&] { return !dt.is_infinite(c); });
    else
      for (auto f = dt.all_facets_begin(); f != dt.all_facets_end(); ++f)
        use(f->first, [&] { return !dt.is_infinite(*f); });
  }
};

/// Copies a CGAL triangulation, which may have any dimension up to `dim`.
template <int dim, class Dt>
Triangulation copy(Dt& dt, std::size_t sites, const RunContext& context) {
  Triangulation result(&context.memory);
  result.dim = dt.dimension();
  if (result.dim == 0)
    result.cells.push_back({dt.finite_vertices_begin()->info(), kNone, kNone, kNone});
  if (result.dim == 1)
    copy_edges(result, [&](auto&& add) {
      for (auto e = dt.finite_edges_begin(); e != dt.finite_edges_end(); ++e) {
        const auto [i, k] = Cgal<dim>::ends(*e);
        add(e->first->vertex(i)->info(), e->first->vertex(k)->info());
      }
    });
  if (result.dim >= 2)
    copy_cells<typename Cgal<dim>::template Cell<Dt>>(
        result, sites, [&](auto&& use) { Cgal<dim>::for_each_cell(dt, use); }, context);
  return result;
}

template <int dim, class Dt, class PointOf>
Triangulation build(const Sites& sites, PointOf&& point_of_site, const RunContext& context) {
  using Cell = typename Cgal<dim>::template Cell<Dt>;
  Dt dt;
  MemoryClaim claim(context.memory, 0);
  const auto insert = [&](uint32_t site, Cell start) {
    const auto vertex = dt.insert(point_of_site(site), start);
    // The site is hidden, so the triangulation has not changed.
    if (vertex == typename Dt::Vertex_handle()) return start;
    vertex->info() = site;
    return Cgal<dim>::cell_at(vertex);
  };
  const auto bytes_of = [](const auto& container) {
    return container.capacity() * sizeof(*container.begin());
  };
  insert_sites<Cell>(sites, context, claim, insert, [&] {
    return bytes_of(Cgal<dim>::cells(dt.tds())) + bytes_of(dt.tds().vertices());
  });
  return copy<dim>(dt, sites.size(), context);
}

template <int dim>
Triangulation triangulate(const Sites& sites, const RunContext& context) {
  using Regular = typename Cgal<dim>::Regular;
  const auto point = [&](uint32_t site) { return Cgal<dim>::point(sites.points[site]); };
  if (!sites.is_weighted()) return build<dim, typename Cgal<dim>::Delaunay>(sites, point, context);
  return build<dim, Regular>(
      sites,
      [&](uint32_t site) {
        return typename Regular::Weighted_point(point(site), sites.weights[site]);
      },
      context);
}

}  // namespace

Triangulation triangulate_plane(const Sites& sites, const RunContext& context) {
  return triangulate<2>(sites, context);
}

Triangulation triangulate_space(const Sites& sites, const RunContext& context) {
  return triangulate<3>(sites, context);
}

}  // namespace ph::alpha
