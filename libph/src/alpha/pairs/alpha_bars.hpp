// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

#include "libph/src/alpha/intervals/intervals.hpp"
#include "libph/src/alpha/pairs/critical_simplices.hpp"
#include "ph/alpha.hpp"
#include "ph/detail/core/barcode_builder.hpp"

namespace ph::alpha {

/// A simplex, given by its sites in ascending order.
struct Simplex {
  std::array<std::uint32_t, 4> sites{kNone, kNone, kNone, kNone};
  std::size_t size = 0;

  static Simplex of(std::initializer_list<std::uint32_t> list) {
    Simplex simplex;
    for (const std::uint32_t site : list) simplex.sites[simplex.size++] = site;
    return simplex;
  }
};

inline Simplex edge_simplex(const AlphaCells& cells, std::uint32_t e) {
  return Simplex::of({cells.edges.ends[e][0], cells.edges.ends[e][1]});
}
inline Simplex facet_simplex(const AlphaCells& cells, std::uint32_t code) {
  const auto v = cells.facet_vertices(code);
  return cells.dim() == 3 ? Simplex::of({v[0], v[1], v[2]}) : Simplex::of({v[0], v[1]});
}
inline Simplex cell_simplex(const AlphaCells& cells, std::uint32_t t) {
  return {cells.triangulation.cells[t], static_cast<std::size_t>(cells.dim()) + 1};
}

/// Turns pairs of simplices into bars, and passes bars and cycles on to a BarcodeBuilder. The class
/// receives simplices as sites, and replaces the sites by points of the input.
class AlphaBars {
 public:
  AlphaBars(const Alpha& alpha, BarcodeBuilder<Alpha>& bars)
      : alpha_(alpha), cells_(alpha.cells()), bars_(bars) {
    constexpr std::size_t many = 4096;
    some_.reserve(many);
  }

  bool wants(int dim) const { return bars_.min_dim() <= dim && dim <= bars_.max_dim(); }
  bool wants_cycles() const { return bars_.representatives() == Representatives::cycles; }
  /// Reserves memory for about `count` more bars.
  void expect(std::size_t count) {
    if (!bars_.wants_cells() && !wants_cycles()) bars_.expect(some_.size() + count);
  }
  /// Reserves memory for `most` more bars, or for fewer if `simplices` has fewer simplices up to
  /// the threshold. The simplices must be sorted by value.
  void expect(std::size_t most, const RankedSimplices& simplices) {
    const auto beyond = std::ranges::partition_point(simplices, [&](const Ranked& simplex) {
      return alpha_.to_value(simplex.value) <= alpha_.threshold();
    });
    expect(std::min(most, static_cast<std::size_t>(beyond - simplices.begin())));
  }
  /// Passes the remaining bars on; must be called last.
  void flush() {
    bars_.add_bars(some_);
    some_.clear();
  }
  /// Adds the bar of a class that is born and dies at the given squared radii. @return true if the
  /// bar is kept and its cycle is wanted.
  /// @param born, killer called only if cells are wanted; they return the simplices of the birth
  /// and of the death.
  template <class Born, class Killer>
  bool pair(int dim, double birth, double death, Born&& born, Killer&& killer) {
    if (birth == death) return false;
    Bar bar{dim, alpha_.to_value(birth), alpha_.to_value(death)};
    if (bar.birth > alpha_.threshold()) return false;
    if (bar.death > alpha_.threshold()) bar.death = kInfinity;  // mutant: alpha-death-limit
    return add(bar, born, killer);
  }
  template <class Born>
  bool essential(int dim, double birth, Born&& born) {
    const Bar bar{dim, alpha_.to_value(birth), kInfinity};
    return bar.birth <= alpha_.threshold() && add(bar, born, [] { return Simplex(); });
  }

  /// Adds a term to the cycle of the last bar that was kept.
  void add_term(const Simplex& simplex, std::int64_t coefficient) {
    const bool is_odd = append(simplex, numbers_);
    coefficients_.push_back(is_odd ? -coefficient : coefficient);  // mutant: alpha-input-sign
  }
  /// @param is_z2 true over Z/2, where all coefficients are 1.
  void finish_cycle(bool is_z2) {
    if (is_z2) std::ranges::fill(coefficients_, 1);
    bars_.add_representative(numbers_, coefficients_);
    numbers_.clear();
    coefficients_.clear();
  }

 private:
  /// Appends the input points of a simplex in ascending order. @return true if the permutation that
  /// sorts them is odd.
  bool append(const Simplex& simplex, std::vector<Index>& numbers) const {
    const std::size_t begin = numbers.size();
    bool is_odd = false;
    for (std::size_t i = 0; i < simplex.size; ++i) {
      numbers.push_back(cells_.sites.input[simplex.sites[i]]);
      for (std::size_t k = numbers.size() - 1; k > begin && numbers[k - 1] > numbers[k]; --k) {
        std::swap(numbers[k - 1], numbers[k]);
        is_odd = !is_odd;
      }
    }
    return is_odd;
  }
  template <class Born, class Killer>
  bool add(const Bar& bar, Born&& born, Killer&& killer) {
    if (!bars_.wants_cells() && !wants_cycles()) {
      some_.push_back(bar);
      if (some_.size() == some_.capacity()) flush();
      return false;
    }
    if (!bars_.wants_cells()) return bars_.add_bar(bar, {}, {});
    birth_.clear();
    death_.clear();
    append(born(), birth_);
    if (!bar.is_infinite()) append(killer(), death_);
    return bars_.add_bar(bar, birth_, death_) && wants_cycles();
  }

  const Alpha& alpha_;
  const AlphaCells& cells_;
  BarcodeBuilder<Alpha>& bars_;
  std::vector<Bar> some_;  // bars without cells that have not been passed on yet
  std::vector<Index> birth_, death_, numbers_;
  std::vector<std::int64_t> coefficients_;
};

}  // namespace ph::alpha
