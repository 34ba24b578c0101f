// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "ph/barcode.hpp"
#include "ph/detail/core/field.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// Collects the pairs that an engine reports: it turns cells into bars and drops bars that the user
/// does not want.
template <Filtration F>
class BarcodeBuilder {
 public:
  using Cell = typename F::Cell;

  /// Keeps bars of dimension <= max_dim with death - birth > min_persistence; a negative
  /// `min_persistence` also keeps bars of length zero. The memory of the bars counts against the
  /// budget of the context as long as the builder exists.
  BarcodeBuilder(const F& filtration, int max_dim, double min_persistence,
                 Representatives representatives = Representatives::none, bool cells = true,
                 const RunContext& context = default_context())
      : filtration_(filtration),
        max_dim_(max_dim),
        min_persistence_(min_persistence),
        representatives_(representatives),
        cells_(cells),
        context_(context),
        claim_(context.memory, 0),
        barcode_(filtration.cell_kind()) {}

  int max_dim() const { return max_dim_; }
  /// Bars of dimensions below this one are dropped as well; an engine need not compute them.
  int min_dim() const { return min_dim_; }
  void set_min_dim(int dim) { min_dim_ = dim; }
  /// The representatives that an engine must pass with each bar.
  Representatives representatives() const { return representatives_; }
  /// True if bars keep their cells.
  bool wants_cells() const { return cells_; }
  /// True if an engine must report pairs of cells of equal value.
  bool wants_zero_length() const { return min_persistence_ < 0; }

  /// Announces, as a hint, that about `count` more bars may be added.
  void expect(std::size_t count) {
    require_room(count, 0);
    barcode_.reserve_more(count);
  }
  /// Adds a class of H_dim that is born with `birth` and killed by `death`, a cell of dimension dim
  /// + 1.
  /// @return true if the bar is kept; only then is a representative wanted.
  bool add_pair(int dim, const Cell& birth, const Cell& death) {
    if (!wants(dim)) return false;
    const Bar bar{dim, filtration_.value(birth), filtration_.value(death)};
    if (bar.is_infinite()) return add_essential(dim, birth);
    if (!(bar.persistence() > min_persistence_)) return false;
    add(bar, birth, &death);
    return true;
  }
  /// Adds a class of H_dim that never dies. A class that would be born at infinity is left out.
  bool add_essential(int dim, const Cell& birth) {
    if (!wants(dim) || filtration_.value(birth) == kInfinity) return false;
    add(Bar{dim, filtration_.value(birth), kInfinity}, birth, nullptr);
    return true;
  }
  /// Adds a bar whose cells, if they are kept, are given by their numbers; the class never dies if
  /// its death is infinite.
  bool add_bar(const Bar& bar, std::span<const Index> birth_cell,
               std::span<const Index> death_cell) {
    if (!keeps(bar)) return false;
    require_room(1, birth_cell.size() + death_cell.size());
    barcode_.add(bar, birth_cell, death_cell);
    claim_.grow_to(barcode_.bytes());
    return true;
  }
  /// Adds several bars without cells.
  void add_bars(std::span<const Bar> bars) {
    require_room(bars.size(), 0);
    barcode_.reserve_more(bars.size());
    for (const Bar& bar : bars)
      if (keeps(bar)) barcode_.add(bar);
    claim_.grow_to(barcode_.bytes());
  }
  /// Sets the representative of the last bar kept. @param terms cells (`cell`) with coefficients
  /// (`coefficient()`).
  template <class Terms, Field K>
  void add_representative(int dim, const Terms& terms, const K& field) {
    numbers_.clear();
    coefficients_.clear();
    for (const auto& term : terms) {
      filtration_.append_input_cell(dim, term.cell, numbers_);
      coefficients_.push_back(field.to_int(term.coefficient()));
    }
    add_representative(numbers_, coefficients_);
  }

  /// Sets the representative of the last bar kept, whose cells are given by their numbers in the
  /// input.
  void add_representative(std::span<const Index> numbers,
                          std::span<const std::int64_t> coefficients) {
    require_room(0, numbers.size(), coefficients.size());
    barcode_.set_representative(representatives_, numbers, coefficients);
    claim_.grow_to(barcode_.bytes());
  }
  /// Stores places of voxels. @return the position of the first of them among all stored places.
  std::size_t store_voxels(std::span<const std::uint32_t> places) {
    require_room(0, 0, 0, places.size());
    claim_.grow_to(barcode_.bytes() + places.size_bytes());
    return barcode_.store_voxels(places);
  }
  /// Sets the voxels of the last bar kept, which must have a representative.
  void add_voxels(VoxelRange voxels, std::span<const Index> birth_voxel,
                  std::span<const Index> death_voxel) {
    barcode_.set_voxels(voxels, birth_voxel, death_voxel);
    claim_.grow_to(barcode_.bytes());
  }

  Barcode finish() {
    barcode_.sort(context_);
    return std::move(barcode_);
  }

 private:
  bool wants(int dim) const { return min_dim_ <= dim && dim <= max_dim_; }
  bool keeps(const Bar& bar) const {
    return wants(bar.dim) && bar.birth < kInfinity &&
           (bar.is_infinite() || bar.persistence() > min_persistence_);
  }
  /// @throws Error (resource) if the old copies of arrays that are moved to make room would exceed
  /// the budget.
  void require_room(std::size_t bars, std::size_t numbers, std::size_t coefficients = 0,
                    std::size_t voxels = 0) const {
    constexpr std::size_t little = std::size_t{4} << 20;  // too little to matter in any budget
    const std::size_t moved = barcode_.bytes_moved_for(bars, numbers, coefficients, voxels);
    if (moved > little) context_.memory.require(moved);
  }
  void add(const Bar& bar, const Cell& birth, const Cell* death) {
    numbers_.clear();
    if (cells_) filtration_.append_input_cell(bar.dim, birth, numbers_);
    const std::size_t split = numbers_.size();
    if (cells_ && death) filtration_.append_input_cell(bar.dim + 1, *death, numbers_);
    const std::span<const Index> all(numbers_);
    require_room(1, all.size());
    barcode_.add(bar, all.first(split), all.subspan(split));
    claim_.grow_to(barcode_.bytes());
  }

  const F& filtration_;
  int max_dim_, min_dim_ = 0;
  double min_persistence_;
  Representatives representatives_;
  bool cells_;
  const RunContext& context_;
  MemoryClaim claim_;
  Barcode barcode_;
  std::vector<Index> numbers_;
  std::vector<std::int64_t> coefficients_;
};

}  // namespace ph
