// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>

#include "libsegment/src/scene/options.hpp"
#include "libsegment/src/tree/tree_file.hpp"
#include "ph/detail/segment/json_text.hpp"

namespace ph::segment {
namespace {

using namespace json;

std::string row(const Points& points, Index i) {
  return numbers(Vec3{points(i, 0), points(i, 1), points(i, 2)});
}

std::string vertices_of(const SceneTree& scene) {
  return lines(scene.counts, [&, v = Index{0}](Index count) mutable {
    const Index i = v++;
    const bool has_normal = i < scene.normals.rows() && std::isfinite(scene.normals(i, 0));
    return object({{"centroid", row(scene.vertices, i)},
                   {"normal", has_normal ? row(scene.normals, i) : "null"},
                   {"points", integer(count)},
                   {"birth", number(scene.merge_tree.births[static_cast<std::size_t>(i)])}});
  });
}

std::string merges_of(const MergeTree& tree) {
  return lines(tree.merges, [](const Merge& m) {
    return object({{"value", number(m.value)},
                   {"edge", array(std::array{m.u, m.v}, integer<Index>)},
                   {"elder", integer(m.elder)},
                   {"younger", integer(m.younger)},
                   {"elder_size", integer(m.elder_size)},
                   {"younger_size", integer(m.younger_size)},
                   {"elder_birth", number(m.elder_birth)},
                   {"younger_birth", number(m.younger_birth)}});
  });
}

std::string vertex_of_point(const SceneTree& scene) {
  std::string text;
  for_each_point(scene, [&](std::optional<std::uint32_t> vertex, std::size_t) {
    if (!text.empty()) text += ", ";
    if (vertex)
      fmt::format_to(std::back_inserter(text), "{}", *vertex);
    else
      text += "-1";
  });
  return "[" + text + "]";
}

std::string plane_of(const std::optional<Plane>& plane) {
  if (!plane) return "null";
  return object({{"normal", numbers(plane->normal)},
                 {"offset", number(plane->offset)},
                 {"share", number(plane->share)}});
}

}  // namespace

std::string tree_json(const SceneTree& scene) {
  validate(scene);
  const bool paper = scene.method == Method::paper;
  return document({{"format", json::string("ph-segment-tree")},
                   {"version", "2"},
                   {"method", json_of(scene.method)},
                   {"width", integer(scene.width)},
                   {"height", integer(scene.height)},
                   {"voxel", number(scene.voxel)},
                   {"distance", paper ? number(scene.distance) : "null"},
                   {"steps", !paper             ? "null"
                             : scene.steps == 0 ? json::string("exact")
                                                : integer(scene.steps)},
                   {"viewpoint", numbers(scene.viewpoint)},
                   {"plane", plane_of(scene.plane)},
                   {"surfaces", json_of(scene.surfaces)},
                   {"noise", json_of(scene.noise)},
                   {"cut", json_of(scene.first_cut)},
                   {"edges", integer(scene.edges)},
                   {"vertices", vertices_of(scene)},
                   {"merges", merges_of(scene.merge_tree)},
                   {"vertex_of_point", vertex_of_point(scene)}});
}

}  // namespace ph::segment
