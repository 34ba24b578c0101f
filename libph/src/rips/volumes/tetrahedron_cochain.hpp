// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "libph/src/rips/annotations/cochain_lists.hpp"
#include "ph/detail/core/field.hpp"

namespace ph {

/// A 3-cochain phi of a flag complex, which is an alternating function of four vertices. Only its
/// non-zero values are stored. Each tetrahedron is in the lists of its four corners.
template <Field K>
class TetrahedronCochain {
 public:
  using Vertex = std::uint32_t;
  using Element = typename K::Element;
  /// The other three vertices of a tetrahedron, 16 bits each, in ascending order from the lowest
  /// bits.
  using Others = std::uint64_t;
  using Lists = CochainLists<K, Others>;
  using Term = typename Lists::Term;
  using Terms = typename Lists::Terms;
  using ListId = typename Lists::ListId;

  static std::array<Vertex, 3> others(const Term& t) {
    return {static_cast<Vertex>(t.cell & 0xFFFF), static_cast<Vertex>(t.cell >> 16 & 0xFFFF),
            static_cast<Vertex>(t.cell >> 32)};
  }
  /// The largest number of vertices, because a vertex takes 16 bits.
  static constexpr std::size_t kMostVertices = 1 << 16;

  /// The value phi(u,v,x,y) on a tetrahedron over an edge uv, given by its other two vertices.
  struct PairValue {
    Vertex x, y;
    Element value;
  };

  /// Data shared by all cochains of a complex.
  struct Shared : Lists::Shared {
    Shared(const K& field_, std::pmr::memory_resource* memory)
        : Lists::Shared(field_, memory), at_u(memory), at_v(memory), at_x(memory) {}
    std::size_t living = 0;  // cochains in use
    std::pmr::vector<Term> at_u, at_v, at_x;
  };

  explicit TetrahedronCochain(std::pmr::memory_resource* memory) : lists_(memory) {}

  static constexpr bool is_dense() { return false; }
  Terms terms(Vertex a, const Shared& shared) const { return lists_.terms(a, shared); }

  /// Adds scale * other. Calls `on_enter(a, list)` for vertices that get their first tetrahedron,
  /// and `on_leave(a)` for vertices that lose their last tetrahedron.
  template <class OnEnter, class OnLeave>
  void add(TetrahedronCochain& other, Element scale, Shared& shared, OnEnter&& on_enter,
           OnLeave&& on_leave) {
    lists_.add(other.lists_, scale, shared, on_enter, on_leave);
  }
  /// Adds each value of the star to phi(u,v,x,y). Each pair comes in both orders. The pairs with
  /// the same x are consecutive. These tetrahedra must have no values yet.
  template <class OnEnter>
  void add_star(Vertex u, Vertex v, std::span<const PairValue> star, Shared& shared,
                OnEnter&& on_enter);
  /// Makes the cochain zero and frees its memory. Calls `on_leave(a)` in the same way as `add`.
  template <class OnLeave>
  void clear(Shared& shared, OnLeave&& on_leave) {
    for (const auto& at : lists_.lists()) on_leave(at.vertex);
    lists_.clear(shared);
  }

 private:
  Lists lists_;
};

template <Field K>
template <class OnEnter>
void TetrahedronCochain<K>::add_star(Vertex u, Vertex v, std::span<const PairValue> star,
                                     Shared& shared, OnEnter&& on_enter) {
  const K& field = shared.field;
  // The term phi(a,b,c,d) = value, for the list of a.
  const auto term = [&](Vertex b, Vertex c, Vertex d, Element value) {
    const bool is_odd = ((b > c) != (b > d)) != (c > d);
    const Vertex low = std::min({b, c, d}), high = std::max({b, c, d});
    const Others middle = b ^ c ^ d ^ low ^ high;
    // mutant: volume-star-sign
    return Term(Others{high} << 32 | middle << 16 | low, is_odd ? field.negate(value) : value);
  };
  auto &at_u = shared.at_u, &at_v = shared.at_v, &at_x = shared.at_x;
  at_u.clear();
  at_v.clear();
  for (std::size_t i = 0; i < star.size();) {
    const Vertex x = star[i].x;
    at_x.clear();
    for (; i < star.size() && star[i].x == x; ++i) {
      const Vertex y = star[i].y;
      const Element value = star[i].value;
      at_x.push_back(term(u, v, y, value));  // phi(x,u,v,y)
      if (x > y) continue;
      at_u.push_back(term(v, x, y, value));
      at_v.push_back(term(u, x, y, field.negate(value)));
    }
    lists_.append_terms(x, at_x, shared, on_enter);
  }
  lists_.append_terms(u, at_u, shared, on_enter);
  lists_.append_terms(v, at_v, shared, on_enter);
}

}  // namespace ph
