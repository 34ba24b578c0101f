// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "ph/detail/core/barcode_info.hpp"
#include "ph/detail/core/names.hpp"
#include "ph/filtration.hpp"
#include "ph/run_context.hpp"

namespace ph {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// One interval [birth, death) of the barcode: a class of H_dim that is born at `birth` and is zero
/// from `death` on.
struct Bar {
  int dim = 0;
  double birth = 0;
  double death = kInfinity;

  bool is_infinite() const { return death == kInfinity; }
  double persistence() const { return birth == death ? 0.0 : death - birth; }
  friend bool operator==(const Bar&, const Bar&) = default;
};

/// A cell in terms of the user's input. `numbers` points into the barcode to which the cell
/// belongs.
struct InputCell {
  CellKind kind;
  std::span<const Index> numbers;
};

/// A chain or cochain in terms of the input: cells of one dimension, each with its coefficient. It
/// points into the barcode to which it belongs.
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
  /// The coefficient of cell i: between -p/2 and p/2, never 0; always 1 over Z/2.
  std::int64_t coefficient(std::size_t i) const { return coefficients_[i]; }

 private:
  CellKind kind_;
  std::span<const Index> numbers_;
  std::span<const std::int64_t> coefficients_;
};

/// The kind of representative to compute for each bar. A representative shows where in the data the
/// bar lies.
enum class Representatives {
  none,
  cycles,    ///< a cycle that is born with the bar and becomes a boundary at the death
  cocycles,  ///< a cochain, zero before the birth, whose coboundary is first non-zero at the death
  /// Images only. Bars of H0 get the voxels of the dying component just before it dies. Bars of the
  /// second highest dimension get the voxels of the hollow just after its birth. All other bars get
  /// a cycle.
  voxels,
};

template <>
inline constexpr std::array names_of<Representatives>{
    Named{Representatives::none, "none"},
    Named{Representatives::cycles, "cycles"},
    Named{Representatives::cocycles, "cocycles"},
    Named{Representatives::voxels, "voxels"},
};

/// A range of the voxels that a barcode stores.
struct VoxelRange {
  std::size_t begin = 0, end = 0;
};

/// The result of persistent homology: bars ordered by dimension, birth, death (infinite deaths
/// last) and birth cell. Each bar has the cell that gave birth to it and, if it died, the cell that
/// killed it, unless Options::cells is off. A barcode is a value: it owns everything that it shows.
/// A computed barcode also states its origin, which copies of the barcode share.
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
  /// Returns a copy, for a temporary barcode: `for (const Bar& bar : persistence(rips).bars(1))`.
  std::vector<Bar> bars(int dim) &&;
  /// Position of the longest bar of a dimension. Infinite bars count as longest. Among equally long
  /// bars, the first one is returned.
  /// @throws Error (usage) if the dimension has no bars.
  std::size_t longest(int dim) const;

  CellKind cell_kind() const { return kind_; }
  /// The cell that gave birth to bar i; it has no numbers if cells are not kept.
  InputCell birth_cell(std::size_t i) const { return {kind_, birth_numbers(i)}; }
  /// The cell that killed bar i; empty for an infinite bar, or if cells are not kept.
  std::optional<InputCell> death_cell(std::size_t i) const {
    const std::span<const Index> numbers = death_numbers(i);
    if (numbers.empty()) return std::nullopt;
    return InputCell{kind_, numbers};
  }

  /// The kind of chain that `representative` returns, as chosen in Options.
  Representatives representatives() const { return representatives_; }
  /// The cycle or cocycle of bar i; the birth cell is one of its cells.
  /// @throws Error (usage) if no representatives were requested.
  InputChain representative(std::size_t i) const;
  /// The voxels of bar i, each listed once, by their positions in the image in C order (the last
  /// axis is the fastest). The list is in no particular order, because the sets of nested
  /// components share memory. It is empty if the bar has a cycle instead, or if voxels were not
  /// requested.
  std::span<const std::uint32_t> voxels(std::size_t i) const;
  /// The coordinates of the voxel whose value is the birth of bar i, in the order of the input's
  /// axes; empty if voxels were not requested.
  std::span<const Index> birth_voxel(std::size_t i) const;
  /// The coordinates of the voxel whose value is the death of bar i; empty for an infinite bar.
  std::span<const Index> death_voxel(std::size_t i) const;

  /// What was computed, of what, and how. Computations and readers of JSON state it; it is empty
  /// for bars that were added by hand.
  const BarcodeInfo& info() const;
  /// Replaces the origin, of this barcode alone.
  void set_info(BarcodeInfo info) { info_ = std::make_shared<const BarcodeInfo>(std::move(info)); }

  /// Makes room for `count` more bars.
  void reserve_more(std::size_t count) {
    // Grows only by a quarter, because the old and the new array exist at the same time during the
    // move.
    if (bars_.capacity() - bars_.size() < count)
      bars_.reserve(bars_.size() + std::max(count, bars_.size() / 4));
  }
  /// Appends a bar without cells.
  void add(const Bar& bar) {
    bars_.push_back(bar);
    if (!cells_.empty()) cells_.resize(bars_.size());
  }
  /// Appends a bar. Without `death_cell` the class lives forever.
  void add(const Bar& bar, std::span<const Index> birth_cell, std::span<const Index> death_cell);
  /// Sets the representative of the bar that was added last. @param numbers the numbers of all its
  /// cells, one after another.
  void set_representative(Representatives kind, std::span<const Index> numbers,
                          std::span<const std::int64_t> coefficients);
  /// Stores places of voxels. @return the position of the first of them among all stored places.
  std::size_t store_voxels(std::span<const std::uint32_t> places);
  /// Sets the voxels of the bar that was added last, which must have a representative: a range of
  /// the stored voxels, and the coordinates of the voxels of its birth and death.
  void set_voxels(VoxelRange voxels, std::span<const Index> birth_voxel,
                  std::span<const Index> death_voxel);
  /// Sorts the bars into the order described above. @throws Error (resource, cancelled).
  void sort(const RunContext& context = default_context());
  /// The number of bytes that must be moved to make room for the given numbers of additional bars,
  /// cell numbers, coefficients and voxels. During the move, these bytes exist twice.
  std::size_t bytes_moved_for(std::size_t bars, std::size_t numbers, std::size_t coefficients = 0,
                              std::size_t voxels = 0) const {
    const auto moved = [](const auto& all, std::size_t more) {
      return all.capacity() - all.size() < more ? all.size() * sizeof(all[0]) : 0;
    };
    return moved(bars_, bars) + moved(cells_, bars) + moved(numbers_, numbers) +
           moved(coefficients_, coefficients) + moved(voxels_, voxels);
  }
  /// The number of bytes that the barcode holds. Reserved memory is not counted, because it has not
  /// been touched yet.
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
    std::size_t birth = 0, death = 0, end = 0;  // bounds of the cells in numbers_
    std::size_t chain = kNone;                  // index into chains_
  };
  struct Chain {
    Range numbers, coefficients;
  };
  struct VoxelSet {
    VoxelRange voxels;
    Range birth, death;  // coordinates in numbers_
  };
  static constexpr std::size_t kNone = SIZE_MAX;
  std::span<const Index> birth_numbers(std::size_t i) const {
    return cells_.empty() ? std::span<const Index>()
                          : numbers_of({cells_[i].birth, cells_[i].death});
  }
  std::span<const Index> death_numbers(std::size_t i) const {
    return cells_.empty() ? std::span<const Index>() : numbers_of({cells_[i].death, cells_[i].end});
  }
  // The entry of bar i in `parts`, or an empty entry if the bar has none.
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
  std::vector<Cells> cells_;    // parallel to bars_, or empty if no bar has cells
  std::vector<Index> numbers_;  // the numbers of all cells, one after another
  Representatives representatives_ = Representatives::none;
  std::vector<Chain> chains_;
  std::vector<std::int64_t> coefficients_;
  std::vector<VoxelSet> sets_;         // parallel to chains_, or empty if no bar has sets
  std::vector<std::uint32_t> voxels_;  // all stored voxels; the sets are ranges, which may overlap
  std::shared_ptr<const BarcodeInfo> info_;  // null if the origin is unknown
};

}  // namespace ph
