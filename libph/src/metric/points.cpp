// SPDX-License-Identifier: MIT
#include "ph/points.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace ph {

Points::Points(std::initializer_list<std::initializer_list<double>> rows)
    : Points(static_cast<Index>(rows.size()),
             rows.size() == 0 ? 0 : static_cast<Index>(rows.begin()->size())) {
  Index i = 0;
  for (const auto& row : rows) set_row(i++, row);
}

void Points::set_row(Index i, std::initializer_list<double> coordinates) {
  if (static_cast<Index>(coordinates.size()) != columns_)
    throw Error(ErrorKind::usage, fmt::format("point {}: found {} coordinates, expected {}", i,
                                              coordinates.size(), columns_));
  std::ranges::copy(coordinates, row(i).begin());
}

void PointsView::refuse(Index rows, Index columns) {
  throw Error(
      ErrorKind::usage,
      fmt::format("points: found {} x {} coordinates, expected no negative number", rows, columns));
}

Points::Data Points::zeros(Index rows, Index columns) {
  if (rows < 0 || columns < 0) PointsView::refuse(rows, columns);
  if (rows == 0 || columns == 0) return nullptr;
  const std::size_t most = std::numeric_limits<std::ptrdiff_t>::max() / sizeof(double);
  if (to_size(rows) > most / to_size(columns)) throw std::bad_alloc();
  Data data(static_cast<double*>(std::calloc(to_size(rows) * to_size(columns), sizeof(double))));
  if (data == nullptr) throw std::bad_alloc();
  return data;
}

void Points::keep_rows(Index rows) {
  rows_ = rows;
  if (size() == 0) {
    data_.reset();
  } else if (void* data = std::realloc(data_.get(), to_size(size()) * sizeof(double))) {
    static_cast<void>(data_.release());
    data_.reset(static_cast<double*>(data));
  }
}

Points delay_embedding(PointsView series, Index dimension, Index delay) {
  for (const auto& [name, value] : {std::pair("dimension", dimension), std::pair("delay", delay)})
    if (value < 1)
      throw Error(ErrorKind::usage,
                  fmt::format("delay embedding: {}: found {}, expected at least 1", name, value));
  if (series.rows() == 0 || dimension - 1 > (series.rows() - 1) / delay)
    throw Error(ErrorKind::bad_data,
                fmt::format("delay embedding: found a series of {} times, expected more than "
                            "({} - 1) * {}",
                            series.rows(), dimension, delay));
  Points points(series.rows() - (dimension - 1) * delay, dimension * series.cols());
  for (Index i = 0; i < points.rows(); ++i)
    for (Index k = 0; k < points.cols(); ++k)
      points(i, k) = series(i + k / series.cols() * delay, k % series.cols());
  return points;
}

double largest_coordinate(PointsView points) {
  double largest = 0;
  for (Index i = 0; i < points.rows(); ++i)
    for (Index k = 0; k < points.cols(); ++k) largest = std::max(largest, std::abs(points(i, k)));
  return largest;
}

}  // namespace ph
