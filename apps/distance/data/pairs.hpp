// SPDX-License-Identifier: MIT
#pragma once
#include <memory_resource>
#include <utility>
#include <vector>

#include "apps/common/distances/distance_choice.hpp"
#include "ph/distance_matrix.hpp"

namespace ph::distance_program {

/// The distance between each pair of barcodes, for each of several dimensions.
class PairDistances {
 public:
  /// @param count the number of barcodes, at least 2.
  PairDistances(std::size_t count, std::vector<int> dims, std::pmr::memory_resource* memory)
      : count_(count), dims_(std::move(dims)), bounds_(memory) {
    bounds_.resize(dims_.size() * pairs());
  }

  std::size_t count() const { return count_; }
  const std::vector<int>& dims() const { return dims_; }
  std::size_t pairs() const { return count_ * (count_ - 1) / 2; }
  /// The distance between the barcodes a and b, where b < a. @param dim the index of the dimension
  /// in dims().
  DistanceBounds& at(std::size_t dim, std::size_t a, std::size_t b) {
    return bounds_[dim * pairs() + a * (a - 1) / 2 + b];
  }
  const DistanceBounds& at(std::size_t dim, std::size_t a, std::size_t b) const {
    return bounds_[dim * pairs() + a * (a - 1) / 2 + b];
  }
  /// The values of one dimension.
  DistanceMatrix matrix(std::size_t dim) const;

 private:
  std::size_t count_;
  std::vector<int> dims_;
  // Sorted by dimension, then by row of the lower triangle.
  std::pmr::vector<DistanceBounds> bounds_;
};

/// Computes the distances of all pairs. Threads share the pairs, and pairs with the most bars come
/// first. The result does not depend on the number of threads.
/// @throws Error like the functions of ph/distances.hpp.
PairDistances distances_of(const std::vector<Barcode>& barcodes, std::vector<int> dims,
                           const app::DistanceChoice& choice, const RunContext& context);

}  // namespace ph::distance_program
