// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <span>
#include <vector>

#include "ph/detail/core/field.hpp"
#include "rips/relations/formal_sums.hpp"
#include "rips/relations/pair_labels.hpp"
#include "rips/relations/sum_rows.hpp"
#include "rips/sweep/sweep_observer.hpp"

namespace ph {

/// Annotations over Z/2 while thousands of classes of H^1 live, as with random distances. Hardly an
/// edge has the zero class then, most classes are asked for a few times only, and each death would
/// change many. So classes are formal: sums of generators as if none had died, and what the dead
/// became is known to the relations between generators alone.
///
/// At first a class is a list of a few generators, and each relation is looked at when it comes.
/// But soon nearly all relations follow from those before, and to see that takes longer and longer.
/// So once most generators have died the classes learn of it: they become rows of bits over those
/// that live, and relations are put aside and solved together, see RelationMatrix.
class FormalAnnotations {
 public:
  using Vertex = SweepObserver<Z2>::Vertex;
  using Position = SweepObserver<Z2>::Position;
  using Triangle = SweepObserver<Z2>::Triangle;
  using Generator = std::uint32_t;  ///< numbered by birth, anew when classes learn of the dead
  using Class = std::uint32_t;      ///< 0 is the zero class
  struct Edge {
    Vertex u, v;
    Position position;
  };
  /// The classes of the two edges of a path.
  struct Path {
    Class first, second;
  };

  /// @param together how many relations are worth solving, at least.
  FormalAnnotations(std::size_t vertices, std::size_t together, std::pmr::memory_resource* memory);
  /// What it takes for that many vertices, more or less, in bytes.
  static double bytes(std::size_t vertices);

  /// A generator of the next number. Needs !has_rows().
  Generator add_generator(Position birth);
  /// The sum of ascending generators. Needs !has_rows().
  Class class_of(std::span<const Generator> sum) { return sums_->insert(sum); }
  /// A generator that is one on a new edge and zero on all others.
  void give_birth(const Edge& edge);
  /// From u over w to v.
  Path path(Vertex u, Vertex w, Vertex v) const { return {labels_(u, w), labels_(v, w)}; }
  Class sum(Path path);
  /// Annotates an edge for the first time.
  void assign(const Edge& edge, Class a);
  /// Two paths that a triangle makes the same: their difference is zero from now on. Calls
  /// `on_death(birth, death)` for the generator that dies of it, now or when relations are solved.
  template <class OnDeath>
  void relate(Path a, Path b, Triangle death, OnDeath&& on_death);
  /// Ask for what will be needed soon.
  void prefetch_path(Vertex u, Vertex w, Vertex v) const {
    labels_.prefetch(u, w);
    labels_.prefetch(v, w);
  }
  void prefetch(Path path) const;

  /// Whether it is time to solve.
  bool is_due() const;
  /// What solving takes, in bytes.
  double bytes_to_solve() const;
  /// Solves the relations put aside, in their order; the first time it makes rows. @return false if
  /// that was of no use, since no generator died.
  template <class OnDeath>
  bool solve(OnDeath&& on_death);
  /// Whether classes are rows.
  bool has_rows() const { return rows_ != nullptr; }
  /// Makes classes rows over the living generators alone. Needs that no relations were put aside.
  void make_rows();

  /// Of the living generators, in their order.
  template <class Visit>
  void for_each_birth(Visit&& visit) const;
  /// Calls `visit(edge, generators)` for edges of non-zero class. Needs that rows have just been
  /// made.
  template <class Visit>
  void for_each_edge(Visit&& visit) const;

 private:
  /// A block of memory in two parts. In the first one nothing is given back before the end, in the
  /// second one all is when rows are made: little is touched, and it lies on huge pages. For many
  /// vertices there is none.
  class Arena {
   public:
    Arena(std::size_t bytes, std::pmr::memory_resource* memory)
        : memory_(memory),
          bytes_(bytes),
          block_(bytes == 0 ? nullptr : memory->allocate(bytes)),
          kept_(block_, bytes / 2, memory),
          lent_(static_cast<std::byte*>(block_) + bytes / 2, bytes / 2, memory) {}
    ~Arena() {
      if (block_ != nullptr) memory_->deallocate(block_, bytes_);
    }
    Arena(const Arena&) = delete;
    Arena& operator=(const Arena&) = delete;
    std::pmr::memory_resource* kept() { return block_ == nullptr ? memory_ : &kept_; }
    std::pmr::memory_resource* lent() { return block_ == nullptr ? memory_ : &lent_; }
    void take_back() { lent_.release(); }

   private:
    std::pmr::memory_resource* memory_;
    std::size_t bytes_;
    void* block_;
    std::pmr::monotonic_buffer_resource kept_, lent_;
  };

  std::size_t class_count() const { return has_rows() ? rows_->count() : sums_->count(); }
  std::size_t living_count() const {
    return has_rows() ? rows_->matrix().living_count()
                      : births_.size() - sums_->relations().dead_count();
  }
  bool is_dead(Generator g) const {
    return has_rows() ? rows_->matrix().is_dead(g) : sums_->relations().is_dead(g);
  }

  Arena arena_;
  std::size_t together_;
  PairLabels labels_;                  // classes
  std::pmr::vector<Edge> edges_;       // of non-zero class
  std::pmr::vector<Position> births_;  // by generator
  std::unique_ptr<FormalSums> sums_;   // classes as lists,
  std::unique_ptr<SumRows> rows_;      // or as rows
  std::pmr::vector<Triangle> deaths_;  // by relation put aside
};

template <class OnDeath>
void FormalAnnotations::relate(Path a, Path b, Triangle death, OnDeath&& on_death) {
  const std::array<Class, 4> difference{a.first, a.second, b.first, b.second};
  if (has_rows()) {
    if (rows_->relate(difference)) deaths_.push_back(death);
  } else if (const Generator g = sums_->relate(difference); g != EchelonRelations::kNone) {
    on_death(births_[g], death);
  }
}

template <class OnDeath>
bool FormalAnnotations::solve(OnDeath&& on_death) {
  if (!has_rows()) {
    make_rows();
    return true;
  }
  const std::size_t died = rows_->solve(
      [&](std::size_t relation, Generator g) { on_death(births_[g], deaths_[relation]); });
  deaths_.clear();
  constexpr std::size_t many = 4;  // additions a row: classes had better learn of the dead
  if (rows_->matrix().additions() > many * births_.size()) make_rows();
  return died != 0;
}

template <class Visit>
void FormalAnnotations::for_each_birth(Visit&& visit) const {
  for (Generator g = 0; g < births_.size(); ++g)
    if (!is_dead(g)) visit(births_[g]);
}

template <class Visit>
void FormalAnnotations::for_each_edge(Visit&& visit) const {
  std::pmr::vector<Generator> sum(edges_.get_allocator());
  for (const Edge& e : edges_) {
    sum.clear();
    bits::for_each((*rows_)[labels_(e.u, e.v)], 0, rows_->words(),
                   [&](std::size_t g) { sum.push_back(static_cast<Generator>(g)); });
    if (!sum.empty()) visit(e, std::span<const Generator>(sum));
  }
}

}  // namespace ph
