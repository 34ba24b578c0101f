// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <span>
#include <vector>

#include "ph/detail/core/field.hpp"
#include "ph/run_context.hpp"
#include "rips/annotations/annotations.hpp"
#include "rips/relations/formal_sums.hpp"
#include "rips/relations/pair_labels.hpp"
#include "rips/relations/sum_rows.hpp"
#include "rips/sweep/sweep_observer.hpp"

namespace ph {

/// Stands in for Annotations over Z/2 while thousands of classes of H^1 live, as with random
/// distances. Annotations are formal: sums of generators as if none had died. What the deaths mean
/// is known to the relations between generators alone. At first a formal annotation is a list of a
/// few generators, later a row of bits over those that live.
///
/// docs/explanation/engines/formal-annotations.md says why, and which call comes when.
class RelationSolver {
 public:
  using Vertex = SweepObserver<Z2>::Vertex;
  using Edge = Annotations<Z2>::Edge;

  /// @param annotations are not needed any more. @param observer, memory outlive this.
  RelationSolver(std::size_t vertices, Annotations<Z2>& annotations, SweepObserver<Z2>& observer,
                 const SweepTuning& tuning, MemoryBudget& memory);
  /// Whether there is memory for it, more or less.
  static bool fits(std::size_t vertices, const MemoryBudget& memory);

  /// A generator that is one on a new edge and zero on all others.
  void give_birth(const Edge& edge);
  /// Asks for what the edge from u to v will need. @param link a bit for each vertex.
  void prefetch(Vertex u, Vertex v, std::span<const bits::Word> link) const;
  /// @param roots a vertex of each component of the edge's link. @return whether to go on.
  [[nodiscard]] bool annotate(const Edge& edge, std::span<const Vertex> roots);
  /// Ends: all that is known goes to new annotations. Needs that `annotate` has just returned
  /// false.
  void hand_over(Annotations<Z2>& annotations);
  /// Ends: reports what never dies.
  void finish();

  /// Classes whose death was not reported yet.
  std::size_t living_count() const { return living_; }

 private:
  using Position = SweepObserver<Z2>::Position;
  using Triangle = SweepObserver<Z2>::Triangle;
  using Generator = std::uint32_t;  // numbered by birth, anew when rows are made
  using Sum = std::uint32_t;        // 0 is the empty sum

  bool has_rows() const { return rows_ != nullptr; }
  std::size_t sum_count() const { return has_rows() ? rows_->count() : lists_->count(); }
  bool is_dead(Generator g) const {
    return has_rows() ? rows_->matrix().is_dead(g) : lists_->relations().is_dead(g);
  }
  void assign(const Edge& edge, Sum a);
  void report_death(Generator g, Triangle death);
  /// If it is time, makes rows of lists or solves the relations collected since. @return whether to
  /// go on.
  bool solve_if_due();
  /// @return whether a generator died. Needs rows.
  bool solve();
  /// Puts the dead generators into all annotations. Needs that no relations were collected.
  void make_rows();

  // For few vertices a block of memory in two parts, which lies on huge pages. In the first one
  // nothing is given back before the end, in the second one all is when lists become rows.
  std::pmr::monotonic_buffer_resource block_, kept_part_, lent_part_;
  std::pmr::memory_resource *kept_, *lent_;
  SweepObserver<Z2>& observer_;
  const SweepTuning tuning_;
  MemoryBudget& memory_;
  PairLabels sums_;                    // by ends of an edge: its annotation
  std::pmr::vector<Edge> edges_;       // of which that is not empty
  std::pmr::vector<Position> births_;  // by generator
  std::size_t living_ = 0;
  std::unique_ptr<FormalSums> lists_;  // annotations as lists,
  std::unique_ptr<SumRows> rows_;      // or as rows
  std::pmr::vector<Triangle> deaths_;  // by relation collected
};

}  // namespace ph
