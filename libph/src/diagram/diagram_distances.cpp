// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>
#include <vector>

#include "diagram/thread_context.hpp"
#include "ph/detail/core/parallel.hpp"
#include "ph/distances.hpp"

namespace ph {

DistanceMatrix diagram_distances(std::span<const std::span<const Bar>> diagrams,
                                 const DiagramDistance& distance, const RunContext& context) {
  struct Pair {
    std::uint32_t i, j;
    std::size_t bars, place;
  };
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < diagrams.size(); ++i)
    for (std::uint32_t j = 0; j < i; ++j)
      pairs.push_back({i, j, diagrams[i].size() + diagrams[j].size(), pairs.size()});
  // The longest first: no thread is left with a long one in the end.
  std::ranges::stable_sort(pairs, std::ranges::greater(), &Pair::bars);
  std::vector<double> lower(pairs.size());
  const diagram::ThreadContexts contexts(pairs.size(), context);
  for_each_piece("distances of diagrams", pairs.size(), 1, context,
                 [&](std::size_t begin, std::size_t end) {
                   for (std::size_t k = begin; k < end; ++k) {
                     RunContext task;
                     contexts.prepare(task);
                     const auto& [i, j, bars, place] = pairs[k];
                     lower[place] = distance(diagrams[i], diagrams[j], task);
                   }
                 });
  return {static_cast<Index>(diagrams.size()), std::move(lower)};
}

}  // namespace ph
