// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "ph/detail/core/field.hpp"
#include "rips/sweep/link_graph.hpp"

namespace ph {

/// When a sweep of edge links takes which way; results do not depend on it.
struct SweepTuning {
  LinkLayout layout = LinkLayout::automatic;
  std::size_t most_terms = 64;  ///< of a cocycle at a vertex, on average: more become rows
  std::size_t vertices_of_active_rows = 1 << 11;  ///< at most: for more, lists of active edges do
  std::size_t classes_for_formal = 1 << 9;        ///< of H1 alive, at least: for RelationSolver
  std::size_t relations_for_formal = 1 << 10;     ///< solved together, at least
};

/// What a sweep of edge links is to find.
struct SweepRequest {
  bool surfaces = false;  ///< H2 too
  bool volumes = false;   ///< H3 too; with surfaces, bars alone, without those of length zero
  bool cycles = false;    ///< of H1
  bool cocycles = false;
  bool zero_length = false;
  SweepTuning tuning = {};
};

/// Hears what happens in a sweep of edge links, as it happens. Representatives, cycles or cocycles,
/// are empty unless they are wanted, and valid during the call.
template <Field K>
class SweepObserver {
 public:
  using Vertex = std::uint32_t;
  using Position = std::uint32_t;  ///< of an edge in the order of the filtration

  /// The triangle over an edge with one more vertex; the edge is its last.
  struct Triangle {
    Position edge;
    Vertex apex;
  };
  /// The tetrahedron over an edge with two more vertices.
  struct Tetrahedron {
    Position edge;
    Vertex larger, smaller;
  };
  /// The simplex over an edge with three more vertices, descending.
  struct Pentachoron {
    Position edge;
    std::array<Vertex, 3> others;
  };
  /// A term of a 1-chain or 1-cochain: its value on an edge, from the larger end to the smaller.
  struct EdgeValue {
    Position edge;
    typename K::Element value;
  };
  /// A term of a 2-cochain: the value on a triangle with ascending vertices.
  struct TriangleValue {
    std::array<Vertex, 3> vertices;
    typename K::Element value;
  };

  virtual ~SweepObserver() = default;
  /// Where an edge so far is in the order; asked for the edges of cycles.
  virtual Position position_of(Vertex u, Vertex v) const = 0;
  /// Two components are joined, named by their oldest vertices.
  virtual void on_join(Vertex elder, Vertex younger, Position edge) = 0;
  /// A class of H1 dies.
  virtual void on_death(Position birth, Triangle death,
                        std::span<const EdgeValue> representative) = 0;
  /// A class of H2 dies.
  virtual void on_death(Triangle birth, Tetrahedron death,
                        std::span<const TriangleValue> cocycle) = 0;
  /// A class of H3 dies.
  virtual void on_death(Tetrahedron birth, Pentachoron death) = 0;
  /// A class that never dies.
  virtual void on_essential(Position birth, std::span<const EdgeValue> representative) = 0;
  virtual void on_essential(Triangle birth, std::span<const TriangleValue> cocycle) = 0;
  virtual void on_essential(Tetrahedron birth) = 0;
};

}  // namespace ph
