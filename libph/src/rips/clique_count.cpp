// SPDX-License-Identifier: MIT
#include "libph/src/rips/clique_count.hpp"

#include <algorithm>
#include <memory_resource>
#include <numeric>
#include <random>
#include <span>

#include "ph/detail/rips/rips_graph.hpp"

namespace ph {
namespace {

using Vertex = std::uint32_t;
using Set = std::pmr::vector<Vertex>;  // ascending

constexpr double kFewCells = 1 << 20;   // cells up to this number are counted one by one
constexpr std::size_t kSamples = 4000;  // sampled edges
// Limit for the steps of the sampling. If degrees are high, fewer edges are sampled.
constexpr double kSteps = 1 << 27;
constexpr std::size_t kFewestSamples = 200;

/// The list of neighbours of each vertex.
class Neighbours {
 public:
  Neighbours(const RipsGraph& graph, const RunContext& context)
      : first_(static_cast<std::size_t>(graph.size()) + 1, 0, &context.memory),
        lists_(2 * graph.edge_count(), &context.memory) {
    for (const FlagEdge& e : graph.edges()) {
      ++first_[e.u];
      ++first_[e.v];
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    for (const FlagEdge& e : graph.edges()) {  // each list is filled from its end
      lists_[--first_[e.u]] = e.v;
      lists_[--first_[e.v]] = e.u;
    }
    Ticker ticker(context, "cells", first_.size() - 1);
    for (Vertex v = 0; v + 1 < first_.size(); ++v) {
      const auto begin = lists_.begin() + static_cast<std::ptrdiff_t>(first_[v]);
      std::sort(begin, lists_.begin() + static_cast<std::ptrdiff_t>(first_[v + 1]));
      ticker.tick(of(v).size() + 1);
    }
  }

  std::span<const Vertex> of(Vertex v) const {
    return std::span(lists_).subspan(first_[v], first_[v + 1] - first_[v]);
  }
  std::span<const Vertex> above(Vertex v) const {
    const auto all = of(v);
    return all.subspan(static_cast<std::size_t>(std::ranges::upper_bound(all, v) - all.begin()));
  }

 private:
  std::pmr::vector<std::size_t> first_;
  std::pmr::vector<Vertex> lists_;
};

class CliqueCounter {
 public:
  CliqueCounter(const RipsGraph& graph, int top, const RunContext& context)
      : graph_(graph),
        top_(static_cast<std::size_t>(top)),
        context_(context),
        neighbours_(graph, context) {}

  CliqueCounts run() {
    std::vector<double> estimates = estimate();
    double sum = 0;
    std::size_t few = 2;
    while (few < estimates.size() && (sum += estimates[few]) <= kFewCells) ++few;
    CliqueCounts result{std::move(estimates), static_cast<int>(few)};
    if (few > 2) count(result.counts, few - 1);
    while (!result.counts.empty() && result.counts.back() == 0) result.counts.pop_back();
    return result;
  }

 private:
  // This is the method of Knuth (1975). A random edge is extended vertex by vertex. Each vertex is
  // chosen at random among the vertices that are joined to all vertices of the clique so far. The
  // product of the numbers of choices estimates the number of ways to build a clique. Each clique
  // can be built from C(d+1,2) first edges, and the rest of its vertices can be added in (d-1)!
  // orders.
  std::vector<double> estimate() {
    std::vector<double> sums(top_ + 1, 0);
    const std::size_t edges = graph_.edge_count();
    const double degree = 2.0 * static_cast<double>(edges) / static_cast<double>(graph_.size());
    const auto samples = static_cast<std::size_t>(
        std::clamp(kSteps / (1 + 2 * degree * static_cast<double>(top_)),
                   static_cast<double>(kFewestSamples), static_cast<double>(kSamples)));
    std::mt19937_64 random(1);  // a fixed seed gives the same estimate each time
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
    Set set(&context_.memory), next(&context_.memory);
    Ticker ticker(context_, "cells", samples);
    for (std::size_t i = 0; i < samples; ++i) {
      // One edge is taken from each of several equally long pieces of the order. Short and long
      // edges are therefore sampled in proportion to their numbers.
      const std::size_t begin = i * edges / samples, end = (i + 1) * edges / samples;
      const FlagEdge& e = graph_.edges()[begin + (end > begin ? below(end - begin) : 0)];
      intersect(neighbours_.of(e.u), neighbours_.of(e.v), set);
      double ways = static_cast<double>(edges) / static_cast<double>(samples);
      for (std::size_t d = 2; d <= top_ && !set.empty(); ++d) {
        ways *= static_cast<double>(set.size());
        sums[d] += ways;
        if (d == top_) break;
        ticker.work(set.size());
        intersect(set, neighbours_.of(set[below(set.size())]), next);
        set.swap(next);
      }
      ticker.work(neighbours_.of(e.u).size() + neighbours_.of(e.v).size());
      ticker.tick();
    }
    double orders = 1;
    for (std::size_t d = 2; d <= top_; ++d) {
      orders *= static_cast<double>(std::max<std::size_t>(d - 1, 1));  // mutant: clique-orders
      sums[d] /= orders * static_cast<double>(d * (d + 1) / 2);
    }
    sums[0] = static_cast<double>(graph_.size());
    sums[1] = static_cast<double>(edges);
    return sums;
  }

  /// Counts the cliques of dimensions 2 … `last`. Each clique is built from its smallest vertex up.
  void count(std::vector<double>& counts, std::size_t last) {
    std::fill(counts.begin() + 2, counts.begin() + static_cast<std::ptrdiff_t>(last) + 1, 0.0);
    std::vector<Set> sets(last + 1, Set(&context_.memory));
    Ticker ticker(context_, "cells", static_cast<std::uint64_t>(graph_.size()));
    const auto extend = [&](const auto& self, std::span<const Vertex> from, std::size_t d) -> void {
      counts[d] += static_cast<double>(from.size());
      if (d == last) return;
      for (const Vertex v : from) {
        intersect(from, neighbours_.above(v), sets[d]);  // mutant: clique-above
        ticker.work(from.size() + 1);
        if (!sets[d].empty()) self(self, sets[d], d + 1);
      }
    };
    const double edges = counts[1];
    counts[1] = 0;
    for (Vertex v = 0; v < static_cast<Vertex>(graph_.size()); ++v) {
      extend(extend, neighbours_.above(v), 1);
      ticker.tick();
    }
    counts[1] = edges;
  }

  static void intersect(std::span<const Vertex> a, std::span<const Vertex> b, Set& out) {
    out.clear();
    std::ranges::set_intersection(a, b, std::back_inserter(out));
  }

  const RipsGraph& graph_;
  std::size_t top_;
  const RunContext& context_;
  Neighbours neighbours_;
};

}  // namespace

CliqueCounts count_cliques(const RipsGraph& graph, int top, const RunContext& context) {
  if (graph.size() == 0) return {};
  if (top < 2 || graph.edge_count() == 0) {
    CliqueCounts result{{static_cast<double>(graph.size())}, std::max(top, 1) + 1};
    if (top >= 1 && graph.edge_count() > 0)
      result.counts.push_back(static_cast<double>(graph.edge_count()));
    return result;
  }
  return CliqueCounter(graph, top, context).run();
}

}  // namespace ph
