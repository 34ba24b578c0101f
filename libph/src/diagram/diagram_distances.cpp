// SPDX-License-Identifier: MIT
#include <algorithm>
#include <vector>

#include "diagram/thread_context.hpp"
#include "ph/detail/core/parallel.hpp"
#include "ph/distances.hpp"

namespace ph {
namespace {

using Diagram = std::span<const Bar>;

struct Pair {
  Diagram a, b;
  std::size_t place;  ///< of its distance in the result

  std::size_t bars() const { return a.size() + b.size(); }
};

std::vector<double> distances_of(std::vector<Pair> pairs, const DiagramDistance& distance,
                                 const RunContext& context) {
  // The longest first: no thread is left with a long one in the end.
  std::ranges::stable_sort(pairs, std::ranges::greater(), &Pair::bars);
  std::vector<double> result(pairs.size());
  const diagram::ThreadContexts contexts(pairs.size(), context);
  for_each_piece("distances of diagrams", pairs.size(), 1, context,
                 [&](std::size_t begin, std::size_t end) {
                   for (std::size_t k = begin; k < end; ++k) {
                     RunContext task;
                     contexts.prepare(task);
                     const auto& [a, b, place] = pairs[k];
                     result[place] = distance(a, b, task);
                   }
                 });
  return result;
}

}  // namespace

DistanceMatrix diagram_distances(std::span<const Diagram> diagrams, const DiagramDistance& distance,
                                 const RunContext& context) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < diagrams.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) pairs.push_back({diagrams[i], diagrams[j], pairs.size()});
  return {static_cast<Index>(diagrams.size()), distances_of(std::move(pairs), distance, context)};
}

std::vector<double> diagram_distances(std::span<const Diagram> diagrams,
                                      std::span<const Diagram> others,
                                      const DiagramDistance& distance, const RunContext& context) {
  std::vector<Pair> pairs;
  for (const Diagram& a : diagrams)
    for (const Diagram& b : others) pairs.push_back({a, b, pairs.size()});
  return distances_of(std::move(pairs), distance, context);
}

}  // namespace ph
