// SPDX-License-Identifier: MIT
// This file computes distances between diagrams, matchings and barycentres. A diagram is an array
// with rows birth, death.
#include "ph/distances.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "python/src/calls/bindings.hpp"
#include "python/src/calls/run.hpp"
#include "python/src/data/arrays.hpp"
#include "python/src/data/diagrams.hpp"

namespace ph::python {
namespace {

using Diagram = std::span<const Bar>;

/// The distance to compute, and the required accuracy.
struct DiagramMetric {
  enum class Kind { bottleneck, wasserstein, sliced } kind = Kind::bottleneck;
  /// For the bottleneck distance, only the limits count.
  WassersteinOptions options = {};
  int directions = 50;  ///< used by the sliced distance

  DistanceBounds bounds(Diagram a, Diagram b, const RunContext& context) const {
    switch (kind) {
      case Kind::bottleneck:
        return bottleneck_bounds(a, b, options.limits, context);
      case Kind::wasserstein:
        return wasserstein_distance(a, b, options, context);
      default:
        const double distance = sliced_wasserstein_distance(a, b, directions, context);
        return {distance, distance};
    }
  }
  DiagramDistance function() const {
    return [metric = *this](Diagram a, Diagram b, const RunContext& context) {
      return metric.bounds(a, b, context).value;
    };
  }
};

DiagramMetric metric_of(const std::string& kind, double order, double ground, double relative_error,
                        double at_most, int directions) {
  using Kind = DiagramMetric::Kind;
  return {kind == "bottleneck"    ? Kind::bottleneck
          : kind == "wasserstein" ? Kind::wasserstein
                                  : Kind::sliced,
          {order, ground, {relative_error, at_most}},
          directions};
}

bool are_few(const std::vector<Bar>& a, const std::vector<Bar>& b) {
  constexpr std::size_t few = 100;
  return a.size() + b.size() < few;
}

py::tuple distance(const py::buffer& a, const py::buffer& b, const DiagramMetric& metric,
                   const RunOptions& options) {
  const std::vector<Bar> bars_of_a = bars_of(a), bars_of_b = bars_of(b);
  const DistanceBounds bounds =
      run(options, are_few(bars_of_a, bars_of_b),
          [&](const RunContext& context) { return metric.bounds(bars_of_a, bars_of_b, context); });
  return py::make_tuple(bounds.value, bounds.lower);
}

/// Completes a matching, so that each bar is in one pair, with the diagonal if necessary. The index
/// -1 means the diagonal, and comes last.
std::vector<std::pair<std::int64_t, std::int64_t>> with_diagonal(const BottleneckMatching& matching,
                                                                 std::size_t count_a,
                                                                 std::size_t count_b) {
  std::vector<std::pair<std::int64_t, std::int64_t>> pairs;
  std::vector<bool> is_paired(count_b);
  auto next = matching.pairs.begin();
  for (std::size_t a = 0; a < count_a; ++a) {
    const bool has_partner = next != matching.pairs.end() && next->first == a;
    pairs.emplace_back(a, has_partner ? static_cast<std::int64_t>(next->second) : -1);
    if (has_partner) is_paired[(next++)->second] = true;
  }
  for (std::size_t b = 0; b < count_b; ++b)
    if (!is_paired[b]) pairs.emplace_back(-1, b);
  return pairs;
}

/// Returns the distance, a lower bound for it, and the pairs. There are no pairs if the distance is
/// infinite.
py::tuple matching(const py::buffer& a, const py::buffer& b, const DiagramMetric& metric,
                   const RunOptions& options) {
  const std::vector<Bar> bars_of_a = bars_of(a), bars_of_b = bars_of(b);
  const WassersteinMatching found =
      run(options, are_few(bars_of_a, bars_of_b), [&](const RunContext& context) {
        if (metric.kind == DiagramMetric::Kind::wasserstein)
          return wasserstein_matching(bars_of_a, bars_of_b, metric.options, context);
        const BottleneckMatching pairs = bottleneck_matching(bars_of_a, bars_of_b, context);
        WassersteinMatching all{{pairs.distance, pairs.distance}, {}};
        if (pairs.distance < kInfinity)
          all.pairs = with_diagonal(pairs, bars_of_a.size(), bars_of_b.size());
        return all;
      });
  std::vector<std::int64_t> flat;
  for (const auto& [i, j] : found.pairs) flat.insert(flat.end(), {i, j});
  const auto rows = static_cast<py::ssize_t>(found.pairs.size());
  return py::make_tuple(found.distance.value, found.distance.lower,
                        Block::of(std::move(flat), {rows, 2}));
}

/// Returns a square matrix. With `others`, returns a matrix with one column for each of the others.
Block distances(const std::vector<py::buffer>& diagrams,
                const std::optional<std::vector<py::buffer>>& others, const DiagramMetric& metric,
                const RunOptions& options) {
  const Diagrams rows(diagrams);
  const auto size = static_cast<py::ssize_t>(diagrams.size());
  if (others) {
    const Diagrams columns(*others);
    return Block::of(run(options, false,
                         [&](const RunContext& context) {
                           return diagram_distances(rows.spans(), columns.spans(),
                                                    metric.function(), context);
                         }),
                     {size, static_cast<py::ssize_t>(others->size())});
  }
  return Block::of(run(options, false,
                       [&](const RunContext& context) {
                         const DistanceMatrix all =
                             diagram_distances(rows.spans(), metric.function(), context);
                         const auto count = static_cast<std::size_t>(size * size);
                         // This is the memory for the square matrix, and for the lower half from
                         // which it is filled.
                         const MemoryClaim claim(context.memory, 3 * count * sizeof(double) / 2);
                         std::vector<double> square;
                         square.reserve(count);
                         for (Index i = 0; i < all.size(); ++i)
                           for (Index j = 0; j < all.size(); ++j) square.push_back(all(i, j));
                         return square;
                       }),
                   {size, size});
}

/// Returns the barycentre as rows birth, death; the root mean square; the number of rounds; and
/// true if the search converged.
py::tuple barycentre_of(const std::vector<py::buffer>& diagrams, int most_rounds, double least_gain,
                        const RunOptions& options) {
  const Diagrams given(diagrams);
  const Barycentre found = run(options, false, [&](const RunContext& context) {
    return barycentre(given.spans(), {most_rounds, least_gain}, context);
  });
  std::vector<double> rows;
  for (const Bar& bar : found.bars) rows.insert(rows.end(), {bar.birth, bar.death});
  return py::make_tuple(
      Block::of(std::move(rows), {static_cast<py::ssize_t>(found.bars.size()), 2}),
      found.root_mean_square, found.rounds, found.converged);
}

}  // namespace

void bind_distances(py::module_& m) {
  py::class_<DiagramMetric>(m, "DiagramMetric")
      .def(py::init(&metric_of), py::arg("kind"), py::arg("order"), py::arg("ground"),
           py::arg("relative_error"), py::arg("at_most"), py::arg("directions"));
  m.def("distance", &distance, py::arg("a"), py::arg("b"), py::arg("metric"), py::arg("run"));
  m.def("matching", &matching, py::arg("a"), py::arg("b"), py::arg("metric"), py::arg("run"));
  m.def("distances", &distances, py::arg("diagrams"), py::arg("others"), py::arg("metric"),
        py::arg("run"));
  m.def("barycentre", &barycentre_of, py::arg("diagrams"), py::arg("most_rounds"),
        py::arg("least_gain"), py::arg("run"));
}

}  // namespace ph::python
