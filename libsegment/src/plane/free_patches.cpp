// SPDX-License-Identifier: MIT
#include "libsegment/src/plane/stages.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <utility>

namespace ph::segment {
namespace {

/// The plane, divided into squares of 64 parts each around the foot of the viewpoint. The numbers
/// of the squares repeat, but squares with the same number are so far apart that sharing a number
/// can at most exclude both of them.
class SquaredPaper {
 public:
  static constexpr std::size_t kColumns = 128, kCount = kColumns * kColumns;
  /// Consecutive points over one square.
  struct Run {
    std::uint32_t square;
    std::uint64_t parts;  ///< one bit for each part that they cover
    std::size_t points;   ///< number of points
  };

  SquaredPaper(const CloudView& cloud, const Plane& plane, double side) : cloud_(cloud) {
    const Eigen::Vector3d n(plane.normal.data()), eye(cloud.viewpoint.data());
    const double part = side / kParts;
    const Eigen::Vector3d across = n.unitOrthogonal() / part, along = n.cross(across);
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      steps_[static_cast<std::size_t>(axis)] = {across[axis], along[axis]};
    constexpr double middle = kColumns * kParts / 2;
    origin_ = Eigen::Array2d(middle - across.dot(eye), middle - along.dot(eye));
  }
  /// Calls `use` for each run. In the order of an image, many consecutive points are over the same
  /// square.
  template <class Use>
  void for_each_run(const std::vector<Index>& points, Use&& use) const {
    Run run{};
    for (const Index i : points) {
      const auto [x, y] = place_of(cloud_.point(static_cast<std::size_t>(i)));
      const std::uint32_t square = y / kParts * std::uint32_t{kColumns} + x / kParts;
      if (square != run.square) {
        if (run.points > 0) use(run);
        run = {square, 0, 0};
      }
      run.parts |= std::uint64_t{1} << (y % kParts * kParts + x % kParts);  // mutant: noise-twice
      ++run.points;
    }
    if (run.points > 0) use(run);
  }
  /// The squared distance of a square's centre from the foot of the viewpoint, in units of a side.
  static double farness(std::size_t square) {
    const auto away = [](std::size_t column) {
      return static_cast<double>(column) - (static_cast<double>(kColumns) - 1) / 2;
    };
    const double x = away(square % kColumns), y = away(square / kColumns);
    return x * x + y * y;
  }

 private:
  static constexpr std::uint32_t kParts = 8;  // parts per side

  /// The column and the row of a point, counted in parts.
  std::array<std::uint32_t, 2> place_of(const float* p) const {
    // Near `whole`, neighbouring doubles differ by one. Adding `whole` therefore rounds a place to
    // a whole number. The last bits of the sum contain this number even if it is negative.
    // Subtracting `half` first makes the rounding go down. Points too far away for this computation
    // may get any part.
    constexpr double whole = 1.5 * (1ULL << 52), half = 0.5;
    const Eigen::Array2d place = steps_[0] * p[0] + steps_[1] * p[1] + steps_[2] * p[2] + origin_;
    const Eigen::Array2d shifted = (place - half) + whole;
    const auto last_bits = [](double number) {
      return static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(number) % (kColumns * kParts));
    };
    return {last_bits(shifted[0]), last_bits(shifted[1])};
  }

  const CloudView& cloud_;
  std::array<Eigen::Array2d, 3> steps_;  // columns and rows per metre along each axis of the cloud
  Eigen::Array2d origin_;
};

/// Chooses at most `most` squares, evenly spread by their distance from the foot of the viewpoint.
std::vector<std::size_t> some_of(std::vector<std::size_t> squares, std::size_t most) {
  std::ranges::sort(squares, {},
                    [](std::size_t s) { return std::pair(SquaredPaper::farness(s), s); });
  const std::size_t count = std::min(most, squares.size());
  for (std::size_t k = 0; k < count; ++k)
    squares[k] = squares[(2 * k + 1) * squares.size() / (2 * count)];  // mutant: noise-squares
  squares.resize(count);
  return squares;
}

}  // namespace

std::vector<Index> free_patches(const CloudView& cloud, const std::vector<Index>& on_plane,
                                const std::vector<Index>& beyond, const Plane& plane, double side) {
  constexpr std::size_t most = 24;  // the largest number of squares, which limits the work
  // Parts are counted instead of points, because duplicate points carry no information.
  // An object covers more parts, and flying pixels cover fewer parts.
  constexpr int most_above = 2;
  constexpr int fewest = 32;  // of the 64 parts of a square
  const SquaredPaper paper(cloud, plane, side);
  std::vector<std::uint64_t> above(SquaredPaper::kCount), on(SquaredPaper::kCount);
  std::vector<SquaredPaper::Run> runs;
  paper.for_each_run(beyond, [&](const SquaredPaper::Run& r) { above[r.square] |= r.parts; });
  paper.for_each_run(on_plane, [&](const SquaredPaper::Run& r) {
    on[r.square] |= r.parts;
    runs.push_back(r);
  });
  std::vector<std::size_t> squares;
  for (std::size_t s = 0; s < on.size(); ++s)
    // mutant: noise-free
    if (std::popcount(on[s]) >= fewest && std::popcount(above[s]) <= most_above)
      squares.push_back(s);
  std::vector<bool> chosen(SquaredPaper::kCount);
  for (const std::size_t s : some_of(std::move(squares), most)) chosen[s] = true;
  std::vector<Index> found;
  auto first = on_plane.begin();
  for (const SquaredPaper::Run& run : runs) {
    const auto end = first + static_cast<std::ptrdiff_t>(run.points);
    if (chosen[run.square]) found.insert(found.end(), first, end);
    first = end;
  }
  return found;
}

}  // namespace ph::segment
