// SPDX-License-Identifier: MIT
#include <algorithm>
#include <vector>

#include "ph/detail/core/parallel.hpp"
#include "ph/detail/diagram/thread_context.hpp"
#include "ph/distances.hpp"

namespace ph {
namespace {

using Diagram = std::span<const Bar>;

struct Pair {
  Diagram a, b;
  std::size_t place;  ///< the place of its distance in the result

  std::size_t bars() const { return a.size() + b.size(); }
};

/// Computes the distance of each pair of diagrams, on all threads. @param count the number of
/// pairs.
/// @param add_pairs appends all pairs to the list that it is given.
template <class AddPairs>
std::vector<double> distances_of(std::size_t count, const DiagramDistance& distance,
                                 const RunContext& context, AddPairs&& add_pairs) {
  // The claim counts half of the sorted list a second time, for the buffer of the stable sort.
  const MemoryClaim claim(context.memory, count * (3 * sizeof(Pair) / 2 + sizeof(double)));
  std::vector<Pair> pairs;
  pairs.reserve(count);
  add_pairs(pairs);
  // The largest pairs come first, so that no thread starts a large pair at the end.
  std::ranges::stable_sort(pairs, std::ranges::greater(), &Pair::bars);
  std::vector<double> result(pairs.size());
  const diagram::ThreadContexts contexts(pairs.size(), context);
  for_each_piece("distances of diagrams", pairs.size(), 1, context,
                 [&](std::size_t begin, std::size_t end) {
                   for (std::size_t k = begin; k < end; ++k) {
                     RunContext task;
                     contexts.prepare(task);
                     const auto& [a, b, place] = pairs[k];
                     result[place] = distance(a, b, task);  // mutant: distance-place
                   }
                 });
  return result;
}

}  // namespace

DistanceMatrix diagram_distances(std::span<const Diagram> diagrams, const DiagramDistance& distance,
                                 const RunContext& context) {
  const std::size_t n = diagrams.size();
  return {static_cast<Index>(n),
          distances_of(n * (n - std::min<std::size_t>(n, 1)) / 2, distance, context,
                       [&](std::vector<Pair>& pairs) {
                         for (std::size_t i = 0; i < n; ++i)
                           for (std::size_t j = 0; j < i; ++j)
                             pairs.push_back({diagrams[i], diagrams[j], pairs.size()});
                       })};
}

std::vector<double> diagram_distances(std::span<const Diagram> diagrams,
                                      std::span<const Diagram> others,
                                      const DiagramDistance& distance, const RunContext& context) {
  return distances_of(diagrams.size() * others.size(), distance, context,
                      [&](std::vector<Pair>& pairs) {
                        for (const Diagram& a : diagrams)
                          for (const Diagram& b : others) pairs.push_back({a, b, pairs.size()});
                      });
}

}  // namespace ph
