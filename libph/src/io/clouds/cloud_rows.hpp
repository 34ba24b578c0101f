// SPDX-License-Identifier: MIT
#pragma once
#include "libph/src/io/bytes/readers.hpp"
#include "ph/io/cloud.hpp"

namespace ph::detail {

/// The source of a cloud's rows.
enum class RowSource { text, pts, array };

/// One point per row. Columns are named by the header, or in the order of read_xyz and read_pts.
/// Colours of an array may be numbers of 0…1.
/// @throws Error (bad_data) on fewer than three columns, on a header without x, y and z, on
///         infinite coordinates, and on an input without rows unless options.allow_empty.
Cloud cloud_of_rows(const TextTable& table, const Input& input, const ReadOptions& options,
                    RowSource source);

}  // namespace ph::detail
