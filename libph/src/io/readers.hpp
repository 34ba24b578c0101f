// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <vector>

#include "ph/io/cloud.hpp"
#include "ph/io/read.hpp"

namespace ph::detail {

/// Rows of numbers of one length, as text has them.
struct TextTable {
  Points rows;
  std::vector<std::string> header;  ///< the cells of a first line without numbers, or empty
};

/// Reads a whole table. @param allow what cells may hold besides finite numbers.
TextTable read_text_table(const Input& input, Allow allow, const ReadOptions& options);

/// Takes the rows with a NaN out, or throws, as options.nan says; reports what it drops.
/// @param holes rows with a NaN are holes of a point cloud: they are left out in any case.
Points without_nan_rows(Points points, const Input& input, const ReadOptions& options, bool holes);

/// A square array as distances; see read_distances.
DistanceMatrix square_to_distances(const Image& array, const Input& input,
                                   const ReadOptions& options);

/// The magic numbers.
bool is_npy(const Input& input);
bool is_pcd(const Input& input);
bool is_ply(const Input& input);
bool is_png(const Input& input);
bool is_off(const Input& input);

/// NPY as it is: NaN and all.
Image read_npy_array(const Input& input);

/// Masks NaN (+infinity) or throws, as options.nan says; an image without voxels is an error unless
/// options.allow_empty.
Image without_nan_pixels(Image image, const Input& input, const ReadOptions& options);

/// Brings the little-endian numbers of a record to this machine's byte order.
void to_native(Cloud& cloud);

/// Says something to options.note, if it is there.
inline void note(const ReadOptions& options, std::string text) {
  if (options.note) options.note(std::move(text));
}

}  // namespace ph::detail
