// SPDX-License-Identifier: MIT
#pragma once
// Checks by the definitions that a chain is a representative of a bar.
#include "tests/support/conformance.hpp"

namespace ph::test {

/// A chain of cells of one dimension. Each cell is named by its position in the order, and the
/// coefficients are 1 … p-1.
using PositionChain = std::map<std::size_t, std::int64_t>;

/// The cells of a filtration in order, and their boundaries as chains of positions. Both are stored
/// separately for each dimension.
template <Filtration F>
class OrderedCells {
 public:
  OrderedCells(const F& f, int top, std::int64_t p) : p_(p) {
    for (int dim = 0; dim <= std::min(top, f.top_dim()); ++dim) {
      auto& level = levels_.emplace_back();
      for (const auto& cell : sorted_cells(f, dim)) {
        std::vector<Index> numbers;
        f.append_input_cell(dim, cell, numbers);
        PositionChain boundary;
        f.for_each_facet(dim, cell, [&](const auto& facet, int incidence) {
          std::vector<Index> name;
          f.append_input_cell(dim - 1, facet, name);
          add(boundary, levels_[levels_.size() - 2].position.at(name), incidence);
        });
        level.position.emplace(numbers, level.boundary.size());
        level.boundary.push_back(boundary);
      }
    }
  }

  std::size_t count(int dim) const {
    return dim < static_cast<int>(levels_.size()) ? at(dim).boundary.size() : 0;
  }
  std::size_t position(int dim, const InputCell& cell) const {
    return at(dim).position.at({cell.numbers.begin(), cell.numbers.end()});
  }
  const PositionChain& boundary(int dim, std::size_t i) const { return at(dim).boundary[i]; }
  void add(PositionChain& chain, std::size_t cell, std::int64_t a) const {
    auto& sum = chain[cell];
    sum = ((sum + a) % p_ + p_) % p_;
    if (sum == 0) chain.erase(cell);
  }
  PositionChain read(int dim, const InputChain& chain) const {
    PositionChain result;
    for (std::size_t i = 0; i < chain.size(); ++i) {
      const std::size_t cell = position(dim, chain.cell(i));
      EXPECT_FALSE(result.contains(cell)) << "a cell occurs twice";
      add(result, cell, chain.coefficient(i));
      EXPECT_TRUE(result.contains(cell)) << "a coefficient is zero";
    }
    return result;
  }
  /// True if the chain of dimension `dim` is the boundary of a chain of the first `cofaces` cells
  /// of dimension dim + 1.
  bool is_boundary(PositionChain chain, int dim, std::size_t cofaces) const {
    std::map<std::size_t, PositionChain> reduced;  // the key is the youngest cell
    const auto reduce = [&](PositionChain& c) {
      while (!c.empty() && reduced.contains(c.rbegin()->first)) {
        const PositionChain& r = reduced.at(c.rbegin()->first);
        const std::int64_t factor = -c.rbegin()->second * inverse(r.rbegin()->second) % p_;
        for (const auto& [cell, a] : r) add(c, cell, factor * a);
      }
    };
    for (std::size_t i = 0; i < cofaces; ++i) {
      PositionChain column = boundary(dim + 1, i);
      reduce(column);
      if (!column.empty()) reduced.emplace(column.rbegin()->first, column);
    }
    reduce(chain);
    return chain.empty();
  }

 private:
  struct Level {
    std::map<std::vector<Index>, std::size_t> position;
    std::vector<PositionChain> boundary;
  };
  const Level& at(int dim) const { return levels_[static_cast<std::size_t>(dim)]; }
  std::int64_t inverse(std::int64_t a) const {
    for (std::int64_t b = 1; b < p_; ++b)
      if (a * b % p_ == 1) return b;
    return 0;
  }
  std::int64_t p_;
  std::vector<Level> levels_;
};

/// The representative of a bar, which must be a cycle. Checks that it has no boundary.
template <Filtration F>
PositionChain closed_cycle(const OrderedCells<F>& cells, const Barcode& bars, std::size_t i) {
  const int dim = bars[i].dim;
  PositionChain cycle = cells.read(dim, bars.representative(i));
  PositionChain boundary;
  for (const auto& [cell, a] : cycle)
    for (const auto& [face, b] : cells.boundary(dim, cell)) cells.add(boundary, face, a * b);
  EXPECT_TRUE(boundary.empty()) << "the cycle is not closed";
  return cycle;
}

/// Checks a cycle: it has no boundary, its youngest cell is the birth cell, and it becomes a
/// boundary at the death, not earlier.
template <Filtration F>
void check_cycle(const OrderedCells<F>& cells, const Barcode& bars, std::size_t i) {
  const int dim = bars[i].dim;
  const PositionChain cycle = closed_cycle(cells, bars, i);
  ASSERT_FALSE(cycle.empty());
  EXPECT_EQ(cycle.rbegin()->first, cells.position(dim, bars.birth_cell(i)));
  const auto death = bars.death_cell(i);
  const std::size_t at = death ? cells.position(dim + 1, *death) : cells.count(dim + 1);
  EXPECT_FALSE(cells.is_boundary(cycle, dim, at)) << "the cycle is a boundary before its death";
  if (death) {
    EXPECT_TRUE(cells.is_boundary(cycle, dim, at + 1)) << "the cycle is no boundary at its death";
  }
}

/// Checks a cocycle: it is zero before the birth, and its coboundary becomes non-zero at the death,
/// not earlier.
template <Filtration F>
void check_cocycle(const OrderedCells<F>& cells, const Barcode& bars, std::size_t i) {
  const int dim = bars[i].dim;
  const PositionChain cochain = cells.read(dim, bars.representative(i));
  ASSERT_FALSE(cochain.empty());
  EXPECT_EQ(cochain.begin()->first, cells.position(dim, bars.birth_cell(i)));
  const auto death = bars.death_cell(i);
  const std::size_t at = death ? cells.position(dim + 1, *death) : cells.count(dim + 1);
  for (std::size_t coface = 0; coface <= at && coface < cells.count(dim + 1); ++coface) {
    PositionChain value;  // the coboundary at this coface, as a chain of one entry
    for (const auto& [face, b] : cells.boundary(dim + 1, coface))
      if (cochain.contains(face)) cells.add(value, 0, b * cochain.at(face));
    EXPECT_EQ(value.empty(), coface < at) << "coboundary at coface " << coface << " of " << at;
  }
}

/// Checks all representatives from every engine that computes representatives. Bars of length 0 are
/// included. The bars must equal the bars of the oracle.
template <Filtration F>
void check_representatives(const F& f, int max_dim, std::int64_t field) {
  max_dim = std::min(max_dim, std::max(0, f.top_dim()));
  const OrderedCells<F> cells(f, max_dim + 1, field);
  const auto oracle = pairs_of(f, max_dim, field, Engine::standard);
  for (const Representatives wanted : {Representatives::cycles, Representatives::cocycles}) {
    for (const auto& engine : detail::engines<F>()) {
      if (!engine.can_run(f, Task{max_dim, wanted, true})) continue;
      SCOPED_TRACE(std::string(engine.id.name()) +
                   (wanted == Representatives::cycles ? ", cycles" : ", cocycles"));
      const Barcode bars = persistence(f, Options{.max_dim = max_dim,
                                                  .field = field,
                                                  .engine = engine.id,
                                                  .min_persistence = -1,
                                                  .representatives = wanted});
      ASSERT_EQ(pairs_of(bars), oracle);
      for (std::size_t i = 0; i < bars.size(); ++i) {
        SCOPED_TRACE("bar " + std::to_string(i));
        if (wanted == Representatives::cycles)
          check_cycle(cells, bars, i);
        else
          check_cocycle(cells, bars, i);
      }
    }
  }
}

}  // namespace ph::test
