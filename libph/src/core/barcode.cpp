// SPDX-License-Identifier: MIT
#include "ph/core/barcode.hpp"

#include <algorithm>
#include <numeric>
#include <string>

#include "ph/core/error.hpp"

namespace ph {

Barcode::Range Barcode::store(std::span<const Index> numbers) {
  const std::size_t begin = numbers_.size();
  numbers_.insert(numbers_.end(), numbers.begin(), numbers.end());
  return {begin, numbers_.size()};
}

void Barcode::add(const Bar& bar, std::span<const Index> birth_cell,
                  std::span<const Index> death_cell) {
  bars_.push_back(bar);
  const Range birth = store(birth_cell);
  cells_.push_back({birth, store(death_cell), {}, {}});
}

void Barcode::set_representative(Representatives kind, std::span<const Index> numbers,
                                 std::span<const std::int64_t> coefficients) {
  representatives_ = kind;
  cells_.back().chain = store(numbers);
  cells_.back().coefficients.begin = coefficients_.size();
  coefficients_.insert(coefficients_.end(), coefficients.begin(), coefficients.end());
  cells_.back().coefficients.end = coefficients_.size();
}

InputChain Barcode::representative(std::size_t i) const {
  if (representatives_ == Representatives::none)
    throw Error(ErrorKind::usage, "the barcode was computed without representatives");
  const auto [begin, end] = cells_[i].coefficients;
  return {kind_, numbers_of(cells_[i].chain), std::span(coefficients_).subspan(begin, end - begin)};
}

void Barcode::sort() {
  std::vector<std::size_t> order(bars_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  // Stable: bars without cells keep their order when they are written and read again.
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const Bar &x = bars_[a], &y = bars_[b];
    if (x.dim != y.dim) return x.dim < y.dim;
    if (x.birth != y.birth) return x.birth < y.birth;
    if (x.death != y.death) return x.death < y.death;
    return std::ranges::lexicographical_compare(numbers_of(cells_[a].birth),
                                                numbers_of(cells_[b].birth));
  });
  std::vector<Bar> bars(bars_.size());
  std::vector<Cells> cells(cells_.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    bars[i] = bars_[order[i]];
    cells[i] = cells_[order[i]];
  }
  bars_ = std::move(bars);
  cells_ = std::move(cells);
}

std::span<const Bar> Barcode::bars(int dim) const {
  const auto [first, last] =
      std::equal_range(bars_.begin(), bars_.end(), Bar{dim, 0, 0},
                       [](const Bar& a, const Bar& b) { return a.dim < b.dim; });
  return {first, last};
}

std::size_t Barcode::longest(int dim) const {
  const auto all = bars(dim);
  if (all.empty()) {
    throw Error(ErrorKind::usage, "the barcode has no bar of dimension " + std::to_string(dim));
  }
  const auto it = std::max_element(all.begin(), all.end(), [](const Bar& a, const Bar& b) {
    // A bar from -infinity is as long as one that never dies, which comes first all the same.
    if (a.is_infinite() != b.is_infinite()) return b.is_infinite();
    return a.persistence() < b.persistence();
  });
  return static_cast<std::size_t>(&*it - bars_.data());
}

}  // namespace ph
