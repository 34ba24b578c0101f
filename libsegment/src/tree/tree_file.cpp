// SPDX-License-Identifier: MIT
#include "libsegment/src/tree/tree_file.hpp"

#include <zlib.h>

#include <bit>
#include <iterator>

#include "libsegment/src/scene/options.hpp"
#include "ph/scene_tree.hpp"

namespace ph::segment {
namespace {

template <class T>
void put(std::string& bytes, T value) {
  if constexpr (std::endian::native == std::endian::little) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  } else {
    const auto* first = reinterpret_cast<const char*>(&value);
    bytes.append(std::make_reverse_iterator(first + sizeof value),
                 std::make_reverse_iterator(first));
  }
}
template <class Numbers>
void put_all(std::string& bytes, const Numbers& numbers) {
  for (const auto number : numbers) put(bytes, number);
}
void put_all(std::string& bytes, const Points& points) {
  for (Index i = 0; i < points.rows(); ++i)
    for (Index k = 0; k < points.cols(); ++k) put(bytes, points(i, k));
}

}  // namespace

std::uint32_t tree_sum(std::string_view bytes) {
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

std::string tree_bytes(const SceneTree& scene) {
  validate(scene);
  std::string bytes(kTreeMagic);
  const std::size_t n = scene.cells.size();
  bytes.reserve(kTreeHeader + kTreeSum + n * 11 * kTreeWord +
                scene.merge_tree.merges.size() * 2 * kTreeWord + scene.cloud_size() * 4 +
                scene.xyz.size() * 4 + scene.surfaces.size() * kTreeSurface +
                scene.noise.size() * kTreeNoise);
  const auto integer = [&](std::int64_t value) { put(bytes, value); };
  const auto number = [&](double value) { put(bytes, value); };
  for (const std::int64_t value :
       {kTreeVersion, static_cast<std::int64_t>(scene.method), scene.width, scene.height,
        static_cast<std::int64_t>(n), static_cast<std::int64_t>(scene.merge_tree.merges.size()),
        static_cast<std::int64_t>(scene.xyz.size() / 3), scene.edges})
    integer(value);
  number(scene.voxel);
  put_all(bytes, scene.viewpoint);
  number(scene.distance);
  integer(scene.steps);
  integer(scene.plane.has_value());
  const Plane plane = scene.plane.value_or(Plane());
  put_all(bytes, plane.normal);
  number(plane.offset);
  number(plane.share);
  number(scene.first_cut.value);
  integer(scene.first_cut.min_part);
  integer(scene.first_cut.min_size);
  integer(scene.first_cut.objects);
  integer(std::ssize(scene.surfaces));
  integer(scene.removed);
  integer(std::ssize(scene.noise));
  for (const SceneSurface& surface : scene.surfaces) {
    integer(static_cast<std::int64_t>(surface.role));
    put_all(bytes, surface.plane.normal);
    number(surface.plane.offset);
    number(surface.plane.share);
    put_all(bytes, surface.oriented_box.centre);
    for (const Vec3& axis : surface.oriented_box.axes) put_all(bytes, axis);
    put_all(bytes, surface.oriented_box.size);
  }
  for (const NoiseAt& noise : scene.noise) {
    number(noise.range);
    number(noise.concavity);
  }

  for (const Vec3& cell : scene.cells) put_all(bytes, cell);
  put_all(bytes, scene.vertices);
  put_all(bytes, scene.normals);
  put_all(bytes, scene.counts);
  put_all(bytes, scene.merge_tree.births);
  for (const Merge& m : scene.merge_tree.merges) {
    number(m.value);
    put(bytes, static_cast<std::uint32_t>(m.u));
    put(bytes, static_cast<std::uint32_t>(m.v));
  }
  for_each_point(scene, [&](std::optional<std::uint32_t> vertex, std::size_t point) {
    put(bytes, vertex.value_or(kTreeNoVertex - scene.removed_with[point]));
  });
  put_all(bytes, scene.xyz);
  put(bytes, tree_sum(bytes));
  return bytes;
}

}  // namespace ph::segment
