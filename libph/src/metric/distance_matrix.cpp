// SPDX-License-Identifier: MIT
#include "ph/distance_matrix.hpp"

#include <fmt/format.h>

#include "ph/error.hpp"

namespace ph {

DistanceMatrix::DistanceMatrix(Index size, std::vector<double> lower, std::vector<double> births)
    : size_(size) {
  constexpr Index most = Index{1} << 31;  // with more points, the number of bytes would overflow
  if (size < 0 || size > most)            // mutant: matrix-size
    throw Error(ErrorKind::bad_data,
                fmt::format("distance matrix: found {} points, expected 0 to 2^31", size));
  const Index pairs = size > 0 ? size * (size - 1) / 2 : 0;
  if (static_cast<Index>(lower.size()) != pairs) {
    throw Error(ErrorKind::bad_data, fmt::format("distance matrix: found {} distances, expected {} "
                                                 "for {} points",
                                                 lower.size(), pairs, size));
  }
  std::size_t k = 0;
  for (Index i = 1; i < size; ++i) {
    for (Index j = 0; j < i; ++j, ++k) {
      if (!(lower[k] >= 0)) {
        throw Error(
            ErrorKind::bad_data,
            fmt::format("distance ({}, {}): found {}, expected a number >= 0", i, j, lower[k]));
      }
      lower[k] += 0.0;  // the sum turns -0.0 into +0.0
    }
  }
  numbers_ = std::make_shared<const Numbers>(Numbers{std::move(lower), std::move(births)});
  lower_ = numbers_->lower.data();
}

}  // namespace ph
