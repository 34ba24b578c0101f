// SPDX-License-Identifier: MIT
#include "libph/src/rips/make_graph.hpp"

#include <algorithm>
#include <limits>
#include <random>

namespace ph {
namespace {

constexpr int kSampledPairs = 20'000, kSampledPoints = 32;

double pairs_of(Index points) {
  return static_cast<double>(points) * static_cast<double>(points - 1) / 2;
}

/// A sequence of random points, given by numbers 0 … size - 1. It is the same on every platform.
class RandomPoints {
 public:
  explicit RandomPoints(Index size) : size_(static_cast<std::uint64_t>(size)) {}
  Index next() { return static_cast<Index>(random_() % size_); }

 private:
  std::mt19937_64 random_{1};
  std::uint64_t size_;
};

template <Metric M>
std::vector<double> distances_of(const M& metric) {
  std::vector<double> distances;
  if (metric.size() < 2) return distances;
  RandomPoints random(metric.size());
  for (int i = 0; i < kSampledPairs; ++i) {
    const Index a = random.next(), b = random.next();
    if (a != b) distances.push_back(metric(a, b));
  }
  std::ranges::sort(distances);
  return distances;
}

/// An upper bound for the enclosing radius. For each of some sampled points, the distance to the
/// point farthest from it is computed. The least of these distances is the bound.
template <Metric M>
double radius_of(const M& metric, const RunContext& context) {
  double least = std::numeric_limits<double>::infinity();
  if (metric.size() == 0) return least;
  RandomPoints random(metric.size());
  for (int i = 0; i < kSampledPoints; ++i) {
    context.poll();
    const Index centre = random.next();
    double largest = 0;
    for (Index j = 0; j < metric.size() && largest < least; ++j)
      largest = std::max(largest, metric(centre, j));
    least = std::min(least, largest);
  }
  return least;
}

template <Metric M>
RipsSample sample_of(const M& metric, const RipsOptions& options, const RunContext& context) {
  RipsSample sample;
  sample.vertices = metric.size();
  if (options.subsample)
    sample.vertices = std::min(sample.vertices, options.subsample->points);
  else if (!options.vertices.empty())
    sample.vertices = static_cast<Index>(options.vertices.size());
  sample.pairs = pairs_of(sample.vertices);
  sample.distances = distances_of(metric);
  const double limit = options.threshold ? *options.threshold : radius_of(metric, context);
  const auto within = std::ranges::upper_bound(sample.distances, limit) - sample.distances.begin();
  if (!sample.distances.empty())
    sample.edges =
        sample.pairs * static_cast<double>(within) / static_cast<double>(sample.distances.size());
  return sample;
}

}  // namespace

RipsSample sample_of(const RipsData& data, const RipsOptions& options, const RunContext& context) {
  if (const auto* points = std::get_if<HeldPoints>(&data))
    return sample_of(PointMetric(points->view, options.distance, options.minkowski_p), options,
                     context);
  if (const auto* matrix = std::get_if<DistanceMatrix>(&data))
    return sample_of(*matrix, options, context);
  if (const auto* held = std::get_if<HeldMetric>(&data))
    return sample_of(held->metric, options, context);
  const auto& sparse = std::get<SparseDistances>(data);
  RipsSample sample;
  sample.vertices = sparse.size();
  for (const WeightedEdge& e : sparse.edges()) sample.distances.push_back(e.value);
  std::ranges::sort(sample.distances);
  sample.pairs = static_cast<double>(sample.distances.size());
  const double limit = options.threshold.value_or(std::numeric_limits<double>::infinity());
  sample.edges = static_cast<double>(std::ranges::upper_bound(sample.distances, limit) -
                                     sample.distances.begin());
  return sample;
}

}  // namespace ph
