// SPDX-License-Identifier: MIT
#include "ph/detail/complex/listed_cubes.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numeric>

#include "ph/barcode.hpp"
#include "ph/error.hpp"

namespace ph {
namespace {

using Coordinates = std::vector<Index>;
constexpr Index kNotThere = -1;
// The number of bytes per entry, for the matrix and for the complex that is made from it.
constexpr std::size_t kBytesPerEntry = 40;

/// The cubes of an image, as points of the doubled grid. The coordinate of a cube is odd along each
/// axis in which the cube extends, and even along each other axis.
class Cubes {
 public:
  Cubes(const Image& image, const CubicalOptions& options) : image_(image), options_(options) {
    for (std::size_t k = 0; k < image.extents.size(); ++k) {
      periodic_.push_back(k < options.periodic.size() && options.periodic[k]);
      const Index n = image.extents[k];
      lengths_.push_back(2 * n + (periodic_[k] ? 0 : voxels_are_vertices() ? -1 : 1));
    }
  }

  Index size() const {
    return std::accumulate(lengths_.begin(), lengths_.end(), Index{1}, std::multiplies<>());
  }
  Coordinates coordinates(Index number) const {
    Coordinates x(lengths_.size());
    for (std::size_t k = x.size(); k-- > 0; number /= lengths_[k]) x[k] = number % lengths_[k];
    return x;
  }
  Index number_of(const Coordinates& x) const {
    Index number = 0;
    for (std::size_t k = 0; k < x.size(); ++k) number = number * lengths_[k] + x[k];
    return number;
  }
  /// The value at which a cube enters, or infinity if the cube never enters.
  double value(const Coordinates& x) const {
    const double value = extreme_value(x, 0, 0);
    return value <= options_.threshold.value_or(kInfinity) ? value : kInfinity;
  }
  /// Calls `visit(facet, incidence)` for each facet of cube x across axis k. The coordinate x[k]
  /// must be odd.
  template <class Visit>
  void for_each_facet(const Coordinates& x, std::size_t k, Visit&& visit) const {
    int sign = 1;
    for (std::size_t axis = 0; axis < k; ++axis) sign = x[axis] % 2 != 0 ? -sign : sign;
    Coordinates lower = x, upper = x;
    lower[k] = x[k] - 1;
    upper[k] = (x[k] + 1) % lengths_[k];
    if (lower == upper) return;  // the cube goes once around the axis, and its two ends cancel
    visit(upper, sign);
    visit(lower, -sign);
  }

 private:
  bool voxels_are_vertices() const {
    return options_.construction == CubicalOptions::Construction::vertices;
  }
  /// Returns the value of the last voxel of cube x (V-construction) or of its first voxel
  /// (T-construction). The recursion handles axis k and the axes after it.
  /// @param voxel the position of the voxel along the axes before k, as one row-major index.
  double extreme_value(const Coordinates& x, std::size_t k, Index voxel) const {
    if (k == x.size()) return voxel_value(voxel);
    const Index n = image_.extents[k];
    const bool is_at_voxel = (x[k] % 2 == 0) == voxels_are_vertices();
    const Index first = is_at_voxel ? x[k] / 2 : (x[k] + 1) / 2 - 1,
                last = is_at_voxel ? first : first + 1;
    double result = voxels_are_vertices() ? -kInfinity : kInfinity;
    for (Index i = first; i <= last; ++i) {
      if (!periodic_[k] && (i < 0 || i >= n)) continue;
      const double value = extreme_value(x, k + 1, voxel * n + (i + n) % n);
      result = voxels_are_vertices() ? std::max(result, value) : std::min(result, value);
    }
    return result;
  }
  double voxel_value(Index voxel) const {
    const double value = image_.values[static_cast<std::size_t>(voxel)];
    if (std::isnan(value)) return kInfinity;  // mutant: listed-cubes-absent
    return options_.superlevel ? -value : value;
  }

  const Image& image_;
  const CubicalOptions& options_;
  std::vector<bool> periodic_;
  std::vector<Index> lengths_;
};

}  // namespace

ExplicitComplex listed_cubes(const Image& image, const CubicalOptions& options,
                             const RunContext& context) {
  const Cubical checked(image, options, context);  // the constructor refuses an invalid image
  BoundaryMatrix matrix;
  if (image.values.empty()) return ExplicitComplex::from_boundary(matrix, {}, context);
  const Cubes cubes(image, options);
  const auto count = static_cast<std::size_t>(cubes.size());
  const MemoryClaim claim(context.memory, count * (image.extents.size() + 1) * kBytesPerEntry);
  // All cubes are numbered before facets are listed, because a facet may come after its cube.
  std::vector<Index> numbers(count, kNotThere);
  std::vector<double> values(count);
  Index there = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (i % 4096 == 0) context.poll();
    values[i] = cubes.value(cubes.coordinates(static_cast<Index>(i)));
    if (values[i] < kInfinity) numbers[i] = there++;
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (i % 4096 == 0) context.poll();
    if (numbers[i] == kNotThere) continue;
    const Coordinates x = cubes.coordinates(static_cast<Index>(i));
    int dim = 0;
    for (std::size_t k = 0; k < x.size(); ++k) {
      if (x[k] % 2 == 0) continue;
      ++dim;
      cubes.for_each_facet(x, k, [&](const Coordinates& facet, int incidence) {
        matrix.rows.push_back(numbers[static_cast<std::size_t>(cubes.number_of(facet))]);
        matrix.incidences.push_back(incidence);
      });
    }
    matrix.dims.push_back(dim);
    matrix.values.push_back(values[i]);
    matrix.offsets.push_back(matrix.rows.size());
  }
  return ExplicitComplex::from_boundary(matrix, {}, context);
}

}  // namespace ph
