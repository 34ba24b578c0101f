// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

#include "ph/scene_tree.hpp"

namespace ph::segment {

// A stored tree consists of a header of little-endian 8-byte numbers (int64 or float64), the
// arrays, and a checksum. Values that follow from other values are not stored and therefore cannot
// contradict them. Examples are the elder and the younger side of a merge, and sizes.
inline constexpr std::string_view kTreeMagic = "ph-tree\n";
inline constexpr std::int64_t kTreeVersion = 4;
inline constexpr std::size_t kTreeWord = 8, kTreeHeader = 28 * kTreeWord;
inline constexpr std::size_t kTreeSum = 4;
// The entry of a point without a vertex is this number minus the number of the removed surface that
// contains the point. The number of the surface is 0 if no removed surface contains the point.
inline constexpr std::uint32_t kTreeNoVertex = UINT32_MAX;
inline constexpr std::size_t kTreeSurface = 21 * kTreeWord, kTreeNoise = 2 * kTreeWord;

/// Calls `use(vertex, point)` for each point of the cloud. The vertex is empty if the point has no
/// vertex.
template <class Use>
void for_each_point(const SceneTree& scene, Use&& use) {
  std::size_t next = 0;
  for (std::size_t i = 0; i < scene.cloud_size(); ++i) {
    const bool has_vertex = next < scene.points.size() && std::cmp_equal(scene.points[next], i);
    use(has_vertex ? std::optional(scene.vertex_of_point[next++]) : std::nullopt, i);
  }
}

/// The checksum of a stored tree: the CRC-32 of all bytes before it.
std::uint32_t tree_sum(std::string_view bytes);

}  // namespace ph::segment
