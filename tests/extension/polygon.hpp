// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <ph/custom.hpp>
#include <vector>

/// A complex defined by a user: each point is joined to the next point, and the last point to the
/// first. Points enter at 0, and sides enter at their length.
class Polygon : public ph::CellFiltration<Polygon, 1, int> {
 public:
  explicit Polygon(ph::PointsView points) {
    const auto n = static_cast<int>(points.rows());
    sides_.resize(n < 3 ? 0 : static_cast<std::size_t>(n));
    corners_ = n;
    for (std::size_t i = 0; i < sides_.size(); ++i)
      for (ph::Index k = 0; k < points.cols(); ++k)
        sides_[i] = std::hypot(sides_[i], points(static_cast<ph::Index>(i), k) -
                                              points(static_cast<ph::Index>(next(i)), k));
  }

  // The first numbers are corners. The other numbers are sides, each from one corner to the next.
  double value(Cell cell) const {
    return cell < corners_ ? 0 : sides_[static_cast<std::size_t>(cell - corners_)];
  }
  template <class Visit>
  void for_each_cell(int dim, Visit&& visit) const {
    if (dim == 0)
      for (int i = 0; i < corners_; ++i) visit(i);
    if (dim == 1)
      for (int i = 0; i < static_cast<int>(sides_.size()); ++i) visit(corners_ + i);
  }
  template <class Visit>
  void for_each_facet(int dim, Cell cell, Visit&& visit) const {
    if (dim != 1) return;
    const auto side = static_cast<std::size_t>(cell - corners_);
    visit(static_cast<int>(side), -1);
    visit(next(side), 1);
  }

  // Names cells by their corners. Without this function, cells would be named by their numbers.
  ph::CellKind cell_kind() const { return ph::CellKind::vertices; }
  void append_input_cell(int dim, Cell cell, std::vector<ph::Index>& numbers) const {
    if (dim == 0) {
      numbers.push_back(cell);
      return;
    }
    const int a = cell - corners_, b = next(static_cast<std::size_t>(a));
    numbers.insert(numbers.end(), {std::min(a, b), std::max(a, b)});
  }

 private:
  int next(std::size_t corner) const { return static_cast<int>((corner + 1) % sides_.size()); }

  int corners_ = 0;
  std::vector<double> sides_;
};
