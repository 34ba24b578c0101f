// SPDX-License-Identifier: MIT
#include "apps/common/inputs/read_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "apps/common/values/numbers.hpp"
#include "ph/error.hpp"

namespace ph::app {

std::optional<PointsView> points_of(const ReadResult& read) {
  if (const auto* mesh = std::get_if<Mesh>(&read.data)) return mesh->vertices;
  if (const auto* points = std::get_if<Points>(&read.data)) return *points;
  return std::nullopt;
}

std::size_t bytes_of(const ReadResult& read) {
  struct Size {
    std::size_t operator()(const Points& points) const {
      return static_cast<std::size_t>(points.size()) * sizeof(double);
    }
    std::size_t operator()(const DistanceMatrix& distances) const {
      const auto n = static_cast<std::size_t>(distances.size());
      return n * (n - std::min<std::size_t>(n, 1)) / 2 * sizeof(double);
    }
    std::size_t operator()(const SparseDistances& distances) const {
      return distances.edges().size() * sizeof(WeightedEdge);
    }
    std::size_t operator()(const Image& image) const { return image.values.bytes(); }
    // The simplices become the complex itself.
    std::size_t operator()(const SimplicesInput&) const { return 0; }
    std::size_t operator()(const BoundaryInput&) const { return 0; }
    std::size_t operator()(const Mesh& mesh) const {
      return (*this)(mesh.vertices) + mesh.corners.size() * sizeof(Index);
    }
  };
  return std::visit(Size{}, read.data);
}

void require_no_dropped_points(const std::string& name, std::size_t dropped) {
  if (dropped > 0)
    throw Error(
        ErrorKind::bad_data,
        fmt::format("{}: found {} with NaN, expected numbers; --nan drop leaves such points out",
                    mark_place(name), count_of(dropped, "point")));
}

}  // namespace ph::app
