// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <limits>
#include <optional>

#include "libph/src/alpha/pairs/alpha_bars.hpp"
#include "ph/detail/components/elder_rule.hpp"

namespace ph::alpha {

/// Computes homology one dimension below the top dimension by union-find (Delfinado & Edelsbrunner,
/// An incremental algorithm for Betti numbers of simplicial complexes, 1995). The nodes are the
/// cells and the outside, which are joined across facets from young to old. A cell that is paired
/// with a facet is joined from the start to the cell across that facet. The root of a component is
/// the outside or the cell that enters last. A facet that joins two components gives birth to a
/// class, and the root that enters earlier kills the class.
///
/// If no facet leads outside, because the triangulation is periodic in all its dimensions, the last
/// cell that enters gives birth to a class of the top dimension. The engine computes no cycles in
/// periodic spaces.
template <Field K>
class Hollows {
 public:
  Hollows(const AlphaCells& cells, const K& field, const RunContext& context, AlphaBars& bars)
      : cells_(cells),
        field_(field),
        context_(context),
        bars_(bars),
        outside_(static_cast<std::uint32_t>(cells.triangulation.size())),
        sets_(outside_ + std::size_t{1}, &context.memory) {
    if (bars.wants_cycles() && bars.wants(cells.dim() - 1))
      rings_.emplace(outside_ + std::size_t{1}, &context.memory);
    for (std::uint32_t t = 0; t < outside_; ++t)
      if (const unsigned beyond = cells.beyond[t]; beyond != 0)
        link(t, sets_.find(node_across(4 * t + lowest(beyond))));  // mutant: alpha-dual-interval
  }

  /// @param facets the critical facets from old to young.
  /// @param is_free returns true if the facet at a position in `facets` is not paired yet.
  /// @param on_join called with the position in `facets` of each facet that joins components.
  template <class IsFree, class OnJoin>
  void run(const RankedSimplices& facets, IsFree&& is_free, OnJoin&& on_join) {
    if (bars_.wants(cells_.dim() - 1))
      bars_.expect(static_cast<std::size_t>(std::ranges::count(cells_.beyond, 0)), facets);
    Ticker ticker(context_, "hollows", facets.size());
    for (std::size_t i = facets.size(); i-- > 0;) {
      ticker.tick();
      constexpr std::size_t ahead = 8;
      if (i >= 3 * ahead)
        prefetch(facets[i - 3 * ahead].code, facets[i - 2 * ahead].code, facets[i - ahead].code);
      if (!is_free(i)) continue;
      const std::uint32_t code = facets[i].code;  // mutant: alpha-dual-order
      std::uint32_t elder = sets_.find(code >> 2), younger = sets_.find(node_across(code));
      if (elder == younger) continue;
      if (enters_later(younger, elder)) std::swap(elder, younger);
      on_join(i);
      if (bars_.wants(cells_.dim() - 1)) report(facets[i].value, code, younger);
      link(younger, elder);
    }
    const std::uint32_t last = sets_.find(0);
    if (last != sets_.find(outside_) && bars_.wants(cells_.dim()))  // mutant: alpha-torus
      bars_.essential(cells_.dim(), value(last), [&] { return cell_simplex(cells_, last); });
  }

 private:
  double value(std::uint32_t node) const {
    // mutant: alpha-dual-outside
    return node == outside_ ? std::numeric_limits<double>::infinity() : cells_.cell_values[node];
  }
  // The dual filtration runs from young to old: the elder component is the one whose root enters
  // later.
  bool enters_later(std::uint32_t a, std::uint32_t b) const {
    const double x = value(a), y = value(b);
    return x != y ? x > y : a > b;  // mutant: alpha-dual-elder
  }
  std::uint32_t node_across(std::uint32_t code) const {
    const std::uint32_t other = cells_.across(code);
    return other == kNone ? outside_ : other >> 2;
  }
  /// Prefetches data of three upcoming facets. Each memory access depends on the result of the
  /// previous access, so a facet is prefetched in three steps: first as `soon`, later as `sooner`,
  /// then as `next`.
  void prefetch(std::uint32_t soon, std::uint32_t sooner, std::uint32_t next) const {
    __builtin_prefetch(&cells_.triangulation.across[soon >> 2]);
    sets_.prefetch(sooner >> 2);
    sets_.prefetch(node_across(sooner));
    sets_.prefetch_parent(next >> 2);
    sets_.prefetch_parent(node_across(next));
  }
  void link(std::uint32_t child, std::uint32_t root) {
    sets_.link(child, root);
    if (rings_) rings_->join(child, root);
  }
  void report(double birth, std::uint32_t code, std::uint32_t killer) {
    const bool wants_cycle = bars_.pair(
        cells_.dim() - 1, birth, value(killer), [&] { return facet_simplex(cells_, code); },
        [&] { return cell_simplex(cells_, killer); });
    if (!wants_cycle) return;
    // The cycle is the boundary of the component's cells, all of which have the same orientation.
    const std::int64_t sign = sign_of(code, killer);
    rings_->for_each(killer, [&](std::uint32_t t) {
      for (std::uint32_t k = 0; k <= static_cast<std::uint32_t>(cells_.dim()); ++k) {
        const std::uint32_t facet = 4 * t + k;
        if (sets_.find(node_across(facet)) != killer)
          bars_.add_term(facet_simplex(cells_, facet), sign * incidence(facet));
      }
    });
    bars_.finish_cycle(field_.is_zero(field_.from_int(2)));
  }
  /// The incidence of a facet in the boundary of its cell, if all cells have the same orientation.
  std::int64_t incidence(std::uint32_t facet) const {
    const bool is_negative = (facet & 1) != 0;
    return is_negative ? -sign(facet >> 2) : sign(facet >> 2);
  }
  std::int64_t sign(std::uint32_t cell) const {
    return cells_.triangulation.is_reversed[cell] != 0 ? -1 : 1;  // mutant: alpha-hollow-sign
  }
  /// The sign of the cycle that gives the facet of the birth the coefficient 1.
  std::int64_t sign_of(std::uint32_t code, std::uint32_t inside) {
    return incidence(sets_.find(code >> 2) == inside ? code : cells_.across(code));
  }

  const AlphaCells& cells_;
  const K& field_;
  const RunContext& context_;
  AlphaBars& bars_;
  const std::uint32_t outside_;
  DisjointSets sets_;
  std::optional<ComponentRings> rings_;
};

}  // namespace ph::alpha
