// SPDX-License-Identifier: MIT
// An engine defined by a user: it reduces the boundary matrix from left to right, with columns
// stored as sorted vectors. The engine needs only this file. Every program that links the file has
// the engine.
#include <algorithm>
#include <ph/custom.hpp>
#include <unordered_map>

namespace {

struct ColumnEngine {
  static constexpr ph::Engine id{"column"};
  template <ph::Filtration F>
  static bool can_run(const F&, const ph::Task& task) {
    return task.representatives == ph::Representatives::none;
  }
  template <ph::Filtration F>
  static ph::Suitability suitability(const F&, const ph::Task&) {
    return {};  // selected only if named explicitly
  }
  static constexpr int listed_dim(int max_dim) { return max_dim + 1; }

  template <ph::Filtration F, ph::Field K>
  static void run(const F& f, const K& field, ph::BarcodeBuilder<F>& bars,
                  const ph::RunContext& context) {
    using Cell = typename F::Cell;
    // Rows in ascending order.
    using Column = std::vector<std::pair<std::size_t, typename K::Element>>;
    const auto precedes = [&](const Cell& a, const Cell& b) { return f.precedes(a, b); };
    ph::prepare_cells(f, context);
    ph::Ticker ticker(context, "columns");
    std::vector<Cell> rows, columns;
    std::vector<bool> row_is_cycle, is_cycle;
    for (int dim = 0; dim <= std::min(bars.max_dim() + 1, f.top_dim()); ++dim) {
      columns.clear();
      f.for_each_cell(dim, [&](const Cell& c) { columns.push_back(c); });
      std::sort(columns.begin(), columns.end(), precedes);
      is_cycle.assign(columns.size(), false);
      std::unordered_map<std::size_t, Column> reduced;  // the key is the lowest row of the column
      for (std::size_t j = 0; j < columns.size(); ++j) {
        ticker.tick();
        Column column;
        f.for_each_facet(dim, columns[j], [&](const Cell& facet, int incidence) {
          const auto row = std::lower_bound(rows.begin(), rows.end(), facet, precedes);
          column.emplace_back(row - rows.begin(), field.from_int(incidence));
        });
        std::sort(column.begin(), column.end());
        std::erase_if(column, [&](const auto& entry) { return field.is_zero(entry.second); });
        while (!column.empty() && reduced.contains(column.back().first)) {
          const Column& other = reduced.at(column.back().first);
          column = sum(column,
                       field.negate(field.multiply(column.back().second,
                                                   field.inverse(other.back().second))),
                       other, field);
        }
        is_cycle[j] = column.empty();
        if (column.empty()) continue;
        const std::size_t low = column.back().first;
        row_is_cycle[low] = false;
        bars.add_pair(dim - 1, rows[low], columns[j]);
        reduced.emplace(low, std::move(column));
      }
      if (dim > 0) add_essential(dim - 1, rows, row_is_cycle, bars);
      rows = columns;
      row_is_cycle = is_cycle;
    }
    const int top = f.top_dim();
    if (top >= 0 && top <= bars.max_dim()) add_essential(top, rows, row_is_cycle, bars);
  }

 private:
  /// The sum a + scale * b.
  template <class Column, ph::Field K>
  static Column sum(const Column& a, typename K::Element scale, const Column& b, const K& field) {
    Column result;
    auto x = a.begin();
    auto y = b.begin();
    while (x != a.end() || y != b.end()) {
      if (y == b.end() || (x != a.end() && x->first < y->first)) {
        result.push_back(*x++);
        continue;
      }
      auto value = field.multiply(scale, y->second);
      if (x != a.end() && x->first == y->first) value = field.add(value, (x++)->second);
      if (!field.is_zero(value)) result.emplace_back(y->first, value);
      ++y;
    }
    return result;
  }
  template <class F>
  static void add_essential(int dim, const std::vector<typename F::Cell>& cells,
                            const std::vector<bool>& is_cycle, ph::BarcodeBuilder<F>& bars) {
    for (std::size_t i = 0; i < cells.size(); ++i)
      if (is_cycle[i]) bars.add_essential(dim, cells[i]);
  }
};

const bool kIsAdded = (ph::add_engine<ColumnEngine>(), true);

}  // namespace
