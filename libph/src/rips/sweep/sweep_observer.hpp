// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "libph/src/rips/sweep/link_graph.hpp"
#include "ph/detail/core/field.hpp"

namespace ph {

/// Thresholds at which a sweep of edge links changes its method. Results do not depend on them.
struct SweepTuning {
  LinkLayout layout = LinkLayout::automatic;
  /// A cocycle over Z/2 is stored as lists instead of rows as long as it has at most this many
  /// terms per vertex on average. Over other fields, or while many classes of H2 are alive, the
  /// limit is higher.
  std::size_t most_terms = 64;
  /// The largest number of vertices for which active edges are stored both as rows and as lists.
  std::size_t vertices_of_active_rows = 1 << 11;
  /// The least number of living classes of H1 for which RelationSolver is used.
  std::size_t classes_for_formal = 1 << 9;
  std::size_t relations_for_formal = 1 << 10;  ///< least number of relations solved together
};

/// The output that is wanted from a sweep of edge links.
struct SweepRequest {
  bool surfaces = false;  ///< true if H2 is wanted
  /// True if H3 is wanted. Needs `surfaces`, and gives only bars of positive length, without
  /// representatives.
  bool volumes = false;
  bool cycles = false;  ///< true if cycles of H1 are wanted
  bool cocycles = false;
  bool zero_length = false;
  SweepTuning tuning = {};
};

/// Receives the events of a sweep of edge links as they happen. Representatives (cycles or
/// cocycles) are empty unless they are wanted, and valid only during the call.
template <Field K>
class SweepObserver {
 public:
  using Vertex = std::uint32_t;
  using Position = std::uint32_t;  ///< position of an edge in the order of the filtration

  /// A triangle, given by its last edge and its third vertex.
  struct Triangle {
    Position edge;
    Vertex apex;
  };
  /// A tetrahedron, given by its last edge and its two other vertices.
  struct Tetrahedron {
    Position edge;
    Vertex larger, smaller;
  };
  /// A simplex of dimension 4, given by its last edge and its three other vertices in descending
  /// order.
  struct Pentachoron {
    Position edge;
    std::array<Vertex, 3> others;
  };
  /// A term of a 1-chain or 1-cochain: its value on an edge, directed from the larger end to the
  /// smaller one.
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
  /// The position of a present edge in the order of the filtration. Called for the edges of cycles.
  virtual Position position_of(Vertex u, Vertex v) const = 0;
  /// Called when two components, named by their oldest vertices, are joined.
  virtual void on_join(Vertex elder, Vertex younger, Position edge) = 0;
  /// Called when a class of H1 dies.
  virtual void on_death(Position birth, Triangle death,
                        std::span<const EdgeValue> representative) = 0;
  /// Called when a class of H2 dies.
  virtual void on_death(Triangle birth, Tetrahedron death,
                        std::span<const TriangleValue> cocycle) = 0;
  /// Called when a class of H3 dies.
  virtual void on_death(Tetrahedron birth, Pentachoron death) = 0;
  /// Called for a class that never dies.
  virtual void on_essential(Position birth, std::span<const EdgeValue> representative) = 0;
  virtual void on_essential(Triangle birth, std::span<const TriangleValue> cocycle) = 0;
  virtual void on_essential(Tetrahedron birth) = 0;
};

}  // namespace ph
