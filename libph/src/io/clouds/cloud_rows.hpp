// SPDX-License-Identifier: MIT
#pragma once
#include "io/readers.hpp"
#include "ph/io/cloud.hpp"

namespace ph::detail {

/// Where the rows of a cloud come from.
enum class RowSource { text, pts, array };

/// One point a row. Columns are named by the header, or in the order of read_xyz and read_pts.
/// Colours of an array may be numbers of 0…1.
/// @throws Error (bad_data) on fewer than three columns, a header without x, y and z, infinite
///         coordinates, and on no rows unless options.allow_empty.
Cloud cloud_of_rows(const TextTable& table, const Input& input, const ReadOptions& options,
                    RowSource source);

}  // namespace ph::detail
