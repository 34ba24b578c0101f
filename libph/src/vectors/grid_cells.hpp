// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <string_view>
#include <vector>

#include "ph/vectorise.hpp"

namespace ph::vectors {

/// @throws Error (usage) on an invalid grid.
void check(const Grid& grid, std::string_view function);

/// The values of a grid, and a fast search for the place of a number among them.
class GridCells {
 public:
  /// @throws Error (usage) on an invalid grid.
  GridCells(const Grid& grid, std::string_view function);

  const std::vector<double>& values() const { return values_; }
  std::size_t size() const { return values_.size(); }
  double operator[](std::size_t i) const { return values_[i]; }

  /// The first place whose value is at least x, or size() if there is no such place. x must not be
  /// NaN. Usually takes O(1) time, and O(log size()) time in the worst case.
  std::size_t first_from(double x) const {
    return first(x, [x](double t) { return t >= x; });
  }
  /// The first place where the tent of a bar falls, that is, death - t < t - birth, with rounding.
  /// Takes as much time as `first_from`.
  std::size_t first_falling(const Bar& bar) const {
    return first(bar.birth / 2 + bar.death / 2,
                 [&](double t) { return bar.death - t < t - bar.birth; });
  }

 private:
  /// The first place where `is_behind` is true, searched near x. `is_behind` must also be true at
  /// all later places.
  template <class IsBehind>
  std::size_t first(double x, const IsBehind& is_behind) const {
    const double steps = per_step_ > 0 ? (x - values_.front()) * per_step_ : 0;
    auto guess = static_cast<std::size_t>(std::clamp(steps, 0.0, static_cast<double>(size())));
    // Apart from rounding, the guess is either correct or one too low.
    for (int i = 0; i < 2 && guess < size() && !is_behind(values_[guess]); ++i) ++guess;
    const bool is_end = guess == size() || is_behind(values_[guess]);
    // mutant: grid-place
    if (is_end && (guess == 0 || !is_behind(values_[guess - 1]))) return guess;
    return static_cast<std::size_t>(std::partition_point(values_.begin(), values_.end(),
                                                         [&](double t) { return !is_behind(t); }) -
                                    values_.begin());
  }

  std::vector<double> values_;
  double per_step_;
};

}  // namespace ph::vectors
