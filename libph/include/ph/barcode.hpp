// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "ph/filtration.hpp"
#include "ph/run_context.hpp"

namespace ph {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// One interval [birth, death) of the barcode: a class of H_dim born at `birth`, zero from `death`.
struct Bar {
  int dim = 0;
  double birth = 0;
  double death = kInfinity;

  bool is_infinite() const { return death == kInfinity; }
  double persistence() const { return birth == death ? 0.0 : death - birth; }
  friend bool operator==(const Bar&, const Bar&) = default;
};

/// A cell as the user knows it. `numbers` points into the barcode it came from.
struct InputCell {
  CellKind kind;
  std::span<const Index> numbers;
};

/// A chain or cochain in terms of the input: cells of one dimension, each with its coefficient.
/// Points into the barcode it came from.
class InputChain {
 public:
  InputChain(CellKind kind, std::span<const Index> numbers,
             std::span<const std::int64_t> coefficients)
      : kind_(kind), numbers_(numbers), coefficients_(coefficients) {}

  std::size_t size() const { return coefficients_.size(); }
  InputCell cell(std::size_t i) const {
    const std::size_t arity = numbers_.size() / size();
    return {kind_, numbers_.subspan(i * arity, arity)};
  }
  /// Between -p/2 and p/2, never 0; always 1 over Z/2.
  std::int64_t coefficient(std::size_t i) const { return coefficients_[i]; }

 private:
  CellKind kind_;
  std::span<const Index> numbers_;
  std::span<const std::int64_t> coefficients_;
};

/// What comes with the bars to show where they are.
enum class Representatives {
  none,
  cycles,    ///< a cycle born with the bar that is a boundary from its death on
  cocycles,  ///< a cochain, zero before the birth, whose coboundary is first non-zero at the death
  /// Images only: with bars of H0 the voxels of the component that dies, just before it does; with
  /// those of the highest dimension less one the voxels of the hollow, just after the birth; with
  /// all others a cycle.
  voxels,
};

/// A part of the voxels that a barcode keeps.
struct VoxelRange {
  std::size_t begin = 0, end = 0;
};

/// The result of persistent homology: bars ordered by dimension, birth, death (an infinite death
/// last) and birth cell, each with the cell that gave birth to it and, if it died, the cell that
/// killed it, unless they were not asked for (Options::cells). A value: it owns all it shows.
class Barcode {
 public:
  explicit Barcode(CellKind kind = CellKind::vertices) : kind_(kind) {}

  std::size_t size() const { return bars_.size(); }
  bool empty() const { return bars_.empty(); }
  const Bar& operator[](std::size_t i) const { return bars_[i]; }
  auto begin() const { return bars_.begin(); }
  auto end() const { return bars_.end(); }

  /// The bars of one dimension, in order.
  std::span<const Bar> bars(int dim) const&;
  /// Of a barcode that nobody keeps: `for (const Bar& bar : persistence(rips).bars(1))`.
  std::vector<Bar> bars(int dim) &&;
  /// Position of the longest bar of a dimension, infinite ones first, the first among equals.
  /// @throws Error (usage) if there is none.
  std::size_t longest(int dim) const;

  CellKind cell_kind() const { return kind_; }
  /// The cell that gave birth to bar i; without numbers if cells are not kept.
  InputCell birth_cell(std::size_t i) const { return {kind_, birth_numbers(i)}; }
  /// The cell that killed bar i; nothing for an infinite bar, or if cells are not kept.
  std::optional<InputCell> death_cell(std::size_t i) const {
    const std::span<const Index> numbers = death_numbers(i);
    if (numbers.empty()) return std::nullopt;
    return InputCell{kind_, numbers};
  }

  /// What `representative` gives: as asked for in Options.
  Representatives representatives() const { return representatives_; }
  /// The cycle or cocycle of bar i, the birth cell among its cells.
  /// @throws Error (usage) if none were asked for.
  InputChain representative(std::size_t i) const;
  /// The voxels of bar i as places in the image in C order (the last axis is the fastest), each
  /// once, in no order that means anything: sets lie in each other as components do, and share
  /// memory. None for a bar that has a cycle in their place, or if they were not asked for.
  std::span<const std::uint32_t> voxels(std::size_t i) const;
  /// The coordinates of the voxel whose value is the birth of bar i, by axis of the input; none if
  /// voxels were not asked for.
  std::span<const Index> birth_voxel(std::size_t i) const;
  /// The same for its death; none for an infinite bar.
  std::span<const Index> death_voxel(std::size_t i) const;

  /// Makes room for so many more bars.
  void reserve_more(std::size_t count) {
    // By a quarter: where many come without a word both the old and the new ones are there a while.
    if (bars_.capacity() - bars_.size() < count)
      bars_.reserve(bars_.size() + std::max(count, bars_.size() / 4));
  }
  /// Appends a bar without cells.
  void add(const Bar& bar) {
    bars_.push_back(bar);
    if (!cells_.empty()) cells_.resize(bars_.size());
  }
  /// Appends a bar. No `death_cell`: the class lives for ever.
  void add(const Bar& bar, std::span<const Index> birth_cell, std::span<const Index> death_cell);
  /// Gives the bar added last its representative: the numbers of all cells, one after another.
  void set_representative(Representatives kind, std::span<const Index> numbers,
                          std::span<const std::int64_t> coefficients);
  /// Keeps places of voxels. @return where they begin among all that are kept.
  std::size_t store_voxels(std::span<const std::uint32_t> places);
  /// Gives the bar added last, which has a representative, some of the voxels that are kept, and
  /// the voxels of its birth and death.
  void set_voxels(VoxelRange voxels, std::span<const Index> birth_voxel,
                  std::span<const Index> death_voxel);
  /// Brings the bars into the order stated above. @throws Error (resource, cancelled).
  void sort(const RunContext& context = default_context());
  /// What has to be moved to make room for more: meanwhile it is there twice.
  std::size_t bytes_moved_for(std::size_t bars, std::size_t numbers, std::size_t coefficients = 0,
                              std::size_t voxels = 0) const {
    const auto moved = [](const auto& all, std::size_t more) {
      return all.capacity() - all.size() < more ? all.size() * sizeof(all[0]) : 0;
    };
    return moved(bars_, bars) + moved(cells_, bars) + moved(numbers_, numbers) +
           moved(coefficients_, coefficients) + moved(voxels_, voxels);
  }
  /// What it holds; room for more is not touched yet.
  std::size_t bytes() const {
    return bars_.size() * sizeof(Bar) + cells_.size() * sizeof(Cells) +
           chains_.size() * sizeof(Chain) +
           (numbers_.size() + coefficients_.size()) * sizeof(Index) +
           sets_.size() * sizeof(VoxelSet) + voxels_.size() * sizeof(std::uint32_t);
  }

 private:
  struct Range {
    std::size_t begin = 0, end = 0;
  };
  struct Cells {
    std::size_t birth = 0, death = 0, end = 0;  // where their numbers begin
    std::size_t chain = kNone;                  // in chains_
  };
  struct Chain {
    Range numbers, coefficients;
  };
  struct VoxelSet {
    VoxelRange voxels;
    Range birth, death;  // coordinates in the numbers
  };
  static constexpr std::size_t kNone = SIZE_MAX;
  std::span<const Index> birth_numbers(std::size_t i) const {
    return cells_.empty() ? std::span<const Index>()
                          : numbers_of({cells_[i].birth, cells_[i].death});
  }
  std::span<const Index> death_numbers(std::size_t i) const {
    return cells_.empty() ? std::span<const Index>() : numbers_of({cells_[i].death, cells_[i].end});
  }
  // Of bar i; nothing if it has none.
  template <class T>
  T part_of(std::size_t i, const std::vector<T>& parts) const {
    const std::size_t place = cells_.empty() ? kNone : cells_[i].chain;
    return place < parts.size() ? parts[place] : T();
  }
  Range store(std::span<const Index> numbers);
  void sort_values(const RunContext& context);
  std::span<const Index> numbers_of(Range r) const {
    return std::span(numbers_).subspan(r.begin, r.end - r.begin);
  }

  CellKind kind_;
  std::vector<Bar> bars_;
  std::vector<Cells> cells_;    // parallel to bars_, or empty: no bar has any
  std::vector<Index> numbers_;  // all cells, one after another
  Representatives representatives_ = Representatives::none;
  std::vector<Chain> chains_;
  std::vector<std::int64_t> coefficients_;
  std::vector<VoxelSet> sets_;         // parallel to chains_, or empty
  std::vector<std::uint32_t> voxels_;  // all sets, which may overlap
};

}  // namespace ph
