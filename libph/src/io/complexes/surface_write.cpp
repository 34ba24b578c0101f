// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "ph/detail/core/lower_case.hpp"
#include "ph/error.hpp"
#include "ph/io/write.hpp"

namespace ph {
namespace {

// The largest number that a point can have in PLY.
constexpr Index kMostNumber = std::numeric_limits<std::uint32_t>::max();

/// The points that are corners of triangles, ascending.
std::vector<Index> points_of(const SurfaceMesh& mesh) {
  std::vector<Index> points;
  points.reserve(3 * mesh.triangles.size());
  for (const auto& triangle : mesh.triangles)
    points.insert(points.end(), triangle.begin(), triangle.end());
  std::ranges::sort(points);
  points.erase(std::ranges::unique(points).begin(), points.end());
  return points;
}

std::array<double, 3> coordinates_of(PointsView points, Index point) {
  std::array<double, 3> at{};
  for (Index axis = 0; axis < points.cols(); ++axis)
    at[static_cast<std::size_t>(axis)] = points(point, axis);
  return at;
}

/// Collects bytes and writes them in large pieces.
class Buffer {
 public:
  explicit Buffer(OutputFile& file) : file_(file) {}
  template <class T>
  void add_bytes(const T& value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    add({bytes, sizeof value});
  }
  void add(std::string_view text) {
    constexpr std::size_t most = 1 << 16;
    bytes_ += text;
    if (bytes_.size() >= most) flush();
  }
  void flush() {
    file_.write(bytes_);
    bytes_.clear();
  }

 private:
  OutputFile& file_;
  std::string bytes_;
};

}  // namespace

std::optional<SurfaceFormat> surface_format_of_path(std::string_view path) {
  const auto has = [&](std::string_view extension) {
    return path.size() > extension.size() && ends_in(path, extension);
  };
  if (has(".ply")) return SurfaceFormat::ply;
  if (has(".off")) return SurfaceFormat::off;
  return std::nullopt;
}

void write_surface(OutputFile& file, PointsView points, const SurfaceMesh& mesh,
                   SurfaceFormat format, std::span<const Index> ids) {
  if (points.cols() > 3 || (points.cols() < 2 && points.rows() > 0))
    throw Error(ErrorKind::usage,
                fmt::format("surface: found points of R^{}, expected R^2 or R^3", points.cols()));
  if (mesh.regular > mesh.triangles.size())
    throw Error(
        ErrorKind::usage,
        fmt::format(
            "surface: found {} regular triangles, expected at most {}, the number of triangles",
            mesh.regular, mesh.triangles.size()));
  const std::vector<Index> used = points_of(mesh);
  if (!used.empty() && (used.front() < 0 || used.back() >= points.rows()))
    throw Error(ErrorKind::usage,
                fmt::format("surface: found a corner at point {}, expected 0 to {}",
                            used.front() < 0 ? used.front() : used.back(), points.rows() - 1));
  if (!ids.empty() && static_cast<Index>(ids.size()) != points.rows())
    throw Error(ErrorKind::usage, fmt::format("surface: found numbers for {} points, expected {}",
                                              ids.size(), points.rows()));
  const auto number_of = [ids](Index point) {
    return ids.empty() ? point : ids[static_cast<std::size_t>(point)];
  };
  for (const Index point : used)
    if (const Index number = number_of(point); number < 0 || number > kMostNumber)
      throw Error(ErrorKind::usage, fmt::format("surface: found point number {}, expected 0 to {}",
                                                number, kMostNumber));
  const auto place_of = [&](Index point) {
    return static_cast<std::int32_t>(std::ranges::lower_bound(used, point) - used.begin());
  };
  const std::size_t triangles = mesh.triangles.size();
  Buffer to(file);
  if (format == SurfaceFormat::off) {
    to.add(fmt::format("OFF\n{} {} 0\n", used.size(), triangles));
    for (const Index point : used) {
      const auto [x, y, z] = coordinates_of(points, point);
      to.add(fmt::format("{} {} {}\n", shortest(x), shortest(y), shortest(z)));
    }
    for (const auto& [a, b, c] : mesh.triangles)
      to.add(fmt::format("3 {} {} {}\n", place_of(a), place_of(b), place_of(c)));
    to.flush();
    return;
  }
  to.add(
      fmt::format("ply\nformat binary_little_endian 1.0\ncomment libph\n"
                  "element vertex {}\nproperty double x\nproperty double y\n"
                  "property double z\nproperty uint point\n"
                  "element face {}\nproperty list uchar int vertex_indices\n"
                  "property uchar singular\nend_header\n",
                  used.size(), triangles));
  for (const Index point : used) {
    for (const double x : coordinates_of(points, point)) to.add_bytes(x);
    to.add_bytes(static_cast<std::uint32_t>(number_of(point)));
  }
  for (std::size_t i = 0; i < triangles; ++i) {
    to.add_bytes(std::uint8_t{3});
    for (const Index point : mesh.triangles[i]) to.add_bytes(place_of(point));
    to.add_bytes(static_cast<std::uint8_t>(i >= mesh.regular));
  }
  to.flush();
}

}  // namespace ph
