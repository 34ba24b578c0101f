// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <string>
#include <vector>

#include "ph/io/cloud.hpp"
#include "ph/io/read.hpp"
#include "ph/io/write.hpp"
#include "ph/scene_tree.hpp"

namespace ph::fuzz {

/// The result of a reader, whatever its type, as rows of numbers. Two readings are compared bit by
/// bit, and the reading of a prefix is compared row by row with that of the whole.
struct Content {
  std::string head;  ///< data outside rows: sizes, names
  std::vector<double> numbers;
  std::vector<std::size_t> ends;  ///< of each row, in `numbers`

  std::size_t rows() const { return ends.size(); }
  std::span<const double> row(std::size_t i) const {
    const std::size_t begin = i == 0 ? 0 : ends[i - 1];
    return std::span(numbers).subspan(begin, ends[i] - begin);
  }
  void end_row() { ends.push_back(numbers.size()); }
  template <class Numbers>
  void add(const Numbers& row) {
    for (const auto number : row) numbers.push_back(static_cast<double>(number));
  }

  /// Bit by bit: a NaN equals itself, zeros of different signs differ.
  friend bool operator==(const Content& a, const Content& b);
};

// Each function first checks the promises of its type. Throws Violation if a promise is broken.
Content content_of(const Points& points);             ///< a point a row, all finite
Content content_of(const DistanceMatrix& distances);  ///< rows of the lower triangle
Content content_of(const SparseDistances& sparse);    ///< u v d a row, ascending
Content content_of(const Image& image);               ///< one row, in C order
Content content_of(const PerseusImage& perseus);      ///< grid coordinates and value, finite ones
Content content_of(const SimplicesInput& simplices);  ///< vertices and value a row
Content content_of(const BoundaryInput& boundary);    ///< dimension and facets a row, then values
Content content_of(const Mesh& mesh);                 ///< vertices, then faces
Content content_of(const Cloud& cloud);               ///< a point a row, its fields byte by byte
Content content_of(const Raster& raster);             ///< a row of pixels a row
Content content_of(const Barcode& barcode);           ///< a bar a row, its cells behind it
Content content_of(const segment::SceneTree& scene);  ///< its bytes, the labels of its cut behind
Content content_of(const ReadResult& result);
Content content_of(const std::vector<double>& values);  ///< one a row, none NaN

}  // namespace ph::fuzz
