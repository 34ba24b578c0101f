// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <limits>
#include <map>
#include <memory_resource>
#include <vector>

#include "libph/src/loops/early_graph.hpp"
#include "libph/src/loops/edge_cocycles.hpp"

namespace ph::detail {

/// The numbers of steps that may still be taken for all loops together and for the current loop.
struct StepBudget {
  std::uint64_t of_all, of_one = 0;
  void begin(std::uint64_t most) { of_one = std::min(of_all, most); }
  bool take(std::uint64_t steps = 1) {
    steps = std::min(steps, of_one);
    of_one -= steps;
    of_all -= steps;
    return of_one > 0;
  }
};

/// The graph in which a path is searched: the edges up to `limit`, without the birth edge.
struct Around {
  EarlyGraph::Key limit, birth;
};

/// The result of a search.
enum class Verdict { found, none, gave_up };

/// Finds shortest paths on which cocycles have given values.
///
/// Dijkstra's algorithm, started at the end, computes the distance of each vertex from the end. If
/// the cocycles have the wanted values on the shortest path, this path is the answer. Otherwise A*
/// searches pairs (vertex, values so far). The distances guide this search, because they are lower
/// bounds for paths with given values.
class CoverSearch {
 public:
  using Path = std::vector<std::uint32_t>;

  CoverSearch(const EarlyGraph& graph, const EdgeCocycles& cocycles, std::int64_t field,
              const RunContext& context);

  /// Sets the cocycles that count from now on, given by their numbers, and the values that they
  /// must have on a path.
  void set_target(std::span<const std::uint32_t> cocycles, std::span<const std::uint32_t> values);

  /// Finds a shortest path from `from` to `to`, both included, among the paths that have the wanted
  /// values and are shorter than `bound`.
  Verdict find(std::uint32_t from, std::uint32_t to, const Around& around, double bound,
               StepBudget& budget, Path& path);

 private:
  struct Distance {
    double length;
    std::uint32_t steps;
    friend auto operator<=>(const Distance&, const Distance&) = default;
  };
  using Values = std::vector<std::uint32_t>;  // values of the cocycles that count
  struct State {
    std::uint32_t vertex, values, parent;
    Distance from_start;
    bool is_settled;
  };
  static constexpr std::uint32_t kNone = UINT32_MAX;
  static constexpr std::size_t kMostStates = std::size_t{1} << 17;
  static constexpr std::size_t kMostNumbers = std::size_t{1} << 21;  // total number of values

  bool measure_distances(std::uint32_t from, std::uint32_t to, const Around& around, double bound,
                         StepBudget& budget);
  Verdict search_cover(std::uint32_t from, std::uint32_t to, const Around& around, double bound,
                       StepBudget& budget, Path& path);
  bool is_near(std::uint32_t v) const { return stamp_[v] == run_; }
  /// Adds the values of the cocycles on one more step to `values`. @return true if `values`
  /// changed.
  bool add_step(Values& values, std::uint32_t from, std::uint32_t to, EarlyGraph::Key key) const;

  const EarlyGraph& graph_;
  const EdgeCocycles& cocycles_;
  std::uint64_t p_;
  const RunContext& context_;
  std::pmr::vector<std::uint32_t> slot_;  // place of each cocycle in Values, or kNone
  std::vector<std::uint32_t> counted_;
  Values target_;
  // For each vertex, the data of the last search for distances to the end.
  std::pmr::vector<std::uint32_t> stamp_, towards_;
  std::pmr::vector<Distance> distance_;
  std::uint32_t run_ = 0;
};

}  // namespace ph::detail
