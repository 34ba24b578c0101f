// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <map>
#include <memory_resource>
#include <vector>

#include "ph/detail/core/barcode_builder.hpp"
#include "ph/detail/core/engine.hpp"
#include "ph/detail/core/field.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// THE ORACLE. Persistent homology as in the textbook (Edelsbrunner & Harer, Computational
/// Topology, chapter VII.1; over a field: Zomorodian & Carlsson, Computing Persistent Homology):
/// write down the boundary matrix, reduce its columns from left to right, and read off the pairs.
/// This engine shares no code with the other engines and is never optimised; the others are right
/// if they agree with it.
struct StandardEngine {
  static constexpr Engine id = Engine::standard;
  template <Filtration F>
  static bool can_run(const F&, const Task& task) {
    return task.representatives == Representatives::none;
  }
  template <Filtration F>
  static Suitability suitability(const F&, const Task&) {
    return {};
  }
  static constexpr int listed_dim(int max_dim) { return max_dim + 1; }
  static constexpr bool is_oracle = true;

  template <Filtration F, Field K>
  static void run(const F& f, const K& field, BarcodeBuilder<F>& bars, const RunContext& context) {
    using Cell = typename F::Cell;
    using Column = std::pmr::map<std::size_t, typename K::Element>;  // row -> non-zero coefficient
    std::pmr::memory_resource* const memory = &context.memory;
    prepare_cells(f, context);
    Ticker ticker(context, "oracle");
    const auto precedes = [&](const Cell& a, const Cell& b) {
      ticker.work();
      return f.precedes(a, b);
    };

    const int top = std::min(bars.max_dim() + 1, f.top_dim());
    std::pmr::vector<Cell> rows(memory);  // the cells of dimension dim - 1, oldest first
    // For each row: true if the column of the same cell was reduced to zero.
    std::pmr::vector<bool> is_positive(memory);
    for (int dim = 0; dim <= top; ++dim) {
      std::pmr::vector<Cell> columns(memory);
      f.for_each_cell(dim, [&](const Cell& c) {
        columns.push_back(c);
        ticker.work();
      });
      std::sort(columns.begin(), columns.end(), precedes);
      std::pmr::map<std::size_t, Column> reduced(memory);  // R: columns by lowest row
      std::pmr::map<std::size_t, std::size_t> killer(memory);
      std::pmr::vector<bool> next_is_positive(columns.size(), false, memory);

      for (std::size_t j = 0; j < columns.size(); ++j) {
        Column column(memory);
        const auto add = [&](std::size_t row, typename K::Element a) {
          auto [it, is_new] = column.try_emplace(row, a);
          if (!is_new) it->second = field.add(it->second, a);
          if (field.is_zero(it->second)) column.erase(it);
        };
        f.for_each_facet(dim, columns[j], [&](const Cell& facet, int incidence) {
          const auto it = std::lower_bound(rows.begin(), rows.end(), facet, precedes);
          add(static_cast<std::size_t>(it - rows.begin()), field.from_int(incidence));
        });
        // low(j): the youngest row. While an earlier column has the same lowest row, subtract that
        // column.
        while (!column.empty() && reduced.contains(column.rbegin()->first)) {
          const Column& earlier = reduced.at(column.rbegin()->first);
          const auto factor = field.negate(
              field.multiply(column.rbegin()->second, field.inverse(earlier.rbegin()->second)));
          for (const auto& [row, a] : earlier) add(row, field.multiply(factor, a));
          ticker.work();
        }
        ticker.tick();
        if (column.empty()) {
          next_is_positive[j] = true;  // gives birth to a class of dimension `dim`
        } else {
          const std::size_t low = column.rbegin()->first;
          killer[low] = j;
          reduced[low] = std::move(column);
        }
      }
      for (std::size_t i = 0; i < rows.size(); ++i) {
        if (!is_positive[i]) continue;
        const auto it = killer.find(i);
        if (it == killer.end())
          bars.add_essential(dim - 1, rows[i]);
        else
          bars.add_pair(dim - 1, rows[i], columns[it->second]);
      }
      rows = std::move(columns);
      is_positive = std::move(next_is_positive);
    }
    if (top <= bars.max_dim())  // no cell kills a class of the top dimension
      for (std::size_t i = 0; i < rows.size(); ++i)
        if (is_positive[i]) bars.add_essential(top, rows[i]);
  }
};

}  // namespace ph
