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

/// The result of any reader, as rows of numbers. Two results for the same bytes are compared bit
/// for bit. The result for a prefix is compared with the rows of the whole file.
struct Content {
  std::string head;  ///< data outside the rows: sizes, names
  std::vector<double> numbers;
  std::vector<std::size_t> ends;  ///< the end of each row in `numbers`

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

  /// Compares bit for bit: a NaN equals itself, and zeros with different signs differ.
  friend bool operator==(const Content& a, const Content& b);
};

// Each function first checks the promises of its type, and throws Violation if one of them is
// broken.
Content content_of(const Points& points);             ///< one point per row, all finite
Content content_of(const DistanceMatrix& distances);  ///< the rows of the lower triangle
Content content_of(const SparseDistances& sparse);    ///< u v d per row, ascending
Content content_of(const Image& image);               ///< one row, in C order
/// Grid coordinates and values of the cells with finite values.
Content content_of(const PerseusImage& perseus);
Content content_of(const SimplicesInput& simplices);  ///< vertices and value per row
Content content_of(const BoundaryInput& boundary);    ///< dimension and facets per row, then values
Content content_of(const Mesh& mesh);                 ///< vertices, then faces
/// One point per row, its fields byte by byte.
Content content_of(const Cloud& cloud);
Content content_of(const Raster& raster);             ///< one row of pixels per row
Content content_of(const Barcode& barcode);           ///< one bar per row, followed by its cells
Content content_of(const segment::SceneTree& scene);  ///< its bytes, then the labels of its cut
Content content_of(const ReadResult& result);
Content content_of(const std::vector<double>& values);  ///< one number per row, none NaN

}  // namespace ph::fuzz
