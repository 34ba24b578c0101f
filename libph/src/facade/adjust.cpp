// SPDX-License-Identifier: MIT
#include "ph/detail/facade/adjust.hpp"

#include <fmt/format.h>

#include <functional>
#include <set>

#include "ph/explicit.hpp"

namespace ph {
namespace {

using Numbers = std::vector<Index>;
using KeepCell = std::function<bool(const Numbers&)>;
using RenameCell = std::function<void(Numbers&)>;

Numbers numbers_of(const InputCell& cell) { return {cell.numbers.begin(), cell.numbers.end()}; }

/// Copies the representative of bar i of `from` to the bar that was added to `to` last. Leaves out
/// the cells that `keep` rejects, and renames the other cells.
void copy_representative(const Barcode& from, std::size_t i, Barcode& to, const KeepCell& keep,
                         const RenameCell& rename) {
  if (from.representatives() == Representatives::none) return;
  const InputChain chain = from.representative(i);
  Numbers numbers;
  std::vector<std::int64_t> coefficients;
  for (std::size_t k = 0; k < chain.size(); ++k) {
    Numbers cell = numbers_of(chain.cell(k));
    if (!keep(cell)) continue;
    rename(cell);
    numbers.insert(numbers.end(), cell.begin(), cell.end());
    coefficients.push_back(chain.coefficient(k));
  }
  to.set_representative(from.representatives(), numbers, coefficients);
}

/// The cells with a value above the threshold, each given by its numbers in the input.
std::set<Numbers> cells_beyond(const ExplicitComplex& complex, double threshold) {
  std::set<Numbers> beyond;
  for (int dim = 0; dim <= complex.top_dim(); ++dim)
    complex.for_each_cell(dim, [&](const auto& cell) {
      if (complex.value(cell) <= threshold) return;
      Numbers numbers;
      complex.append_input_cell(dim, cell, numbers);
      beyond.insert(std::move(numbers));
    });
  return beyond;
}

/// @throws Error (usage) unless cells are given by vertices, because grid coordinates and matrix
/// rows are not numbers of points.
void require_vertices(CellKind kind) {
  if (kind != CellKind::vertices)
    throw Error(ErrorKind::usage,
                "ids of points: found cells of a grid or rows of a matrix, expected vertices");
}

Index id_of(Index v, const std::vector<Index>& ids) {
  if (v < 0 || static_cast<std::size_t>(v) >= ids.size())
    throw Error(ErrorKind::usage, fmt::format("ids of points: found vertex {}, expected 0 to {}", v,
                                              static_cast<Index>(ids.size()) - 1));
  return ids[static_cast<std::size_t>(v)];
}

}  // namespace

Barcode with_input_ids(const Barcode& barcode, const std::vector<Index>& ids) {
  require_vertices(barcode.cell_kind());
  const auto rename = [&](Numbers& numbers) {
    for (Index& v : numbers) v = id_of(v, ids);
  };
  const auto named = [&](const InputCell& cell) {
    Numbers numbers = numbers_of(cell);
    rename(numbers);
    return numbers;
  };
  Barcode result(barcode.cell_kind());
  for (std::size_t i = 0; i < barcode.size(); ++i) {
    const auto death = barcode.death_cell(i);
    result.add(barcode[i], named(barcode.birth_cell(i)), death ? named(*death) : Numbers());
    copy_representative(
        barcode, i, result, [](const Numbers&) { return true; }, rename);
  }
  result.sort();
  BarcodeInfo info = barcode.info();
  if (info.alpha) rename(info.alpha->hidden);
  result.set_info(std::move(info));
  return result;
}

void name_points(std::vector<BarLoops>& loops, const std::vector<Index>& ids) {
  for (BarLoops& of_bar : loops)
    for (Loop& loop : of_bar.loops)
      for (Index& v : loop.numbers) v = id_of(v, ids);
}

Points centroids(const Barcode& barcode, PointsView points, const RunContext& context) {
  require_vertices(barcode.cell_kind());
  const auto bars = static_cast<Index>(barcode.size()), axes = points.cols();
  context.memory.require(static_cast<std::size_t>(bars * axes) * sizeof(double));
  Points places(bars, axes);
  for (Index i = 0; i < bars; ++i) {
    const auto bar = static_cast<std::size_t>(i);
    const InputChain chain = barcode.representative(bar);
    double* const place = places.data() + i * axes;
    double numbers = 0;
    for (std::size_t k = 0; k < chain.size() && barcode[bar].dim > 0; ++k)
      for (const Index v : chain.cell(k).numbers) {
        if (v < 0 || v >= points.rows())
          throw Error(ErrorKind::usage, fmt::format("centroids: found vertex {}, expected 0 to {}",
                                                    v, points.rows() - 1));
        for (Index axis = 0; axis < axes; ++axis) place[axis] += points(v, axis);
        ++numbers;
      }
    // All cells of a chain have the same number of vertices. 0 / 0 is NaN.
    for (Index axis = 0; axis < axes; ++axis) place[axis] /= numbers;
  }
  return places;
}

MergeTree with_input_ids(MergeTree tree, std::span<const Index> ids, std::size_t size) {
  std::vector<double> births(size, kInfinity);
  for (std::size_t v = 0; v < ids.size(); ++v)
    births[static_cast<std::size_t>(ids[v])] = tree.births[v];
  tree.births = std::move(births);
  for (Merge& m : tree.merges)
    for (Index* v : {&m.u, &m.v, &m.elder, &m.younger}) *v = ids[static_cast<std::size_t>(*v)];
  return tree;
}

Barcode cut_at(const Barcode& barcode, const ExplicitComplex& complex, double threshold,
               double min_persistence) {
  // A cycle has no cell that enters after its birth, but a cocycle has cells of any age.
  std::set<Numbers> beyond;
  if (barcode.representatives() == Representatives::cocycles)
    beyond = cells_beyond(complex, threshold);
  Barcode result(barcode.cell_kind());
  for (std::size_t i = 0; i < barcode.size(); ++i) {
    Bar bar = barcode[i];
    if (bar.birth > threshold) continue;
    const auto death = barcode.death_cell(i);
    const bool lives = bar.death > threshold;
    if (lives) bar.death = kInfinity;
    if (!lives && !(bar.persistence() > min_persistence)) continue;
    result.add(bar, barcode.birth_cell(i).numbers,
               death && !lives ? death->numbers : std::span<const Index>());
    copy_representative(
        barcode, i, result, [&](const Numbers& cell) { return !beyond.contains(cell); },
        [](Numbers&) {});
  }
  result.sort();
  BarcodeInfo info = barcode.info();
  info.threshold = threshold;
  info.min_persistence = min_persistence;
  result.set_info(std::move(info));
  return result;
}

}  // namespace ph
