// SPDX-License-Identifier: MIT Forecasts the time and the memory that the parts of an image need,
// from a sample of its voxels. Also cuts the image into parts that need about the same time.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "libph/src/facade/parts/part_state.hpp"

namespace ph {
namespace {

using cubical::checked_whole;
using cubical::GridShape;
using cubical::WholeImage;

/// Estimates the share of minima in each layer. A minimum is a voxel that comes before all its
/// neighbours. The class reads only some rows of some layers.
template <class T>
class LayerSample {
 public:
  LayerSample(const T* voxels, const GridShape& shape, bool superlevel)
      : voxels_(voxels),
        sign_(superlevel ? -1 : 1),
        layers_(shape.axis(shape.layer_axis()).extent),
        layer_size_(shape.axis(shape.layer_axis()).stride),
        width_(shape.axis(shape.axis_count() - 1).extent) {}

  std::vector<double> minima() const {
    // One in `step` layers is read.
    constexpr std::uint64_t few = 64;
    const std::uint64_t step = std::clamp<std::uint64_t>(layers_ / few, 1, 16);
    std::vector<double> shares(layers_);
    for (std::uint64_t z = 0; z < layers_; z += step) {
      const std::uint64_t looked_at = std::min(z + step / 2, layers_ - 1);
      const double share = minima_of(looked_at);
      for (std::uint64_t i = z; i < std::min(z + step, layers_); ++i) shares[i] = share;
    }
    return shares;
  }

 private:
  double minima_of(std::uint64_t layer) const {
    constexpr std::uint64_t many = 1 << 12;  // the number of voxels
    const std::uint64_t rows = layer_size_ / width_;
    const std::uint64_t step = std::clamp<std::uint64_t>(layer_size_ / many, 1, 8);
    std::uint64_t looked_at = 0, found = 0;
    // In a layer with few rows, at least one row is read.
    // mutant: forecast-few-rows
    for (std::uint64_t y = std::min(step / 2, rows - 1); y < rows; y += step)
      for (std::uint64_t x = 0; x < width_; ++x, ++looked_at)
        if (is_minimum(layer, y, x)) ++found;
    return looked_at == 0 ? 0 : static_cast<double>(found) / static_cast<double>(looked_at);
  }
  bool is_minimum(std::uint64_t z, std::uint64_t y, std::uint64_t x) const {
    const std::uint64_t v = z * layer_size_ + y * width_ + x, rows = layer_size_ / width_;
    const double value = at(v);
    if (value != value) return false;
    const auto is_older = [&](bool exists, std::uint64_t u) {
      return exists && (at(u) < value || (at(u) == value && u < v));
    };
    return !is_older(x > 0, v - 1) && !is_older(x + 1 < width_, v + 1) &&
           !is_older(y > 0, v - width_) && !is_older(y + 1 < rows, v + width_) &&
           !is_older(z > 0, v - layer_size_) && !is_older(z + 1 < layers_, v + layer_size_);
  }
  double at(std::uint64_t v) const { return sign_ * static_cast<double>(voxels_[v]); }

  const T* voxels_;
  double sign_;
  std::uint64_t layers_, layer_size_, width_;
};

/// The time per voxel, relative to the time per voxel if no minimum is near. It was measured on
/// noise with three axes, where one voxel in seven is a minimum.
double cost(double minima, bool loops) {
  constexpr double of_components = 20, of_loops = 300;
  return 1 + (loops ? of_loops : of_components) * minima;
}

/// An upper bound for the bytes that columns of loops send across a border between parts, per
/// minimum in the layers at that border. It was measured on 256³ and 512³ voxels of noise, where
/// columns grow with the volume and often cross the border.
double bytes_across(double layer_size) {
  constexpr double of_small = 20000, small = 256, power = 3.5;
  return of_small * std::pow(std::max(1.0, std::sqrt(layer_size) / small), power);
}

/// Cuts a list of costs into `parts` consecutive pieces of about equal cost. No piece is empty.
std::vector<Index> cut(const std::vector<double>& costs, int parts) {
  const double all = std::reduce(costs.begin(), costs.end());
  const auto size = static_cast<Index>(costs.size());
  std::vector<Index> begins{0};
  double before = 0;
  for (Index i = 0; i < size && static_cast<int>(begins.size()) < parts; ++i) {
    before += costs[static_cast<std::size_t>(i)];
    const auto next = static_cast<int>(begins.size());
    const bool is_enough = before >= all * next / parts;
    // True if each remaining piece must get exactly one of the remaining items.
    const bool must = size - (i + 1) == static_cast<Index>(parts - next);
    if (is_enough || must) begins.push_back(i + 1);  // mutant: part-last-layers
  }
  return begins;
}

void raise(ImagePartForecast::Bytes& bytes, const ImagePartForecast::Bytes& by) {
  bytes = {std::max(bytes.low, by.low), std::max(bytes.high, by.high)};
}

}  // namespace

ImagePartForecast ImagePart::forecast(const Image& image, int parts,
                                      const ImagePartOptions& options) {
  const WholeImage whole = checked_whole(image, parts, options);
  const GridShape shape(whole.image());
  const cubical::PartLayout layout = whole.layout(shape);
  const std::vector<double> minima = with_voxels(
      whole.type, image.values.data(),
      [&](const auto* voxels) { return LayerSample(voxels, shape, whole.superlevel).minima(); });
  std::vector<double> costs(minima.size());
  std::ranges::transform(minima, costs.begin(), [&](double m) { return cost(m, whole.loops); });
  const double mean_cost = std::reduce(costs.begin(), costs.end()) / parts;

  const bool vertices = whole.loops || cubical::wants_vertices(shape, whole.wanted());
  const bool tops = whole.loops || cubical::wants_top_cells(shape, whole.wanted());
  const auto layer_size = static_cast<double>(layout.layer_size());
  // These byte counts were measured on noise, waves and blurred noise of 128³ to 512³ voxels. A
  // seam stores values, roots, and components that may still be joined there. Each minimum gives
  // one bar. The other graph and the loops give, on average, a fixed number of bars per minimum.
  const double seam = layer_size * ((vertices ? 48 : 0) + (tops ? 25 : 0));
  const double bar = whole.cells ? 72 : 24;
  const double bars = bar * ((vertices ? 1 : 0) + (tops ? 0.3 : 0)),
               loops = whole.loops ? bar * 1.3 : 0;
  const double of_minimum = whole.loops ? 500 : 250;
  constexpr double of_process = 2 << 20;  // code, stacks, and memory kept by allocators

  ImagePartForecast forecast;
  forecast.first_layers = cut(costs, parts);
  double seams_of_all = 0, minima_of_all = 0, minima_of_first = 0;
  for (int p = 0; p < parts; ++p) {
    const auto own = layout.turned(layout.own(p));
    const auto sum = [&](const std::vector<double>& some) {
      return std::accumulate(some.begin() + static_cast<std::ptrdiff_t>(own.begin),
                             some.begin() + static_cast<std::ptrdiff_t>(own.end), 0.0);
    };
    const double voxels = static_cast<double>(own.count()) * layer_size;
    const double minima_here = sum(minima) * layer_size;
    const double seams = seam * static_cast<double>(layout.ghosts(p).size());
    const double read = static_cast<double>(bytes_of(whole.type)) * voxels;
    seams_of_all += seams;
    minima_of_all += minima_here;
    if (p == 0) minima_of_first = minima_here;
    forecast.longest = std::max(forecast.longest, sum(costs) / mean_cost);
    raise(forecast.file, {seams, 1.2 * seams + 1.5 * bars * minima_here + 1024});
    raise(forecast.memory,
          {whole.loops ? read + 8 * voxels : seams,
           read + 10 * voxels + of_minimum * minima_here + 2 * seams + of_process});
  }
  const double bars_of_all = (bars + loops) * minima_of_all;
  forecast.join = {seams_of_all / 2, 2 * seams_of_all + 4 * bars_of_all + (4 << 20)};
  // All bars are sent to the first rank, most of them in one step. Each seam is sent once, except
  // for the seams of the first part.
  const double share_of_others = minima_of_all > 0 ? 1 - minima_of_first / minima_of_all : 0;
  const double borders = seam > 0 ? seams_of_all / (2 * seam) : 0;
  const double across = whole.loops ? borders * bytes_across(layer_size) * minima_of_all /
                                          static_cast<double>(minima.size())
                                    : 0;
  forecast.sent = {seams_of_all / 2,
                   1.2 * seams_of_all + 2 * share_of_others * bars_of_all + across};
  return forecast;
}

}  // namespace ph
