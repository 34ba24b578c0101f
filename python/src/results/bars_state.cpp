// SPDX-License-Identifier: MIT
#include "python/src/results/bars_state.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <span>
#include <string>
#include <utility>

#include "ph/error.hpp"
#include "python/src/calls/bindings.hpp"
#include "python/src/data/arrays.hpp"

namespace ph::python {
namespace {

[[noreturn]] void fail() {
  throw Error(ErrorKind::bad_data, "state of a barcode: found damaged arrays");
}

/// Lists of numbers, one after another.
class Lists {
 public:
  Lists() = default;
  Lists(std::vector<std::int64_t> numbers, std::vector<std::int64_t> ends)
      : numbers_(std::move(numbers)), ends_(std::move(ends)) {
    std::int64_t last = 0;
    for (const std::int64_t end : ends_) {
      if (end < last) fail();
      last = end;
    }
    if (last != static_cast<std::int64_t>(numbers_.size())) fail();
  }

  void add(std::span<const std::int64_t> list) {
    numbers_.insert(numbers_.end(), list.begin(), list.end());
    ends_.push_back(static_cast<std::int64_t>(numbers_.size()));
  }
  std::size_t size() const { return ends_.size(); }
  std::span<const std::int64_t> operator[](std::size_t i) const {
    if (i >= ends_.size()) fail();
    const auto begin = i == 0 ? 0 : static_cast<std::size_t>(ends_[i - 1]);
    return std::span(numbers_).subspan(begin, static_cast<std::size_t>(ends_[i]) - begin);
  }

  void put(py::dict& state, const char* name) const {
    state[name] = py::make_tuple(Block::of(std::vector(numbers_)), Block::of(std::vector(ends_)));
  }
  static Lists of(const py::dict& state, const char* name) {
    const auto [numbers, ends] = state[name].cast<std::pair<py::buffer, py::buffer>>();
    return {vector_of<std::int64_t>(numbers), vector_of<std::int64_t>(ends)};
  }

 private:
  std::vector<std::int64_t> numbers_, ends_;
};

/// The data of a bar in addition to its values.
struct Parts {
  std::span<const Index> birth_cell, death_cell;
  std::span<const Index> chain;  // the numbers of its cells, one after another
  std::vector<std::int64_t> coefficients;
  VoxelRange voxels;
  std::span<const Index> birth_voxel, death_voxel;
};

/// @param voxels all sets that the barcode keeps alive.
Parts parts_of(const Barcode& bars, std::size_t i, std::span<const std::uint32_t> voxels) {
  Parts parts;
  parts.birth_cell = bars.birth_cell(i).numbers;
  if (const auto cell = bars.death_cell(i)) parts.death_cell = cell->numbers;
  if (bars.representatives() == Representatives::none) return parts;
  const InputChain chain = bars.representative(i);
  if (chain.size() > 0) {
    const std::span<const Index> first = chain.cell(0).numbers;
    parts.chain = {first.data(), first.size() * chain.size()};
  }
  for (std::size_t k = 0; k < chain.size(); ++k) parts.coefficients.push_back(chain.coefficient(k));
  if (const std::span<const std::uint32_t> set = bars.voxels(i); !set.empty()) {
    const auto begin = static_cast<std::size_t>(set.data() - voxels.data());
    parts.voxels = {begin, begin + set.size()};
  }
  parts.birth_voxel = bars.birth_voxel(i);
  parts.death_voxel = bars.death_voxel(i);
  return parts;
}

void append(Barcode& bars, const Bar& bar, const Parts& parts, Representatives kind) {
  bars.add(bar, parts.birth_cell, parts.death_cell);
  if (kind == Representatives::none) return;
  bars.set_representative(kind, parts.chain, parts.coefficients);
  if (kind == Representatives::voxels)
    bars.set_voxels(parts.voxels, parts.birth_voxel, parts.death_voxel);
}

/// The array that contains the sets of voxels of all bars.
std::span<const std::uint32_t> all_voxels(const Barcode& bars) {
  const std::less<const std::uint32_t*> is_before;
  const std::uint32_t *begin = nullptr, *end = nullptr;
  for (std::size_t i = 0; i < bars.size(); ++i) {
    const std::span<const std::uint32_t> set = bars.voxels(i);
    if (set.empty()) continue;
    if (begin == nullptr || is_before(set.data(), begin)) begin = set.data();
    if (end == nullptr || is_before(end, set.data() + set.size())) end = set.data() + set.size();
  }
  return {begin, end};
}

/// Loops as lists of numbers.
struct LoopLists {
  Lists vertices;                       // the vertices of each loop
  Lists facts;                          // for each loop, its bar and its coefficient
  std::vector<double> lengths;          // NaN if the length is unknown
  std::vector<std::int64_t> tightness;  // for each bar

  explicit LoopLists(const std::vector<BarLoops>& all) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      tightness.push_back(static_cast<std::int64_t>(all[i].tightness));
      for (const Loop& loop : all[i].loops) {
        vertices.add(loop.numbers);
        facts.add(std::array{static_cast<std::int64_t>(i), loop.coefficient});
        lengths.push_back(loop.length.value_or(std::nan("")));
      }
    }
  }
  explicit LoopLists(const py::dict& state)
      : vertices(Lists::of(state, "loop_vertices")),
        facts(Lists::of(state, "loop_facts")),
        lengths(vector_of<double>(state["loop_lengths"])),
        tightness(vector_of<std::int64_t>(state["loop_tightness"])) {}

  void put(py::dict& state) const {
    vertices.put(state, "loop_vertices");
    facts.put(state, "loop_facts");
    state["loop_lengths"] = Block::of(std::vector(lengths));
    state["loop_tightness"] = Block::of(std::vector(tightness));
  }
  std::vector<BarLoops> loops() const {
    std::vector<BarLoops> all(tightness.size());
    for (std::size_t i = 0; i < all.size(); ++i)
      all[i].tightness = static_cast<Tightness>(std::clamp<std::int64_t>(tightness[i], 0, 2));
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      const std::span<const std::int64_t> fact = facts[k];
      if (fact.size() != 2 || fact[0] < 0 || static_cast<std::size_t>(fact[0]) >= all.size() ||
          k >= lengths.size())
        fail();
      Loop loop{{vertices[k].begin(), vertices[k].end()}, fact[1]};
      if (!std::isnan(lengths[k])) loop.length = lengths[k];
      all[static_cast<std::size_t>(fact[0])].loops.push_back(std::move(loop));
    }
    return all;
  }
};

/// A member of a pickled state that names one of several choices.
template <class Enum>
Enum choice_of(const py::dict& state, const char* name, Enum last) {
  const auto value = state[name].cast<int>();
  if (value < 0 || value > static_cast<int>(last)) fail();
  return static_cast<Enum>(value);
}

}  // namespace

Bars selected(const Bars& bars, const std::vector<std::int64_t>& places) {
  const Barcode& all = bars.barcode;
  const std::span<const std::uint32_t> voxels = all_voxels(all);
  Bars chosen{Barcode(all.cell_kind()), {}, bars.field};
  chosen.barcode.set_info(all.info());
  const Index axes = bars.centroids.cols();
  chosen.centroids = Points(axes > 0 ? std::ssize(places) : 0, axes);
  Index row = 0;
  chosen.barcode.store_voxels(voxels);
  for (const std::int64_t place : places) {
    if (place < 0 || static_cast<std::size_t>(place) >= all.size())
      throw Error(ErrorKind::usage, "places of bars: found an index out of range");
    const auto i = static_cast<std::size_t>(place);
    append(chosen.barcode, all[i], parts_of(all, i, voxels), all.representatives());
    if (!bars.loops.empty()) chosen.loops.push_back(bars.loops[i]);
    if (!bars.p_values.empty()) chosen.p_values.push_back(bars.p_values[i]);
    std::copy_n(bars.centroids.data() + place * axes, axes, chosen.centroids.data() + row++ * axes);
  }
  return chosen;
}

py::dict state_of(const Bars& bars) {
  const Barcode& all = bars.barcode;
  const std::span<const std::uint32_t> voxels = all_voxels(all);
  std::vector<std::int64_t> dims;
  std::vector<double> births, deaths;
  Lists birth_cells, death_cells, chains, coefficients, sets, birth_voxels, death_voxels;
  for (std::size_t i = 0; i < all.size(); ++i) {
    dims.push_back(all[i].dim);
    births.push_back(all[i].birth);
    deaths.push_back(all[i].death);
    const Parts parts = parts_of(all, i, voxels);
    birth_cells.add(parts.birth_cell);
    death_cells.add(parts.death_cell);
    chains.add(parts.chain);
    coefficients.add(parts.coefficients);
    sets.add(std::array{static_cast<std::int64_t>(parts.voxels.begin),
                        static_cast<std::int64_t>(parts.voxels.end)});
    birth_voxels.add(parts.birth_voxel);
    death_voxels.add(parts.death_voxel);
  }
  py::dict state;
  state["field"] = bars.field;
  state["cell_kind"] = static_cast<int>(all.cell_kind());
  state["representatives"] = static_cast<int>(all.representatives());
  state["dims"] = Block::of(std::move(dims));
  state["births"] = Block::of(std::move(births));
  state["deaths"] = Block::of(std::move(deaths));
  birth_cells.put(state, "birth_cells");
  death_cells.put(state, "death_cells");
  chains.put(state, "chains");
  coefficients.put(state, "coefficients");
  sets.put(state, "sets");
  birth_voxels.put(state, "birth_voxels");
  death_voxels.put(state, "death_voxels");
  state["voxels"] = Block::copy_of(voxels);
  LoopLists(bars.loops).put(state);
  state["p_values"] = Block::of(std::vector(bars.p_values));
  const Points& centroids = bars.centroids;
  state["centroids"] =
      Block::copy_of(std::span(centroids.data(), static_cast<std::size_t>(centroids.size())));
  return state;
}

Bars bars_of_state(const py::dict& state) {
  const auto dims = vector_of<std::int64_t>(state["dims"]);
  const auto births = vector_of<double>(state["births"]),
             deaths = vector_of<double>(state["deaths"]);
  const auto voxels = vector_of<std::uint32_t>(state["voxels"]);
  const Lists birth_cells = Lists::of(state, "birth_cells"),
              death_cells = Lists::of(state, "death_cells"), chains = Lists::of(state, "chains"),
              coefficients = Lists::of(state, "coefficients"), sets = Lists::of(state, "sets"),
              birth_voxels = Lists::of(state, "birth_voxels"),
              death_voxels = Lists::of(state, "death_voxels");
  const auto kind = choice_of(state, "representatives", Representatives::voxels);
  if (births.size() != dims.size() || deaths.size() != dims.size()) fail();

  Bars bars{Barcode(choice_of(state, "cell_kind", CellKind::row))};
  bars.field = state["field"].cast<std::int64_t>();
  bars.barcode.store_voxels(voxels);
  for (std::size_t i = 0; i < dims.size(); ++i) {
    const std::span<const std::int64_t> set = sets[i], weights = coefficients[i];
    if (set.size() != 2 || set[0] < 0 || set[1] < set[0] ||
        static_cast<std::size_t>(set[1]) > voxels.size() ||
        (weights.empty() ? !chains[i].empty() : chains[i].size() % weights.size() != 0))
      fail();
    const Parts parts{birth_cells[i],
                      death_cells[i],
                      chains[i],
                      {weights.begin(), weights.end()},
                      {static_cast<std::size_t>(set[0]), static_cast<std::size_t>(set[1])},
                      birth_voxels[i],
                      death_voxels[i]};
    append(bars.barcode, {static_cast<int>(dims[i]), births[i], deaths[i]}, parts, kind);
  }
  bars.loops = LoopLists(state).loops();
  bars.p_values = vector_of<double>(state["p_values"]);
  const auto centroids = vector_of<double>(state["centroids"]);
  const std::size_t axes = dims.empty() ? 0 : centroids.size() / dims.size();
  if (centroids.size() != axes * dims.size()) fail();
  if (axes > 0)
    bars.centroids =
        Points(PointsView(centroids.data(), std::ssize(dims), static_cast<Index>(axes)));
  for (const std::size_t known : {bars.loops.size(), bars.p_values.size()})
    if (known != 0 && known != bars.barcode.size()) fail();
  return bars;
}

}  // namespace ph::python
