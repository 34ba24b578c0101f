// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <vector>

#include "ph/detail/components/elder_rule.hpp"
#include "ph/detail/core/barcode_builder.hpp"
#include "ph/detail/core/chain.hpp"
#include "ph/detail/core/field.hpp"
#include "ph/filtration.hpp"

namespace ph {

/// Gives the bars of H0 their representatives, if representatives are wanted: the cycle is the
/// difference of the oldest vertices of the two components that join; the cocycle is 1 on the
/// component that dies and 0 on all others.
template <Filtration F, Field K>
class ComponentRepresentatives {
 public:
  ComponentRepresentatives(std::size_t vertices, const K& field, BarcodeBuilder<F>& bars,
                           std::pmr::memory_resource* memory)
      : field_(field),
        bars_(bars),
        components_(is_wanted(Representatives::cocycles) ? vertices : 0, memory),
        terms_(memory) {}

  /// Sets the representative of the last bar added. @param cell_of maps a vertex to its cell.
  /// @param v the oldest vertex of the component.
  /// @param elder the oldest vertex of the component that v's component is about to join, or none
  /// if v's component survives.
  template <class CellOf>
  void give(std::uint32_t v, std::optional<std::uint32_t> elder, CellOf&& cell_of) {
    if (is_wanted(Representatives::none)) return;
    terms_.clear();
    const auto add = [&](std::uint32_t w, int a) {
      terms_.emplace_back(cell_of(w), field_.from_int(a));
    };
    if (is_wanted(Representatives::cocycles)) {
      components_.for_each(v, [&](std::uint32_t w) { add(w, 1); });
    } else {
      add(v, 1);
      if (elder) add(*elder, -1);
    }
    bars_.add_representative(0, terms_, field_);
  }
  void join(std::uint32_t elder, std::uint32_t younger) {
    if (is_wanted(Representatives::cocycles)) components_.join(elder, younger);
  }

 private:
  bool is_wanted(Representatives kind) const { return bars_.representatives() == kind; }

  const K& field_;
  BarcodeBuilder<F>& bars_;
  ComponentRings components_;
  std::pmr::vector<Entry<typename F::Cell, K>> terms_;
};

}  // namespace ph
