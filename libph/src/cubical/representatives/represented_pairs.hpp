// SPDX-License-Identifier: MIT
#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "libph/src/cubical/columns/voxel_chain.hpp"
#include "libph/src/cubical/representatives/represent_voxels.hpp"
#include "libph/src/cubical/sinks/pair_sink.hpp"

namespace ph::cubical {

/// The representative of a bar, filled in by the code that finds the bar.
template <Field K>
struct Representation {
  bool as_set = false;  ///< true if a set of voxels is wanted; code that has no set gives the chain
  VoxelChain<K> chain;  ///< cells of the stars' grid, each of which occurs once
  VoxelRange voxels;
};

/// Turns pairs of cells of the stars' grid into bars of the input, as PairSink does, and requests
/// the representatives of the bars that are kept.
template <Field K>
class RepresentedPairs {
 public:
  using Fill = std::function<void(Representation<K>&)>;

  RepresentedPairs(const StarGrid& grid, const K& field, Representatives kind,
                   const RunContext& context, const RepresentativeSink& sink)
      : grid_(grid),
        field_(field),
        kind_(kind),
        sink_(sink),
        claim_(context.memory, 0),
        pairs_(grid.shape(), true, bars_) {}
  RepresentedPairs(const RepresentedPairs&) = delete;
  RepresentedPairs& operator=(const RepresentedPairs&) = delete;

  bool wants_sets() const { return kind_ == Representatives::voxels; }
  // mutant: voxels-of-circle
  /// True if hollows are wanted as sets. If an axis with one voxel is periodic, a surface around a
  /// hollow also goes around that axis, which a set of voxels cannot express.
  bool wants_hollows() const { return wants_sets() && grid_.shape().loop_count() == 0; }
  /// Adds a pair as PairSink::pair does. @param fill called with a Representation to fill in, once
  /// for each kind of representation that the kept bars of this pair need. The kinds are sets and
  /// chains; the bars may need both or neither.
  void pair(int dim, const StarCell& birth, const StarCell& death, const Fill& fill) {
    begin(grid_.is_t_construction() ? death : birth, grid_.is_t_construction() ? &birth : &death,
          fill);
    pairs_.pair(dim, birth, death);
  }
  void essential(int dim, const StarCell& birth, const Fill& fill) {
    begin(birth, nullptr, fill);
    pairs_.essential(dim, birth);
  }

 private:
  void begin(const StarCell& birth, const StarCell* death, const Fill& fill) {
    fill_ = &fill;
    copies_ = 0;
    found_.reset();
    birth_voxel_ = birth.voxel;
    death_voxel_.reset();
    if (death != nullptr) death_voxel_ = death->voxel;
  }
  // Called for a bar and for its copies around periodic axes with one voxel. Call 0 is for the bar
  // itself. Call number k is for the copy that goes around the axes that the bits of k name.
  void add(const Bar& bar, std::span<const Index> birth, std::span<const Index> death) {
    const unsigned loops = copies_++;
    if (!sink_.add(bar, birth, death)) return;
    const bool as_set = bar.dim == 0 ? wants_sets() : wants_hollows();
    if (!found_ || found_->as_set != as_set) {
      found_.emplace().as_set = as_set;
      (*fill_)(*found_);
    }
    const std::size_t cells = found_->chain.size();
    claim_.grow_to(cells * (sizeof(found_->chain[0]) + (birth.size() + 1) * sizeof(Index)));
    numbers_.clear();
    coefficients_.clear();
    for (const auto& term : found_->chain) {
      const std::size_t before = numbers_.size();
      grid_.shape().append_numbers(term.cell.voxel, term.cell.direction, loops, numbers_);
      const bool turns = loops != 0 && is_turned(std::span(numbers_).subspan(before), loops);
      const auto a = term.coefficient();
      coefficients_.push_back(field_.to_int(turns ? field_.negate(a) : a));
    }
    RepresentedBar bar_of{numbers_, coefficients_, found_->voxels, {}, {}};
    if (wants_sets()) {
      birth_.clear();
      death_.clear();
      append_coordinates(birth_voxel_, birth_);
      if (death_voxel_) append_coordinates(*death_voxel_, death_);
      bar_of.birth_voxel = birth_;
      bar_of.death_voxel = death_;
    }
    sink_.represent(bar_of);
  }
  // True if a copy that goes around axes with one voxel has the opposite sign. By the product rule
  // for boundaries, the sign changes once for each pair of axes where the copy goes around the
  // first axis and the cell spans the second, later axis.
  bool is_turned(std::span<const Index> cell, unsigned loops) const {
    bool result = false, is_odd = false;  // the parity of the number of axes gone around
    std::size_t i = grid_.shape().loop_count();
    for (std::size_t k = 0; k < cell.size(); ++k) {
      if (i > 0 && grid_.shape().loop_axis(i - 1) == k) {
        if ((loops >> --i & 1U) != 0) is_odd = !is_odd;
      } else if (cell[k] % 2 != 0 && is_odd) {
        result = !result;
      }
    }
    return result;
  }
  void append_coordinates(std::uint32_t voxel, std::vector<Index>& numbers) const {
    grid_.shape().append_numbers(voxel, {}, 0, numbers);
    for (Index& x : numbers) x /= 2;
  }

  const StarGrid& grid_;
  const K& field_;
  Representatives kind_;
  const RepresentativeSink& sink_;
  const BarSink bars_{[this](const Bar& bar, std::span<const Index> birth,
                             std::span<const Index> death) { add(bar, birth, death); },
                      {},
                      {}};
  MemoryClaim claim_;  // memory for the longest chain and for its numbers
  PairSink pairs_;
  const Fill* fill_ = nullptr;
  unsigned copies_ = 0;
  std::optional<Representation<K>> found_;
  std::uint32_t birth_voxel_ = 0;
  std::optional<std::uint32_t> death_voxel_;
  std::vector<Index> numbers_, birth_, death_;
  std::vector<std::int64_t> coefficients_;
};

}  // namespace ph::cubical
