// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "ph/core/bit_matrix.hpp"
#include "ph/core/filtration.hpp"

namespace ph {

/// The connected components of a lens: of the graph that the edges so far span on the common
/// neighbours of an edge's ends. Most lenses are cones: one vertex, the apex, is joined to all
/// others; it often serves the next edge at the same vertex too.
class LensComponents {
 public:
  using Vertex = std::uint32_t;
  using Word = bits::Word;
  static constexpr Vertex kNone = UINT32_MAX;

  /// @param joined the edges so far, a square matrix that outlives this.
  LensComponents(const BitMatrix& joined, std::pmr::memory_resource* memory)
      : joined_(joined),
        last_apex_(joined.rows(), kNone, memory),
        roots_(memory),
        sets_(memory),
        rest_(joined.words(), 0, memory) {}

  /// @param lens not empty; of the edge e.
  void find(const FlagEdge& e, const Word* lens);
  /// Looks for an apex where `find` has met none. @return whether there is one.
  bool find_apex(const FlagEdge& e, const Word* lens);

  /// Ascending roots.
  std::size_t count() const { return roots_.size(); }
  /// A component's smallest vertex; any vertex if it is the only component.
  Vertex root(std::size_t i) const { return roots_[i]; }
  /// A component's vertices, unless it is the only one.
  const Word* vertices(std::size_t i) const { return sets_.data() + i * joined_.words(); }
  bool has_apex() const { return apex_ != kNone; }
  Vertex apex() const { return apex_; }

 private:
  bool is_apex(Vertex v, const Word* lens) const {
    return bits::first_missing(lens, joined_.row(v), v, joined_.words()) == bits::kNone;
  }
  void set_apex(const FlagEdge& e, Vertex apex) {
    apex_ = last_apex_[e.u] = last_apex_[e.v] = apex;
  }
  /// Moves the component of a vertex out of rest_. @return its set.
  Word* take_component(Vertex first);
  void sort_components();

  const BitMatrix& joined_;
  std::pmr::vector<Vertex> last_apex_;  // by end of an edge
  std::pmr::vector<Vertex> roots_;
  std::pmr::vector<Word> sets_;  // a row for each component
  std::pmr::vector<Word> rest_;
  Vertex apex_ = kNone;
};

}  // namespace ph
