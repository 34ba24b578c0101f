// SPDX-License-Identifier: MIT
#include "ph/barcode.hpp"

#include <algorithm>
#include <functional>
#include <memory_resource>
#include <string>
#include <tuple>
#include <utility>

#include "ph/detail/core/on_first_use.hpp"
#include "ph/detail/core/polled_sort.hpp"
#include "ph/detail/core/radix_sort.hpp"
#include "ph/error.hpp"

namespace ph {
namespace {

/// Calls `use(run)` for each maximal run of bars with equal values.
template <class Value, class Use>
void for_each_run(std::span<Bar> bars, Value value, Use&& use) {
  while (!bars.empty()) {
    const auto end = std::ranges::find_if(
        bars, [&](const auto& x) { return x != std::invoke(value, bars.front()); }, value);
    const auto size = static_cast<std::size_t>(end - bars.begin());
    use(bars.first(size));
    bars = bars.subspan(size);
  }
}

}  // namespace

Barcode::Range Barcode::store(std::span<const Index> numbers) {
  const std::size_t begin = numbers_.size();
  numbers_.insert(numbers_.end(), numbers.begin(), numbers.end());
  return {begin, numbers_.size()};
}

void Barcode::add(const Bar& bar, std::span<const Index> birth_cell,
                  std::span<const Index> death_cell) {
  const bool has_cells = !birth_cell.empty() || !death_cell.empty();
  if (has_cells) cells_.resize(bars_.size());
  bars_.push_back(bar);
  if (!has_cells && cells_.empty()) return;
  const Range birth = store(birth_cell), death = store(death_cell);
  cells_.push_back({birth.begin, death.begin, death.end, kNone});
}

void Barcode::set_representative(Representatives kind, std::span<const Index> numbers,
                                 std::span<const std::int64_t> coefficients) {
  representatives_ = kind;
  const Range cells = store(numbers);
  const std::size_t begin = coefficients_.size();
  coefficients_.insert(coefficients_.end(), coefficients.begin(), coefficients.end());
  cells_.resize(bars_.size());
  cells_.back().chain = chains_.size();
  chains_.push_back({cells, {begin, coefficients_.size()}});
}

const BarcodeInfo& Barcode::info() const {
  static constinit detail::OnFirstUse unknown([] { return BarcodeInfo(); });
  return info_ ? *info_ : *unknown;
}

std::size_t Barcode::store_voxels(std::span<const std::uint32_t> places) {
  const std::size_t begin = voxels_.size();
  voxels_.insert(voxels_.end(), places.begin(), places.end());
  return begin;
}

void Barcode::set_voxels(VoxelRange voxels, std::span<const Index> birth_voxel,
                         std::span<const Index> death_voxel) {
  const Range birth = store(birth_voxel), death = store(death_voxel);
  sets_.resize(chains_.size());
  sets_.back() = {voxels, birth, death};
}

std::span<const std::uint32_t> Barcode::voxels(std::size_t i) const {
  const auto [begin, end] = part_of(i, sets_).voxels;
  return std::span(voxels_).subspan(begin, end - begin);
}

std::span<const Index> Barcode::birth_voxel(std::size_t i) const {
  return numbers_of(part_of(i, sets_).birth);
}

std::span<const Index> Barcode::death_voxel(std::size_t i) const {
  return numbers_of(part_of(i, sets_).death);
}

InputChain Barcode::representative(std::size_t i) const {
  if (representatives_ == Representatives::none)
    throw Error(ErrorKind::usage, "the barcode was computed without representatives");
  const Chain chain = part_of(i, chains_);
  const auto [begin, end] = chain.coefficients;
  return {kind_, numbers_of(chain.numbers), std::span(coefficients_).subspan(begin, end - begin)};
}

// Without cells, equal bars are interchangeable. Each run of equal births can therefore be sorted
// by death in place.
void Barcode::sort_values(const RunContext& context) {
  std::pmr::vector<Bar> buffer(&context.memory);  // the buffer allocates memory only if it is used
  const auto sort_by = [&](std::span<Bar> bars, auto&& value_of) {
    if (std::ranges::is_sorted(bars, {}, value_of)) return;
    // The bars of the highest dimension of an image arrive in descending order.
    if (std::ranges::is_sorted(bars, std::ranges::greater(), value_of)) {
      std::ranges::reverse(bars);
      return;
    }
    buffer.resize(std::max(buffer.size(), bars.size()));
    const auto sorted =
        radix_sort_by_value(bars, std::span(buffer).first(bars.size()), value_of, context);
    if (sorted.data() != bars.data()) std::ranges::copy(sorted, bars.begin());
  };
  Ticker ticker(context, "bars", bars_.size());
  sort_by(bars_, [](const Bar& bar) { return bar.dim; });
  for_each_run(std::span(bars_), &Bar::dim, [&](std::span<Bar> of_dim) {
    // The sum turns -0.0 into +0.0.
    // mutant: barcode-order
    sort_by(of_dim, [](const Bar& bar) { return bar.birth + 0.0; });
    for_each_run(of_dim, &Bar::birth, [&](std::span<Bar> born_together) {
      ticker.tick();
      constexpr std::size_t many = 1024;
      if (born_together.size() > many)
        sort_by(born_together, [](const Bar& bar) { return bar.death + 0.0; });
      else if (born_together.size() > 1)
        polled_sort(
            born_together, [](const Bar& a, const Bar& b) { return a.death < b.death; }, ticker);
    });
  });
}

void Barcode::sort(const RunContext& context) {
  // Union-find reports the deaths of vertices with equal births in ascending order.
  const bool are_sorted = std::ranges::is_sorted(bars_, [](const Bar& a, const Bar& b) {
    return std::tie(a.dim, a.birth, a.death) < std::tie(b.dim, b.birth, b.death);
  });
  if (cells_.empty()) {
    if (!are_sorted) sort_values(context);
    return;
  }
  // This is a radix sort by death, then by birth, then by dimension. Each pass keeps the order that
  // the previous pass produced, and -0.0 becomes +0.0.
  struct Place {
    double value;
    std::size_t bar;
  };
  const MemoryClaim copies(context.memory,
                           bars_.size() * (sizeof(Place) + sizeof(Bar) + sizeof(Cells)));
  std::vector<Place> order(bars_.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = {bars_[i].death + 0.0, i};
  if (!are_sorted) {
    const auto value_of = [](const Place& place) { return place.value; };
    radix_sort_by_value(order, value_of, context);
    for (Place& place : order) place.value = bars_[place.bar].birth + 0.0;
    radix_sort_by_value(order, value_of, context);
    for (Place& place : order) place.value = bars_[place.bar].dim;
    radix_sort_by_value(order, value_of, context);
  }
  // The sort is stable. Bars without cells therefore keep their order when they are written and
  // read again.
  for (std::size_t begin = 0, end; begin < order.size(); begin = end) {
    const Bar& bar = bars_[order[begin].bar];
    for (end = begin + 1; end < order.size() && bars_[order[end].bar] == bar;) ++end;
    if (end - begin < 2) continue;
    std::stable_sort(
        order.begin() + static_cast<std::ptrdiff_t>(begin),
        order.begin() + static_cast<std::ptrdiff_t>(end), [&](const Place& a, const Place& b) {
          return std::ranges::lexicographical_compare(birth_numbers(a.bar), birth_numbers(b.bar));
        });
  }
  std::vector<Bar> bars(bars_.size());
  std::vector<Cells> cells(cells_.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    bars[i] = bars_[order[i].bar];
    cells[i] = cells_[order[i].bar];
  }
  bars_ = std::move(bars);
  cells_ = std::move(cells);
}

std::span<const Bar> Barcode::bars(int dim) const& {
  const auto [first, last] =
      std::equal_range(bars_.begin(), bars_.end(), Bar{dim, 0, 0},
                       [](const Bar& a, const Bar& b) { return a.dim < b.dim; });
  return {first, last};
}

std::vector<Bar> Barcode::bars(int dim) && {
  const std::span<const Bar> kept = std::as_const(*this).bars(dim);
  return {kept.begin(), kept.end()};
}

std::size_t Barcode::longest(int dim) const {
  const auto all = bars(dim);
  if (all.empty()) {
    throw Error(ErrorKind::usage, "the barcode has no bar of dimension " + std::to_string(dim));
  }
  const auto it = std::max_element(all.begin(), all.end(), [](const Bar& a, const Bar& b) {
    // A bar that is born at -infinity is as long as a bar that never dies. The bar that never dies
    // comes first.
    if (a.is_infinite() != b.is_infinite()) return b.is_infinite();
    return a.persistence() < b.persistence();
  });
  return static_cast<std::size_t>(&*it - bars_.data());
}

}  // namespace ph
