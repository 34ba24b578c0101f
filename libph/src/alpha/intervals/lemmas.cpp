// SPDX-License-Identifier: MIT
#include "libph/src/alpha/intervals/intervals.hpp"

#ifdef NDEBUG

void ph::alpha::check_lemmas(const AlphaCells&) {}

#else

#include <algorithm>
#include <bit>
#include <cassert>
#include <map>
#include <vector>

#include "libph/src/alpha/triangulation/triangulations.hpp"

namespace ph::alpha {
namespace {

using std::uint32_t;

/// All simplices of a triangulation, given by their vertices. The class computes the simplices a
/// second time, in order to check the numbers and names that the pairing uses.
class Lemmas {
 public:
  explicit Lemmas(const AlphaCells& cells) : cells_(cells) {
    const auto size = static_cast<unsigned>(cells.dim()) + 1;
    for (uint32_t t = 0; t < cells.triangulation.size(); ++t)
      for (unsigned places = 1; places < 1U << size; ++places)
        simplices_[vertices(t, places)].value = value(t, places);
  }

  void check() {
    find_inside();
    find_intervals();
    long euler = 0, euler_of_critical = 0;
    for (const auto& [of, simplex] : simplices_) {
      const long sign = size_of(of) % 2 == 1 ? 1 : -1;
      euler += sign;
      if (simplex.inside.empty() && simplex.beyond.empty()) euler_of_critical += sign;
      // A simplex with an empty smallest sphere is the upper end of its own interval. Any other
      // simplex lies in the interval of one larger simplex.
      assert(simplex.claims == (simplex.inside.empty() ? 0 : 1));
    }
    assert(euler == 1 && euler_of_critical == 1);
    check_order();
  }

 private:
  using Vertices = std::array<uint32_t, 4>;  // in ascending order, padded with kNone
  struct Simplex {
    double value = 0;
    std::vector<uint32_t> inside;  // vertices of cofaces that lie inside its smallest sphere
    // Vertices of the simplex that lie inside the smallest sphere of its other vertices.
    std::vector<uint32_t> beyond;
    // Number of intervals of larger simplices that contain this simplex.
    int claims = 0;
  };

  static int size_of(const Vertices& of) {
    return static_cast<int>(std::ranges::count_if(of, [](uint32_t v) { return v != kNone; }));
  }
  static Vertices without(const Vertices& of, uint32_t vertex) {
    Vertices rest{kNone, kNone, kNone, kNone};
    std::size_t size = 0;
    for (const uint32_t v : of)
      if (v != kNone && v != vertex) rest[size++] = v;
    return rest;
  }
  Vertices vertices(uint32_t t, unsigned places) const {
    Vertices of{kNone, kNone, kNone, kNone};
    std::size_t size = 0;
    for (unsigned k = 0; k < 4; ++k)
      if ((places >> k & 1) != 0) of[size++] = cells_.triangulation.cells[t][k];
    return of;
  }
  WeightedSite site(uint32_t v) const { return {cells_.sites.points[v], cells_.sites.weight(v)}; }

  double value(uint32_t t, unsigned places) const {
    const int size = std::popcount(places), top = cells_.dim() + 1;
    if (size == 1) return cells_.vertex_value(cells_.triangulation.cells[t][lowest(places)]);
    if (size == top) return cells_.cell_values[t];
    if (size == top - 1) return facet_value(cells_, 4 * t + lowest(~places));
    const unsigned first = lowest(places), second = lowest(places & (places - 1));
    return cells_.edge_states[cells_.edge_between(t, first, second)].value;
  }

  void find_inside() {
    for (auto& [of, simplex] : simplices_) {
      const int size = size_of(of);
      if (size == 1) continue;
      for (const uint32_t v : of) {
        if (v == kNone) continue;
        const Vertices facet = without(of, v);
        std::vector<WeightedSite> others;
        for (int k = 0; k < size - 1; ++k)
          others.push_back(site(facet[static_cast<std::size_t>(k)]));
        if (!is_inside(others, site(v))) continue;
        simplex.beyond.push_back(v);
        simplices_.at(facet).inside.push_back(v);
      }
    }
  }

  void find_intervals() {
    for (const auto& [of, simplex] : simplices_) {
      if (!simplex.inside.empty()) continue;
      // A face of the simplex `of` that lies in the same interval lacks some of the vertices in
      // `beyond`. Visits each nonempty set of these vertices.
      for (unsigned set = 1; set < 1U << simplex.beyond.size(); ++set) {
        Vertices member = of;
        for (std::size_t i = 0; i < simplex.beyond.size(); ++i)
          if ((set >> i & 1) != 0) member = without(member, simplex.beyond[i]);
        Simplex& lower = simplices_.at(member);
        ++lower.claims;
        assert(lower.value == simplex.value);
      }
    }
  }

  void check_order() const {
    for (const auto& [of, simplex] : simplices_)
      for (const uint32_t v : of)
        assert(v == kNone || size_of(of) == 1 ||
               simplices_.at(without(of, v)).value <= simplex.value);
  }

  const AlphaCells& cells_;
  std::map<Vertices, Simplex> simplices_;
};

}  // namespace

void check_lemmas(const AlphaCells& cells) {
  constexpr std::size_t many = 20'000;
  if (cells.dim() >= 0 && cells.triangulation.size() <= many) Lemmas(cells).check();
}

}  // namespace ph::alpha

#endif
