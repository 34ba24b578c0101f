// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <concepts>
#include <cstdint>
#include <cstdlib>
#include <initializer_list>
#include <memory>
#include <new>
#include <span>
#include <type_traits>
#include <utility>

#include "ph/error.hpp"
#include "ph/filtration.hpp"

namespace ph {

/// A dense matrix of doubles from another library, such as an Eigen matrix, Map or Block. Strides
/// are counted in numbers.
template <class M>
concept MatrixOfDoubles = requires(const M& m) {
  { m.data() } -> std::same_as<const double*>;
  { m.rows() } -> std::convertible_to<Index>;
  { m.cols() } -> std::convertible_to<Index>;
  { m.rowStride() } -> std::convertible_to<Index>;
  { m.colStride() } -> std::convertible_to<Index>;
};

namespace detail {
/// True if the type of a matrix fixes that there are two to four rows, but not how many columns: it
/// has one point per column.
template <class M>
consteval bool has_points_in_columns() {
  if constexpr (requires { M::RowsAtCompileTime, M::ColsAtCompileTime; }) {
    constexpr int rows = M::RowsAtCompileTime, columns = M::ColsAtCompileTime;
    return rows >= 2 && rows <= 4 && columns < 0;
  } else {
    return false;
  }
}
}  // namespace detail

/// Points in R^d, in memory that another object owns: a matrix with one point per row. Depending on
/// the strides, rows are contiguous (C order) or columns are (F order), with or without gaps,
/// forwards or backwards. Copies are cheap; the numbers must outlive all copies.
class PointsView {
 public:
  constexpr PointsView() = default;
  /// @param data rows * columns numbers, row after row.
  constexpr PointsView(const double* data, Index rows, Index columns)
      : PointsView(data, rows, columns, columns, 1) {}
  /// @param data coordinate 0 of point 0.
  /// @param row_stride distance, in numbers, from a coordinate to the same coordinate of the next
  /// point; may be negative.
  /// @param column_stride distance, in numbers, from a coordinate to the next coordinate of the
  ///        same point.
  /// @throws Error (usage) on a negative size.
  constexpr PointsView(const double* data, Index rows, Index columns, Index row_stride,
                       Index column_stride)
      : data_(data),
        rows_(rows),
        columns_(columns),
        // If there are no columns, `data` may be null, and no stride must be added to it.
        row_stride_(columns > 0 ? row_stride : 0),
        column_stride_(column_stride) {
    if (rows < 0 || columns < 0) refuse(rows, columns);
  }
  template <MatrixOfDoubles M>
  constexpr PointsView(const M& matrix)
      : PointsView(matrix.data(), matrix.rows(), matrix.cols(), matrix.rowStride(),
                   matrix.colStride()) {
    static_assert(!detail::has_points_in_columns<M>(),
                  "libph expects one point per row: pass matrix.transpose()");
  }

  constexpr Index rows() const { return rows_; }     ///< number of points
  constexpr Index cols() const { return columns_; }  ///< number of coordinates of each point
  constexpr Index size() const { return rows_ * columns_; }
  constexpr double operator()(Index i, Index k) const {
    return data_[i * row_stride_ + k * column_stride_];
  }
  /// True if the coordinates of each point are contiguous in memory.
  constexpr bool has_whole_rows() const { return column_stride_ == 1 || columns_ <= 1; }
  /// The coordinates of a point. Precondition: has_whole_rows().
  constexpr const double* row(Index i) const { return data_ + i * row_stride_; }

 private:
  friend class Points;
  [[noreturn]] static void refuse(Index rows, Index columns);

  const double* data_ = nullptr;
  Index rows_ = 0, columns_ = 0, row_stride_ = 0, column_stride_ = 1;
};

/// Points in R^d, one per row, row after row. A moved-from object is empty.
class Points {
 public:
  Points() = default;
  /// All coordinates are 0. @throws Error (usage) on a negative size; std::bad_alloc.
  Points(Index rows, Index columns) : rows_(rows), columns_(columns), data_(zeros(rows, columns)) {}
  /// One list per point: `Points{{0, 0}, {1, 0}}`. @throws Error (usage) if their lengths differ.
  Points(std::initializer_list<std::initializer_list<double>> rows);
  /// Copies the points.
  explicit Points(PointsView view) : Points(view.rows(), view.cols()) {
    fill([&](Index i, Index k) { return view(i, k); });
  }
  /// Copies numbers of any type. Strides are as in PointsView.
  template <class Number>
  requires std::is_arithmetic_v<Number>
  static Points of(const Number* data, Index rows, Index columns, Index row_stride,
                   Index column_stride) {
    Points points(rows, columns);
    points.fill([&](Index i, Index k) {
      return static_cast<double>(data[i * row_stride + k * column_stride]);
    });
    return points;
  }
  Points(const Points& other) : Points(PointsView(other)) {}
  Points(Points&& other) noexcept
      : rows_(std::exchange(other.rows_, 0)),
        columns_(std::exchange(other.columns_, 0)),
        data_(std::move(other.data_)) {}
  Points& operator=(Points other) noexcept {
    std::swap(rows_, other.rows_);
    std::swap(columns_, other.columns_);
    std::swap(data_, other.data_);
    return *this;
  }
  ~Points() = default;

  operator PointsView() const { return {data_.get(), rows_, columns_}; }
  Index rows() const { return rows_; }     ///< number of points
  Index cols() const { return columns_; }  ///< number of coordinates of each point
  Index size() const { return rows_ * columns_; }
  double* data() { return data_.get(); }
  const double* data() const { return data_.get(); }
  double& operator()(Index i, Index k) { return data_.get()[i * columns_ + k]; }
  double operator()(Index i, Index k) const { return data_.get()[i * columns_ + k]; }
  std::span<double> row(Index i) { return {data() + i * columns_, to_size(columns_)}; }
  std::span<const double> row(Index i) const { return {data() + i * columns_, to_size(columns_)}; }
  /// @throws Error (usage) unless the numbers of coordinates and columns agree.
  void set_row(Index i, std::initializer_list<double> coordinates);
  /// All coordinates, point after point.
  std::span<double> coordinates() { return {data(), to_size(size())}; }
  std::span<const double> coordinates() const { return {data(), to_size(size())}; }

  /// Keeps the first `rows` points. Precondition: rows <= rows().
  void keep_rows(Index rows);

  friend bool operator==(const Points& a, const Points& b) {
    return a.rows_ == b.rows_ && a.columns_ == b.columns_ &&
           std::ranges::equal(a.coordinates(), b.coordinates());
  }

 private:
  struct Free {
    void operator()(double* data) const { std::free(data); }
  };
  // Allocated by calloc: pages that nobody writes to take no memory, and realloc gives back the
  // unused end.
  using Data = std::unique_ptr<double, Free>;
  static Data zeros(Index rows, Index columns);
  static std::size_t to_size(Index n) { return static_cast<std::size_t>(n); }
  template <class NumberAt>
  void fill(NumberAt&& number_at) {
    for (Index i = 0; i < rows_; ++i)
      for (Index k = 0; k < columns_; ++k) (*this)(i, k) = number_at(i, k);
  }

  Index rows_ = 0, columns_ = 0;
  Data data_;
};

/// Points whose coordinates are contiguous in memory: the points of a view if it has whole rows,
/// otherwise a copy. PointMetric holds one, for code that reads entire rows.
class WholeRows {
 public:
  explicit WholeRows(PointsView view) : view_(view) {
    if (view.has_whole_rows()) return;
    copy_ = std::make_shared<const Points>(view);
    view_ = *copy_;
  }
  PointsView view() const { return view_; }

 private:
  std::shared_ptr<const Points> copy_;
  PointsView view_;
};

/// The delay embedding of a time series: point i has the values at times i, i + delay, i + 2 delay,
/// … (F. Takens, Detecting strange attractors in turbulence, 1981).
/// @param series one time per row, one quantity per column.
/// @param dimension number of times per point, > 0. @param delay rows between two of these times, >
/// 0.
/// @return rows - (dimension - 1) * delay points of dimension * columns coordinates: all quantities
///         of the first time, then all quantities of the next. The time is proportional to the
///         number of points.
/// @throws Error (usage) on a dimension or delay below 1; Error (bad_data) if the series is too
///         short for one point.
Points delay_embedding(PointsView series, Index dimension, Index delay = 1);

/// The largest absolute value of a coordinate, ignoring NaN; 0 if every coordinate is NaN or there
/// is none.
double largest_coordinate(PointsView points);

}  // namespace ph
