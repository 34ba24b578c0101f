// SPDX-License-Identifier: MIT
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Regular_triangulation_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include "alpha/cgal/cells_of.hpp"

namespace ph::alpha {
namespace {

using std::uint32_t;

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
Triangulation copy(Dt& dt, std::size_t sites, const RunContext& context) {
  using Face = typename Dt::Face_handle;
  Triangulation result(&context.memory);
  result.dim = dt.dimension();
  if (result.dim == 0)
    result.cells.push_back({dt.finite_vertices_begin()->info(), kNone, kNone, kNone});
  if (result.dim == 1)
    copy_edges(result, [&](auto&& add) {
      for (auto e = dt.finite_edges_begin(); e != dt.finite_edges_end(); ++e)
        add(e->first->vertex(dt.cw(e->second))->info(),
            e->first->vertex(dt.ccw(e->second))->info());
    });
  if (result.dim == 2)
    copy_cells<Face>(
        result, sites,
        [&](auto&& use) {
          for (auto f = dt.all_faces_begin(); f != dt.all_faces_end(); ++f)
            use(f, [&] { return !dt.is_infinite(f); });
        },
        context);
  return result;
}

template <class Dt, class PointOf>
Triangulation build(const Sites& sites, PointOf&& point_of_site, const RunContext& context) {
  using Face = typename Dt::Face_handle;
  Dt dt;
  MemoryClaim claim(context.memory, 0);
  const auto insert = [&](uint32_t site, Face start) {
    const auto vertex = dt.insert(point_of_site(site), start);
    vertex->info() = site;
    return vertex->face();
  };
  insert_sites<Face>(sites, context, claim, insert, [&] {
    return dt.tds().faces().capacity() * sizeof(typename Dt::Face) +
           dt.tds().vertices().capacity() * sizeof(typename Dt::Vertex);
  });
  return copy(dt, sites.size(), context);
}

}  // namespace

Triangulation triangulate_plane(const Sites& sites, const RunContext& context) {
  const auto planar = [&](uint32_t site) {
    return Kernel::Point_2(sites.points[site].x, sites.points[site].y);
  };
  if (!sites.is_weighted()) return build<Delaunay>(sites, planar, context);
  return build<Regular>(
      sites,
      [&](uint32_t site) { return Regular::Weighted_point(planar(site), sites.weights[site]); },
      context);
}

}  // namespace ph::alpha
