// SPDX-License-Identifier: MIT
#pragma once
// The conformance suite, which every filtration and every engine must pass.
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>
#include <sstream>
#include <tuple>
#include <vector>

#include "ph/custom.hpp"
#include "ph/detail/core/range_filtration.hpp"
#include "tests/support/rips_graphs.hpp"

namespace ph::test {

/// A pair with its cells. Pairs of length 0 are included, because engines must agree on them as
/// well.
struct Pair {
  Bar bar;
  std::vector<Index> birth_cell, death_cell;

  friend bool operator==(const Pair&, const Pair&) = default;
  friend bool operator<(const Pair& a, const Pair& b) {
    return std::tie(a.bar.dim, a.bar.birth, a.bar.death, a.birth_cell, a.death_cell) <
           std::tie(b.bar.dim, b.bar.birth, b.bar.death, b.birth_cell, b.death_cell);
  }
  friend std::ostream& operator<<(std::ostream& out, const Pair& p) {
    out << "H" << p.bar.dim << " [" << p.bar.birth << ", " << p.bar.death << ") born with (";
    for (const Index i : p.birth_cell) out << " " << i;
    out << " ) killed by (";
    for (const Index i : p.death_cell) out << " " << i;
    return out << " )";
  }
};

inline std::vector<Pair> pairs_of(const Barcode& barcode) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < barcode.size(); ++i) {
    const auto birth = barcode.birth_cell(i).numbers;
    Pair pair{barcode[i], {birth.begin(), birth.end()}, {}};
    if (const auto death = barcode.death_cell(i))
      pair.death_cell.assign(death->numbers.begin(), death->numbers.end());
    pairs.push_back(std::move(pair));
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// All pairs that an engine finds, including pairs of length 0.
template <class Complex>
std::vector<Pair> pairs_of(const Complex& complex, int max_dim, std::int64_t field, Engine engine) {
  return pairs_of(persistence(
      complex,
      Options{.max_dim = max_dim, .field = field, .engine = engine, .min_persistence = -1}));
}

/// The pairs of positive length. Classes that never die are kept, whatever their births are.
inline std::vector<Pair> of_positive_length(std::vector<Pair> pairs) {
  std::erase_if(pairs,
                [](const Pair& p) { return !p.death_cell.empty() && p.bar.death == p.bar.birth; });
  return pairs;
}

/// The cells of one dimension, oldest first.
template <Filtration F>
std::vector<typename F::Cell> sorted_cells(const F& f, int dim) {
  std::vector<typename F::Cell> cells;
  f.for_each_cell(dim, [&](const auto& c) { cells.push_back(c); });
  std::sort(cells.begin(), cells.end(),
            [&](const auto& a, const auto& b) { return f.precedes(a, b); });
  return cells;
}

/// Checks the range functions of a filtration for one cell. The cofacets are requested for one
/// interval of keys after another, and the keys of cofacets are requested one by one. The results
/// must equal the list of all cofacets, in the same order.
template <RangeFiltration F>
void check_ranges(const F& f, int dim, const typename F::Cell& cell) {
  using Key = decltype(f.key(cell));
  using Entry = std::tuple<Key, typename F::Cell, int>;
  std::vector<Entry> all;
  f.for_each_cofacet(dim, cell, [&](const auto& cofacet, int incidence) {
    all.emplace_back(f.key(cofacet), cofacet, incidence);
    return true;
  });
  const auto expect_range = [&](Key first, Key last) {
    std::vector<Entry> expected, found;
    std::copy_if(all.begin(), all.end(), std::back_inserter(expected), [&](const Entry& entry) {
      return std::get<0>(entry) >= first && std::get<0>(entry) <= last;
    });
    f.for_each_cofacet_within(dim, cell, first, last, [&](const auto& cofacet, int incidence) {
      found.emplace_back(f.key(cofacet), cofacet, incidence);
      return true;
    });
    EXPECT_TRUE(found == expected) << "cofacets with keys " << first << " to " << last;
  };
  for (Key first = f.key(cell);;) {
    const Key last = f.horizon(first);
    ASSERT_GE(last, first);
    expect_range(first, last);
    if (last == std::numeric_limits<Key>::max()) break;
    first = last + 1;
  }
  for (const Entry& entry : all) expect_range(std::get<0>(entry), std::get<0>(entry));
}

/// Checks the contract of ph/filtration.hpp, cell by cell up to dimension `top`.
template <Filtration F>
void check_contract(const F& f, int top, std::int64_t field) {
  using Cell = typename F::Cell;
  top = std::min(top, f.top_dim());
  std::vector<Cell> lower;
  std::map<std::pair<std::vector<Index>, std::vector<Index>>, int> facet_entries, cofacet_entries;
  const auto name = [&](int dim, const Cell& c) {
    std::vector<Index> numbers;
    f.append_input_cell(dim, c, numbers);
    return numbers;
  };
  for (int dim = 0; dim <= top; ++dim) {
    const std::vector<Cell> cells = sorted_cells(f, dim);
    for (std::size_t i = 1; i < cells.size(); ++i) {
      ASSERT_TRUE(f.precedes(cells[i - 1], cells[i])) << "the order is not strict";
      ASSERT_LE(f.value(cells[i - 1]), f.value(cells[i])) << "the order does not refine the value";
    }
    facet_entries.clear();
    for (const Cell& c : cells) {
      std::map<std::vector<Index>, long> square;
      f.for_each_facet(dim, c, [&](const Cell& facet, int incidence) {
        ASSERT_LE(f.value(facet), f.value(c)) << "a face enters after its coface";
        ASSERT_TRUE(
            std::binary_search(lower.begin(), lower.end(), facet,
                               [&](const Cell& a, const Cell& b) { return f.precedes(a, b); }))
            << "a facet is not a cell";
        if (dim > 1) {
          f.for_each_facet(dim - 1, facet, [&](const Cell& ridge, int second) {
            square[name(dim - 2, ridge)] += long{incidence} * second;
          });
        }
        const bool is_new =
            facet_entries.emplace(std::pair(name(dim - 1, facet), name(dim, c)), incidence).second;
        ASSERT_TRUE(is_new) << "a facet is visited twice";
      });
      for (const auto& [ridge, sum] : square)
        ASSERT_EQ(sum % field, 0) << "the boundary of a boundary is not zero";
    }
    if constexpr (CofacetFiltration<F>) {
      cofacet_entries.clear();
      for (const Cell& c : lower) {
        std::vector<Cell> equal;
        f.for_each_cofacet(dim - 1, c, [&](const Cell& cofacet, int incidence) {
          if (f.key(cofacet) == f.key(c)) equal.push_back(cofacet);
          EXPECT_GE(f.key(cofacet), f.key(c));
          cofacet_entries.emplace(std::pair(name(dim - 1, c), name(dim, cofacet)), incidence);
          return true;
        });
        if (F::first_equal_cofacet_is_oldest) {
          for (const Cell& other : equal)
            ASSERT_FALSE(f.precedes(other, equal.front())) << "a false claim: oldest cofacet first";
        }
        if constexpr (RangeFiltration<F>) {
          ASSERT_NO_FATAL_FAILURE(check_ranges(f, dim - 1, c));
        }
      }
      ASSERT_EQ(facet_entries, cofacet_entries) << "facets and cofacets disagree, dim " << dim;
    }
    if constexpr (SlottedFiltration<F>) {
      std::vector<std::size_t> slots;
      for (const Cell& c : cells) slots.push_back(f.slot(c));
      std::sort(slots.begin(), slots.end());
      ASSERT_TRUE(std::adjacent_find(slots.begin(), slots.end()) == slots.end());
      ASSERT_TRUE(slots.empty() || slots.back() < f.slot_count());
    }
    lower = cells;
  }
}

/// A view of a filtration that hides its apparent pairs. check_apparent_pairs compares the pairs of
/// the filtration with the pairs found by a search through all facets and cofacets of the view.
template <Filtration F>
struct WithoutApparent {
  using Cell = typename F::Cell;
  const F& f;
  static constexpr bool first_equal_cofacet_is_oldest = F::first_equal_cofacet_is_oldest;
  int top_dim() const { return f.top_dim(); }
  double value(const Cell& c) const { return f.value(c); }
  auto key(const Cell& c) const { return f.key(c); }
  bool precedes(const Cell& a, const Cell& b) const { return f.precedes(a, b); }
  CellKind cell_kind() const { return f.cell_kind(); }
  void append_input_cell(int dim, const Cell& c, std::vector<Index>& numbers) const {
    f.append_input_cell(dim, c, numbers);
  }
  void for_each_cell(int dim, auto&& visit) const { f.for_each_cell(dim, visit); }
  void for_each_facet(int dim, const Cell& c, auto&& visit) const {
    f.for_each_facet(dim, c, visit);
  }
  void for_each_cofacet(int dim, const Cell& c, auto&& visit) const {
    f.for_each_cofacet(dim, c, visit);
  }
};

template <ApparentFiltration F>
void check_apparent_pairs(const F& f, int top) {
  using Cell = typename F::Cell;
  const WithoutApparent<F> view{f};
  const ApparentPairs<WithoutApparent<F>, Z2> searched(view, Z2{});
  for (int dim = 0; dim <= std::min(top, f.top_dim()); ++dim) {
    std::vector<Cell> unmatched, found;
    for (const Cell& c : sorted_cells(f, dim)) {
      const auto death = searched.death_cell_of(dim, c), birth = searched.birth_cell_of(dim, c);
      ASSERT_EQ(f.apparent_cofacet(dim, c), death);
      ASSERT_EQ(f.apparent_facet(dim, c), birth);
      if (!death && !birth) unmatched.push_back(c);
    }
    if (dim == 0) continue;
    std::reverse(unmatched.begin(), unmatched.end());
    // The cells are requested in several calls, as in the engines.
    auto cells = f.unmatched_cells(dim);
    for (std::size_t last = f.group_count(); last > 0; last -= std::min<std::size_t>(last, 3))
      cells.for_each(
          last - std::min<std::size_t>(last, 3), last, [&](const Cell& c) { found.push_back(c); },
          [] {});
    ASSERT_EQ(found, unmatched) << "cells in no apparent pair, dim " << dim;
  }
}

/// Checks the Euler characteristic at every value: the alternating sum of the numbers of cells must
/// equal the alternating sum of the numbers of living bars.
template <Filtration F>
void check_euler(const F& f, const std::vector<Pair>& pairs) {
  std::map<double, long> change;
  for (int dim = 0; dim <= f.top_dim(); ++dim) {
    f.for_each_cell(dim, [&](const auto& c) { change[f.value(c)] += dim % 2 == 0 ? 1 : -1; });
  }
  for (const Pair& p : pairs) {
    const long sign = p.bar.dim % 2 == 0 ? 1 : -1;
    change[p.bar.birth] -= sign;
    if (!p.death_cell.empty()) change[p.bar.death] += sign;
  }
  for (const auto& [value, difference] : change)
    ASSERT_EQ(difference, 0) << "Euler characteristic at " << value;
}

/// Compares every registered engine with the oracle, pair by pair, including pairs of length 0.
template <Filtration F>
void check_engines(const F& f, int max_dim, std::int64_t field) {
  const auto oracle = pairs_of(f, max_dim, field, Engine::standard);
  if (max_dim == f.top_dim()) {
    ASSERT_NO_FATAL_FAILURE(check_euler(f, oracle));
  }
  const auto components = pairs_of(f, 0, field, Engine::standard);
  for (const auto& engine : detail::engines<F>()) {
    SCOPED_TRACE(engine.id.name());
    if (engine.can_run(f, Task{.max_dim = max_dim, .zero_length = true})) {
      EXPECT_EQ(pairs_of(f, max_dim, field, engine.id), oracle);
    }
    // If only some of the pairs are requested, an engine may use another method.
    if (engine.can_run(f, Task{.max_dim = max_dim})) {
      Options options{.max_dim = max_dim, .field = field, .engine = engine.id};
      const Barcode barcode = persistence(f, options);
      EXPECT_EQ(pairs_of(barcode), of_positive_length(oracle));
      options.cells = false;
      const Barcode without_cells = persistence(f, options);
      EXPECT_TRUE(std::ranges::equal(without_cells, barcode));
      EXPECT_TRUE(without_cells.empty() || without_cells.birth_cell(0).numbers.empty());
    }
    if (engine.can_run(f, Task{.zero_length = true})) {
      EXPECT_EQ(pairs_of(f, 0, field, engine.id), components);
    }
  }
}

/// Runs the suite on one filtration: checks its contract, and every engine over each field.
template <Filtration F>
void check(const F& f, int max_dim, std::initializer_list<std::int64_t> fields = {2, 3, 5}) {
  max_dim = std::min(max_dim, std::max(0, f.top_dim()));
  for (const std::int64_t field : fields) {
    SCOPED_TRACE("field " + std::to_string(field));
    ASSERT_NO_FATAL_FAILURE(check_contract(f, max_dim + 1, field));
    if constexpr (ApparentFiltration<F>) {
      ASSERT_NO_FATAL_FAILURE(check_apparent_pairs(f, max_dim + 1));
    }
    ASSERT_NO_FATAL_FAILURE(check_engines(f, max_dim, field));
  }
}

/// Checks that the edge collapse keeps the bars of positive length.
inline void check_collapse(const Rips& rips, int max_dim, std::int64_t field) {
  const auto bars = [&](const Rips& of, Engine engine, Collapse collapse) {
    return persistence(
        of, {.max_dim = max_dim, .field = field, .engine = engine, .collapse = collapse});
  };
  const Rips all = without_merging(rips);
  const Barcode oracle = bars(all, Engine::standard, Collapse::off);
  EXPECT_EQ(first_difference(oracle, bars(all, Engine::cohomology, Collapse::on)), "");
  if (rips.has_form(RipsForm::distinct_edges)) {
    EXPECT_EQ(first_difference(oracle, bars(rips, Engine::cohomology, Collapse::on)), "");
  }
}

/// Checks that the planned form gives the same pairs as the form with all edges, cell by cell.
inline void check_forms(const Rips& rips, int max_dim, std::int64_t field) {
  const auto oracle = [&](int dim) {
    return with_all_edges(rips, dim,
                          [&](const auto& f) { return pairs_of(f, dim, field, Engine::standard); });
  };
  const auto planned = [&](int dim, double min_persistence) {
    return pairs_of(persistence(rips, {.max_dim = dim,
                                       .field = field,
                                       .collapse = Collapse::off,
                                       .min_persistence = min_persistence}));
  };
  const auto components = oracle(0), all = oracle(max_dim);
  EXPECT_EQ(planned(0, -1), components);
  EXPECT_EQ(planned(0, 0), of_positive_length(components));
  EXPECT_EQ(planned(max_dim, -1), all);
  EXPECT_EQ(planned(max_dim, 0), of_positive_length(all));
}

inline void check(const Rips& rips, int max_dim,
                  std::initializer_list<std::int64_t> fields = {2, 3, 5}) {
  with_all_edges(rips, max_dim, [&](const auto& f) { check(f, max_dim, fields); });
  for (const std::int64_t field : fields) {
    check_forms(rips, max_dim, field);
    check_collapse(rips, max_dim, field);
  }
}

/// Compares every engine that uses only the points with the oracle, which uses all cells.
inline void check_points_alone(PointsView points, std::int64_t field) {
  const Rips rips(points);
  const auto oracle = with_all_edges(rips, 1, [&](const auto& f) {
    return of_positive_length(pairs_of(f, 1, field, Engine::standard));
  });
  with_rips_filtration(rips.graph(RipsForm::points), 1, [&]<class F>(const F& f) {
    for (const auto& engine : detail::engines<F>()) {
      if (!engine.can_run(f, Task{.max_dim = 1})) continue;
      SCOPED_TRACE(engine.id.name());
      const Options task{.max_dim = 1, .field = field, .engine = engine.id};
      EXPECT_EQ(plan(rips, task).form, RipsForm::points);
      EXPECT_EQ(pairs_of(persistence(rips, task)), oracle);
      EXPECT_EQ(pairs_of(persistence(f, task)), oracle);
    }
  });
}

}  // namespace ph::test
