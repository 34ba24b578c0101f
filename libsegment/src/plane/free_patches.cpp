// SPDX-License-Identifier: MIT
#include "plane/free_patches.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <utility>

namespace ph::segment {
namespace {

/// The plane as squared paper around the foot of the viewpoint. It repeats itself so far away that
/// squares which are taken for one are only in the way of each other. Each square has 64 parts.
class SquaredPaper {
 public:
  static constexpr std::size_t kColumns = 128, kCount = kColumns * kColumns;
  struct Place {
    std::uint32_t square;
    std::uint32_t part;  ///< 0 to 63
  };

  SquaredPaper(const CloudView& cloud, const Plane& plane, double side) : cloud_(cloud) {
    const Eigen::Vector3d n(plane.normal.data()), eye(cloud.viewpoint.data());
    const double part = side / kParts;
    axes_[0] = n.unitOrthogonal() / part;
    axes_[1] = n.cross(axes_[0]);
    for (std::size_t k = 0; k < 2; ++k) foot_[k] = axes_[k].dot(eye);
  }
  /// What a point is over.
  Place of(Index i) const {
    const float* p = cloud_.point(static_cast<std::size_t>(i));
    const std::uint32_t x = column(p, 0), y = column(p, 1);
    return {y / kParts * std::uint32_t{kColumns} + x / kParts, y % kParts * kParts + x % kParts};
  }
  /// The square of the distance of its centre from the foot, in sides.
  static double farness(std::size_t square) {
    const auto away = [](std::size_t column) {
      return static_cast<double>(column) - (static_cast<double>(kColumns) - 1) / 2;
    };
    const double x = away(square % kColumns), y = away(square / kColumns);
    return x * x + y * y;
  }

 private:
  static constexpr std::uint32_t kParts = 8;  // a side

  /// In parts.
  std::uint32_t column(const float* p, std::size_t k) const {
    const double place = axes_[k][0] * p[0] + axes_[k][1] * p[1] + axes_[k][2] * p[2] - foot_[k];
    // Shifted by a multiple of the columns to what is positive, so that a cast rounds it down.
    constexpr double shift = 1ULL << 40, middle = kColumns * kParts / 2;
    const double shifted = std::clamp(place + (shift + middle), 0.0, 2 * shift);
    return static_cast<std::uint32_t>(static_cast<std::uint64_t>(shifted) % (kColumns * kParts));
  }

  const CloudView& cloud_;
  std::array<Eigen::Vector3d, 2> axes_;
  std::array<double, 2> foot_{};
};

/// Evenly by how far they are.
std::vector<std::size_t> some_of(std::vector<std::size_t> squares, std::size_t most) {
  std::ranges::sort(squares, {},
                    [](std::size_t s) { return std::pair(SquaredPaper::farness(s), s); });
  const std::size_t count = std::min(most, squares.size());
  for (std::size_t k = 0; k < count; ++k)
    squares[k] = squares[(2 * k + 1) * squares.size() / (2 * count)];
  squares.resize(count);
  return squares;
}

}  // namespace

std::vector<Index> free_patches(const CloudView& cloud, const std::vector<Index>& on_plane,
                                const std::vector<Index>& beyond, const Plane& plane, double side) {
  constexpr std::size_t most = 32;  // squares: what it takes is bounded
  // Parts, not points: points that are there twice tell nothing new.
  constexpr int most_above = 2;  // an object covers more, flying pixels fewer
  constexpr int fewest = 32;     // of 64
  const SquaredPaper paper(cloud, plane, side);
  std::vector<std::uint64_t> above(SquaredPaper::kCount), on(SquaredPaper::kCount);
  const auto mark = [](std::vector<std::uint64_t>& squares, const SquaredPaper::Place& place) {
    squares[place.square] |= std::uint64_t{1} << place.part;
  };
  for (const Index i : beyond) mark(above, paper.of(i));
  std::vector<std::uint16_t> square_of;
  square_of.reserve(on_plane.size());
  for (const Index i : on_plane) {
    const SquaredPaper::Place place = paper.of(i);
    square_of.push_back(static_cast<std::uint16_t>(place.square));
    mark(on, place);
  }
  std::vector<std::size_t> squares;
  for (std::size_t s = 0; s < on.size(); ++s)
    if (std::popcount(on[s]) >= fewest && std::popcount(above[s]) <= most_above)
      squares.push_back(s);
  std::vector<bool> chosen(SquaredPaper::kCount);
  for (const std::size_t s : some_of(std::move(squares), most)) chosen[s] = true;
  std::vector<Index> found;
  for (std::size_t k = 0; k < on_plane.size(); ++k)
    if (chosen[square_of[k]]) found.push_back(on_plane[k]);
  return found;
}

}  // namespace ph::segment
