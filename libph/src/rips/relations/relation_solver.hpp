// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <span>
#include <vector>

#include "libph/src/rips/annotations/annotations.hpp"
#include "libph/src/rips/relations/formal_sums.hpp"
#include "libph/src/rips/relations/pair_labels.hpp"
#include "libph/src/rips/relations/sum_rows.hpp"
#include "libph/src/rips/sweep/sweep_observer.hpp"
#include "ph/detail/core/field.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// Replaces Annotations over Z/2 while hundreds of classes of H^1 are alive, which happens with
/// random distances. The annotations of this class are formal, that is, they are sums of generators
/// in which dead generators are not substituted. Deaths are recorded only by relations between
/// generators. At first, a formal annotation is a list of a few generators. Later it is a row of
/// bits over the living generators.
///
/// docs/explanation/engines/formal-annotations.md explains the reasons and the order of calls.
class RelationSolver {
 public:
  using Vertex = SweepObserver<Z2>::Vertex;
  using Edge = Annotations<Z2>::Edge;

  /// @param annotations the current annotations, which the solver takes over. They are not needed
  /// afterwards. @param observer, memory must outlive this object.
  RelationSolver(std::size_t vertices, Annotations<Z2>& annotations, SweepObserver<Z2>& observer,
                 const SweepTuning& tuning, MemoryBudget& memory);
  /// True if the memory is likely to be enough.
  static bool fits(std::size_t vertices, const MemoryBudget& memory);

  /// Adds a generator that is one on a new edge and zero on all other edges.
  void give_birth(const Edge& edge);
  /// Prefetches the data that annotating the edge from u to v will need. @param link one bit per
  /// vertex.
  void prefetch(Vertex u, Vertex v, std::span<const bits::Word> link) const;
  /// Annotates an edge and collects the relations of its link. @param roots one vertex of each
  /// component of the edge's link. @return false if the solver must stop.
  [[nodiscard]] bool annotate(const Edge& edge, std::span<const Vertex> roots);
  /// Ends the solver and passes its state to new annotations. Precondition: `annotate` has just
  /// returned false.
  void hand_over(Annotations<Z2>& annotations);
  /// Ends the solver and reports the classes that never die.
  void finish();

  /// Number of classes whose death has not been reported yet.
  std::size_t living_count() const { return living_; }

 private:
  using Position = SweepObserver<Z2>::Position;
  using Triangle = SweepObserver<Z2>::Triangle;
  using Generator = std::uint32_t;  // numbered by birth; renumbered when rows are made
  using Sum = std::uint32_t;        // 0 is the empty sum

  bool has_rows() const { return rows_ != nullptr; }
  std::size_t sum_count() const { return has_rows() ? rows_->count() : lists_->count(); }
  bool is_dead(Generator g) const {
    return has_rows() ? rows_->matrix().is_dead(g) : lists_->relations().is_dead(g);
  }
  void assign(const Edge& edge, Sum a);
  void report_death(Generator g, Triangle death);
  /// If enough relations are collected, turns lists into rows or solves the collected relations.
  /// @return false if the solver must stop.
  bool solve_if_due();
  /// Solves the collected relations and reports deaths. @return true if a generator died.
  /// Precondition: annotations are rows.
  bool solve();
  /// Substitutes the dead generators in all annotations. Precondition: no relations are waiting.
  void make_rows();

  // For few vertices, this is a block of memory on huge pages, in two parts. Memory of the first
  // part is not freed before the end. All memory of the second part is freed when lists become
  // rows.
  std::pmr::monotonic_buffer_resource block_, kept_part_, lent_part_;
  std::pmr::memory_resource *kept_, *lent_;
  SweepObserver<Z2>& observer_;
  const SweepTuning tuning_;
  MemoryBudget& memory_;
  PairLabels sums_;               // the annotation of each edge, indexed by the ends of the edge
  std::pmr::vector<Edge> edges_;  // edges with a non-empty annotation
  std::pmr::vector<Position> births_;  // birth of each generator
  std::size_t living_ = 0;
  std::unique_ptr<FormalSums> lists_;  // annotations as lists,
  std::unique_ptr<SumRows> rows_;      // or as rows
  std::pmr::vector<Triangle> deaths_;  // triangle of each collected relation
};

}  // namespace ph
