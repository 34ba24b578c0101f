// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <vector>

#include "libph/src/loops/cover_search.hpp"
#include "libph/src/loops/early_graph.hpp"

namespace ph::detail {

/// Shortens closed walks step by step. Each step moves the walk across one or two triangles whose
/// edges all exist, so the result is homologous to the walk over every field. Only edges must be
/// checked, because three edges that form a clique bound a triangle of the flag complex.
class Shortcuts {
 public:
  using Walk = std::vector<std::uint32_t>;

  Shortcuts(const EarlyGraph& graph, const RunContext& context)
      : graph_(graph),
        near_first_(graph.vertices(), {0, 0}, &context.memory),
        near_middle_(graph.vertices(), {0, 0}, &context.memory) {}

  /// Shortens a walk until no step shortens it further or the budget is used up.
  /// @param keeps_last_step true if the step from the last vertex to the first, the birth edge,
  ///        must stay. Without such a step, a walk that bounds a triangle becomes empty.
  void shorten(Walk& walk, bool keeps_last_step, const Around& around, StepBudget& budget) {
    bool goes_on = true;
    while (goes_on && budget.take()) {
      goes_on = false;
      if (!keeps_last_step) {
        if (walk.size() <= 3) return walk.clear();
        std::rotate(walk.begin(), walk.begin() + 1, walk.end());
      }
      for (std::size_t i = 1; i + 1 < walk.size();) {
        const Change change = change_at(walk, i, around, budget);
        goes_on |= change != Change::none;
        // A removal makes two other vertices adjacent, which may make it possible to change the
        // vertex before them.
        i = change == Change::removed ? std::max<std::size_t>(i, 2) - 1 : i + 1;
      }
      if (!keeps_last_step && walk.size() > 3)  // the first vertex was never the middle one
        goes_on |= change_around(walk, around, budget);
    }
  }

 private:
  enum class Change { none, moved, removed };
  struct Mark {
    std::uint64_t stamp;
    double value;
  };

  /// Tries to remove or replace the vertex walk[i], which must be neither the first nor the last
  /// vertex.
  Change change_at(Walk& walk, std::size_t i, const Around& around, StepBudget& budget) {
    const std::uint32_t first = walk[i - 1], middle = walk[i], last = walk[i + 1];
    const auto at = walk.begin() + static_cast<std::ptrdiff_t>(i);
    if (first == last) {
      walk.erase(at, at + 2);
      return Change::removed;
    }
    mark(first, near_first_, around, budget);
    mark(middle, near_middle_, around, budget);
    const double now = near_first_[middle].value + near_middle_[last].value;
    if (is_near(near_first_, last) && near_first_[last].value <= now) {
      walk.erase(at);
      return Change::removed;
    }
    double best = now;
    std::uint32_t other = middle;
    graph_.for_each_neighbour(last, around.limit, around.birth,
                              [&](std::uint32_t w, EarlyGraph::Key key) {
                                budget.take();
                                // mutant: loops-triangles
                                if (!is_near(near_first_, w) || !is_near(near_middle_, w)) return;
                                const double length = near_first_[w].value + graph_.value(key);
                                if (length < best) {
                                  best = length;
                                  other = w;
                                }
                              });
    if (other == middle) return Change::none;
    *at = other;
    return Change::moved;
  }

  /// Tries to remove or replace the first vertex of a walk, which is between the last vertex and
  /// the second vertex.
  bool change_around(Walk& walk, const Around& around, StepBudget& budget) {
    std::rotate(walk.begin(), walk.end() - 1, walk.end());
    return change_at(walk, 1, around, budget) != Change::none;
  }

  void mark(std::uint32_t v, std::pmr::vector<Mark>& marks, const Around& around,
            StepBudget& budget) {
    ++stamp_;
    graph_.for_each_neighbour(v, around.limit, around.birth,
                              [&](std::uint32_t w, EarlyGraph::Key key) {
                                budget.take();
                                marks[w] = {stamp_, graph_.value(key)};
                              });
    (&marks == &near_first_ ? first_stamp_ : middle_stamp_) = stamp_;
  }
  bool is_near(const std::pmr::vector<Mark>& marks, std::uint32_t w) const {
    return marks[w].stamp == (&marks == &near_first_ ? first_stamp_ : middle_stamp_);
  }

  const EarlyGraph& graph_;
  std::pmr::vector<Mark> near_first_, near_middle_;  // for each vertex: edge to the marked vertex
  std::uint64_t stamp_ = 0, first_stamp_ = 0, middle_stamp_ = 0;
};

}  // namespace ph::detail
