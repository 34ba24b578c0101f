// SPDX-License-Identifier: MIT
#include "libph/src/alpha/periodic/quotient.hpp"

#include <algorithm>

#include "libph/src/alpha/triangulation/triangulations.hpp"

namespace ph::alpha {
namespace {

using std::uint32_t;
using Cell = std::array<uint32_t, 4>;

/// For cells sorted by their smallest vertex, the first cell of each vertex.
std::pmr::vector<uint32_t> cells_by_vertex(const RawVector<Cell>& cells, std::size_t vertices,
                                           std::pmr::memory_resource* memory) {
  std::pmr::vector<uint32_t> begin(vertices + 1, 0, memory);
  for (const Cell& cell : cells) ++begin[cell[0] + 1];
  for (std::size_t v = 0; v < vertices; ++v) begin[v + 1] += begin[v];
  return begin;
}

class Quotient {
 public:
  Quotient(const Triangulation& unrolled, const Images& images, const Box& box,
           const RunContext& context)
      : unrolled_(unrolled),
        images_(images),
        box_(box),
        context_(context),
        size_(static_cast<std::size_t>(unrolled.dim) + 1),
        sites_(images.begin.size() - 1),
        number_(unrolled.size(), kNone, &context.memory),
        begin_(&context.memory),
        kept_(&context.memory),
        result_(&context.memory),
        of_cell_(&context.memory) {}

  bool make() {
    choose_cells();
    context_.poll();
    if (!glue_facets()) return false;
    context_.poll();
    return has_each_site() && covers_once();
  }
  Triangulation& result() { return result_; }
  RawVector<Cell>& of_cell() { return of_cell_; }

 private:
  Translation translation(uint32_t place) const { return images_.translation[place]; }

  /// The translation of a cell relative to the box. On each axis, it is the median of the vertices'
  /// translations. All translates of a cell become the same cell when this translation is undone.
  Translation home(const Cell& cell) const {
    const Translation first = translation(cell[0]);
    bool is_same = true;
    for (std::size_t i = 1; i < size_; ++i) is_same = is_same && translation(cell[i]) == first;
    if (is_same) return first;
    std::array<std::array<std::int64_t, 4>, 3> by_axis{};
    for (std::size_t i = 0; i < size_; ++i) {
      const auto periods = periods_of(translation(cell[i]));
      for (std::size_t axis = 0; axis < 3; ++axis) by_axis[axis][i] = periods[axis];
    }
    std::array<std::int64_t, 3> middle{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      auto& of_axis = by_axis[axis];
      std::sort(of_axis.begin(), of_axis.begin() + static_cast<std::ptrdiff_t>(size_));
      middle[axis] = of_axis[(size_ - 1) / 2];
    }
    return translation_by(middle);
  }

  void choose_cells() {
    result_.dim = unrolled_.dim;
    for (uint32_t t = 0; t < unrolled_.size(); ++t) {
      const Cell& cell = unrolled_.cells[t];
      if (home(cell) != 0) continue;  // mutant: alpha-home
      number_[t] = static_cast<uint32_t>(kept_.size());
      kept_.push_back(t);
      Cell sites{kNone, kNone, kNone, kNone};
      for (std::size_t i = 0; i < size_; ++i) sites[i] = images_.site[cell[i]];
      result_.cells.push_back(sites);
      of_cell_.push_back(cell);
      if (size_ > 2) result_.is_reversed.push_back(unrolled_.is_reversed[t]);
    }
    begin_ = cells_by_vertex(result_.cells, sites_, &context_.memory);
  }

  /// The number of the kept cell that is a translate of an unrolled cell, or kNone if there is
  /// none.
  uint32_t number_of(uint32_t t) const {
    if (number_[t] != kNone) return number_[t];
    const Cell& cell = unrolled_.cells[t];
    const Translation from = home(cell);
    const uint32_t site = images_.site[cell[0]];
    for (uint32_t n = begin_[site]; n < begin_[site + 1]; ++n) {
      bool is_same = true;
      for (std::size_t i = 0; i < size_; ++i)
        // mutant: alpha-same-cell
        is_same = is_same && result_.cells[n][i] == images_.site[cell[i]] &&
                  translation(of_cell_[n][i]) == translation(cell[i]) - from;
      if (is_same) return n;
    }
    return kNone;
  }

  /// True if a facet is parallel to each closed axis, that is, its affine hull contains the
  /// direction of the axis.
  bool is_along_closed_axes(uint32_t t, std::size_t facet) const {
    std::size_t closed = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) closed += box_.is_closed(axis) ? 1U : 0U;
    const std::size_t dim = size_ - 2;
    if (closed > dim) return false;
    // If the affine hull contains these directions, the projection along them lowers the dimension
    // of the facet by `closed`.
    std::array<Vector<double>, 3> seen;
    std::size_t count = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      if (i == facet) continue;
      const Vector<double>& p = images_.places.points[unrolled_.cells[t][i]];
      seen[count++] = {box_.is_closed(0) ? 0 : p.x, box_.is_closed(1) ? 0 : p.y,
                       box_.is_closed(2) ? 0 : p.z};
    }
    if (dim == closed)
      return std::all_of(seen.begin(), seen.begin() + static_cast<std::ptrdiff_t>(count),
                         [&](const auto& p) { return p == seen[0]; });
    // This case has dimension 2 and one closed axis.
    return are_collinear(seen);
  }

  bool glue_facets() {
    if (size_ == 2) return is_closed_line();
    result_.across.resize(kept_.size());
    for (uint32_t n = 0; n < kept_.size(); ++n) {
      result_.across[n].fill(kNone);
      for (std::size_t k = 0; k < size_; ++k) {
        const uint32_t code = unrolled_.across[kept_[n]][k];
        if (code == kNone) {
          if (!is_along_closed_axes(kept_[n], k)) return false;  // mutant: alpha-closed-axes
          continue;
        }
        const uint32_t other = number_of(code >> 2);
        if (other == kNone) return false;
        result_.across[n][k] = 4 * other + (code & 3);
      }
    }
    for (uint32_t n = 0; n < kept_.size(); ++n)
      for (uint32_t k = 0; k < size_; ++k) {
        const uint32_t code = result_.across[n][k];
        if (code != kNone && result_.across[code >> 2][code & 3] != 4 * n + k) return false;
      }
    return !kept_.empty();
  }
  /// True if each site has one edge before it and one edge after it, or (if it is hidden) no edge.
  /// Precondition: the sites are collinear, along a closed axis.
  bool is_closed_line() const {
    std::pmr::vector<uint32_t> before(sites_, 0, &context_.memory), behind = before;
    for (const Cell& places : of_cell_) {
      const auto& p = images_.places.points;
      const bool ascends = lexicographically_before(p[places[0]], p[places[1]]);
      ++behind[images_.site[places[ascends ? 0 : 1]]];
      ++before[images_.site[places[ascends ? 1 : 0]]];
    }
    return before == behind && std::ranges::all_of(before, [](uint32_t n) { return n <= 1; });
  }

  bool has_each_site() const {
    std::pmr::vector<bool> is_kept(sites_, false, &context_.memory);
    for (const Cell& cell : result_.cells)
      for (std::size_t i = 0; i < size_; ++i) is_kept[cell[i]] = true;
    std::pmr::vector<bool> is_wanted(sites_, !images_.places.is_weighted(), &context_.memory);
    if (images_.places.is_weighted())
      for (const Cell& cell : unrolled_.cells)
        for (std::size_t i = 0; i < size_; ++i)
          if (translation(cell[i]) == 0) is_wanted[images_.site[cell[i]]] = true;
    return is_kept == is_wanted;
  }

  /// Takes one of the sites, and moves each kept cell at this site so that the site is in the box.
  /// True if all the moved cells are cells of the unrolled triangulation. The kept cells then cover
  /// the surroundings of this site once.
  bool covers_once() const {
    const auto begin = cells_by_vertex(unrolled_.cells, images_.places.size(), &context_.memory);
    const uint32_t site = result_.cells[0][0];
    for (const Cell& places : of_cell_)
      for (std::size_t i = 0; i < size_; ++i)
        if (images_.site[places[i]] == site && !is_there(places, translation(places[i]), begin))
          return false;
    return true;
  }
  /// True if the unrolled triangulation has the cell that results from moving `cell` back by a
  /// translation.
  bool is_there(Cell cell, Translation by, const std::pmr::vector<uint32_t>& begin) const {
    for (std::size_t i = 0; i < size_; ++i) {
      cell[i] = images_.place_of(images_.site[cell[i]], translation(cell[i]) - by);
      if (cell[i] == kNone) return false;
    }
    const auto& cells = unrolled_.cells;
    return std::find(cells.begin() + begin[cell[0]], cells.begin() + begin[cell[0] + 1], cell) !=
           cells.begin() + begin[cell[0] + 1];
  }

  const Triangulation& unrolled_;
  const Images& images_;
  const Box& box_;
  const RunContext& context_;
  const std::size_t size_;   // the number of vertices of a cell
  const std::size_t sites_;  // the number of sites
  // For each unrolled cell, the number of the kept cell that is its translate, or kNone.
  std::pmr::vector<uint32_t> number_;
  std::pmr::vector<uint32_t> begin_;  // for each site, the kept cells with this smallest vertex
  std::pmr::vector<uint32_t> kept_;   // the unrolled cells that are kept, by number
  Triangulation result_;
  RawVector<Cell> of_cell_;
};

}  // namespace

bool take_quotient(Triangulation& triangulation, Images& images, const Box& box,
                   const RunContext& context) {
  Quotient quotient(triangulation, images, box, context);
  if (!quotient.make()) return false;
  images.of_cell = std::move(quotient.of_cell());
  triangulation = std::move(quotient.result());
  return true;
}

}  // namespace ph::alpha
