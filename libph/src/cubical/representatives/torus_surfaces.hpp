// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "libph/src/cubical/columns/voxel_chain.hpp"
#include "libph/src/cubical/stars/facet_search.hpp"
#include "ph/detail/core/raw_vector.hpp"

namespace ph::cubical {

/// Cycles for the surfaces that never die, in a grid with three periodic axes.
///
/// Top cells are connected across facets that are younger than the facet that gives birth to the
/// surface. Following paths across these facets gives each top cell a place in the universal cover
/// of the torus. Consider a linear function of the numbers of turns around the axes that vanishes
/// on all closed paths except the path that the birth closes. This function jumps only at the facet
/// of the birth and at older facets, and its jumps form a cycle.
template <Field K>
class TorusSurfaces {
 public:
  TorusSurfaces(const StarGrid& grid, const K& field, const RunContext& context)
      : grid_(grid), field_(field), context_(context) {}

  /// Appends the cycle of a class that a facet gives birth to. Precondition: all three axes are
  /// periodic, and the facet is in no pair.
  void append(const StarCell& birth, VoxelChain<K>& chain) const {
    RawVector<Turns> at(grid_.size(), &context_.memory);
    std::vector<Function> functions = functions_of(birth, at);
    const Function* function = nullptr;
    for_each_crossing([&](std::uint32_t node, std::uint32_t to, const Step& step) {
      const auto facet = in_its_star(grid_, step.voxel, step.facet);
      if (!facet || facet->voxel != birth.voxel || facet->direction != birth.direction) return;
      for (const Function& f : functions)
        if (!field_.is_zero(value(f, jump(at, node, to, step)))) function = &f;
    });
    if (function == nullptr) return;
    for_each_crossing([&](std::uint32_t node, std::uint32_t to, const Step& step) {
      const Element a = value(*function, jump(at, node, to, step));
      if (field_.is_zero(a)) return;
      chain.emplace_back(StarCell{step.voxel, step.facet, 0},
                         step.axis % 2 == 0 ? a : field_.negate(a));
    });
  }

 private:
  using Element = typename K::Element;
  using Turns = std::array<std::int32_t, 3>;
  using Function = std::array<Element, 3>;
  // A step from a top cell across one of its facets.
  struct Step {
    int axis;
    std::uint32_t voxel;  // the voxel of the facet
    Direction facet;
    int turn;  // the change of the number of turns around the axis
  };

  Step step(std::uint32_t node, std::uint32_t to, int axis, int sign) const {
    const std::uint32_t x = grid_.coordinate(node, axis), last = grid_.extent(axis) - 1;
    const int turn = sign > 0 ? (x == last ? 1 : 0) : (x == 0 ? -1 : 0);
    Direction d{};
    if (grid_.is_t_construction()) {  // in the T-construction, top cells are voxels
      d[axis] = sign;
      return {axis, node, d, turn};
    }
    d = {1, 1, 1};
    d[axis] = 0;
    return {axis, sign > 0 ? to : node, d, turn};
  }
  // Calls `use` with each step upwards along each axis.
  template <class Use>
  void for_each_crossing(Use&& use) const {
    Ticker ticker(context_, {});
    for (std::uint32_t node = 0; node < grid_.size(); ++node) {
      ticker.work();
      for (int a = 0; a < 3; ++a) {
        const std::uint32_t to = grid_.step(node, a, 1);
        use(node, to, step(node, to, a, 1));
      }
    }
  }
  // True if the cycle must not contain a facet, because the facet is younger than the birth or
  // never enters.
  bool is_open(const StarCell& birth, const Step& step) const {
    const auto facet = in_its_star(grid_, step.voxel, step.facet);
    if (!facet) return true;
    return grid_.is_t_construction() ? comes_before(grid_, *facet, birth)
                                     : comes_before(grid_, birth, *facet);
  }

  static Turns jump(const RawVector<Turns>& at, std::uint32_t from, std::uint32_t to,
                    const Step& step) {
    Turns result = at[from];
    result[static_cast<std::size_t>(step.axis)] += step.turn;
    for (std::size_t a = 0; a < 3; ++a) result[a] -= at[to][a];
    return result;
  }
  Element value(const Function& function, const Turns& turns) const {
    Element sum = field_.from_int(0);
    for (std::size_t a = 0; a < 3; ++a)
      sum = field_.add(sum, field_.multiply(function[a], field_.from_int(turns[a])));
    return sum;
  }

  // A basis of the linear functions that vanish on all closed paths across open facets. @param at
  // receives the place of each cell in the universal cover.
  std::vector<Function> functions_of(const StarCell& birth, RawVector<Turns>& at) const {
    const Element zero = field_.from_int(0), one = field_.from_int(1);
    std::vector<Function> functions{{one, zero, zero}, {zero, one, zero}, {zero, zero, one}};
    std::pmr::vector<bool> is_met(grid_.size(), false, &context_.memory);
    std::pmr::vector<std::uint32_t> queue(&context_.memory);
    Ticker ticker(context_, "surfaces", grid_.size());
    for (std::uint32_t first = 0; first < grid_.size(); ++first) {
      if (is_met[first]) continue;
      is_met[first] = true;
      at[first] = {};
      queue.assign(1, first);
      while (!queue.empty()) {
        const std::uint32_t node = queue.back();
        queue.pop_back();
        ticker.tick();
        for (int a = 0; a < 3; ++a)
          for (const int sign : {-1, 1}) {
            const std::uint32_t to = grid_.step(node, a, sign);
            const Step step = this->step(node, to, a, sign);
            if (!is_open(birth, step)) continue;
            if (is_met[to]) {
              restrict(functions, jump(at, node, to, step));
              continue;
            }
            is_met[to] = true;
            at[to] = at[node];
            at[to][static_cast<std::size_t>(a)] += step.turn;
            queue.push_back(to);
          }
      }
    }
    return functions;
  }
  // Restricts the basis to the functions that vanish on a closed path.
  void restrict(std::vector<Function>& functions, const Turns& path) const {
    if (path == Turns{}) return;
    const auto used = std::ranges::find_if(
        functions, [&](const Function& f) { return !field_.is_zero(value(f, path)); });
    if (used == functions.end()) return;
    const Function f = *used;
    functions.erase(used);
    const Element inverse = field_.inverse(value(f, path));
    for (Function& g : functions) {
      const Element factor = field_.negate(field_.multiply(value(g, path), inverse));
      for (std::size_t a = 0; a < 3; ++a) g[a] = field_.add(g[a], field_.multiply(factor, f[a]));
    }
  }

  const StarGrid& grid_;
  const K& field_;
  const RunContext& context_;
};

}  // namespace ph::cubical
