// SPDX-License-Identifier: MIT
#include "apps/distance/data/pairs.hpp"

#include <algorithm>

#include "ph/detail/core/parallel.hpp"
#include "ph/detail/diagram/thread_context.hpp"

namespace ph::distance_program {
namespace {

/// A distance to compute.
struct Task {
  std::size_t bars;
  std::uint32_t dim, a, b;  // indices of the dimension and of the two barcodes
};

std::pmr::vector<Task> tasks_of(const std::vector<Barcode>& barcodes,
                                const PairDistances& distances, const RunContext& context) {
  std::pmr::vector<Task> tasks(&context.memory);
  tasks.reserve(distances.dims().size() * distances.pairs());
  for (std::uint32_t d = 0; d < distances.dims().size(); ++d) {
    std::vector<std::size_t> bars;
    for (const Barcode& barcode : barcodes)
      bars.push_back(barcode.bars(distances.dims()[d]).size());
    for (std::uint32_t a = 0; a < barcodes.size(); ++a)
      for (std::uint32_t b = 0; b < a; ++b) tasks.push_back({bars[a] + bars[b], d, a, b});
  }
  // The longest task comes first, so that no thread starts a long task last.
  std::ranges::sort(tasks, std::ranges::greater(), &Task::bars);
  return tasks;
}

}  // namespace

DistanceMatrix PairDistances::matrix(std::size_t dim) const {
  std::vector<double> lower;
  lower.reserve(pairs());
  for (std::size_t a = 0; a < count_; ++a)
    for (std::size_t b = 0; b < a; ++b) lower.push_back(at(dim, a, b).value);
  return {static_cast<Index>(count_), std::move(lower)};
}

PairDistances distances_of(const std::vector<Barcode>& barcodes, std::vector<int> dims,
                           const app::DistanceChoice& choice, const RunContext& context) {
  PairDistances distances(barcodes.size(), std::move(dims), &context.memory);
  const std::pmr::vector<Task> tasks = tasks_of(barcodes, distances, context);
  const auto find = [&](const Task& task, const RunContext& its_context) {
    const int dim = distances.dims()[task.dim];
    // Diagrams are passed in the order of the inputs, so that an error names the first faulty
    // diagram.
    // mutant: pair-order
    distances.at(task.dim, task.a, task.b) = app::distance_of(
        barcodes[task.b].bars(dim), barcodes[task.a].bars(dim), choice, its_context);
  };
  // A single pair gets all threads and all memory, and reports its progress.
  if (barcodes.size() == 2) {
    for (const Task& task : tasks) find(task, context);
    return distances;
  }
  const diagram::ThreadContexts contexts(tasks.size(), context);
  for_each_piece("distances of barcodes", tasks.size(), 1, context,
                 [&](std::size_t begin, std::size_t end) {
                   for (std::size_t k = begin; k < end; ++k) {
                     RunContext own;
                     contexts.prepare(own);
                     find(tasks[k], own);
                   }
                 });
  return distances;
}

}  // namespace ph::distance_program
