// SPDX-License-Identifier: MIT
#pragma once
#include "libph/src/io/bytes/readers.hpp"
#include "ph/io/cloud.hpp"

namespace ph::detail {

/// The source of a cloud's rows.
enum class RowSource { text, pts, array };

/// Makes a cloud with one point per row. The header names the columns. Without a header, the
/// columns have the order of read_xyz or read_pts. The colours of an array may be numbers from 0 to
/// 1.
/// @throws Error (bad_data) on fewer than three columns, on a header without x, y and z, on
///         infinite coordinates, and on an input without rows unless options.allow_empty.
Cloud cloud_of_rows(const TextTable& table, const Input& input, const ReadOptions& options,
                    RowSource source);

/// True for a molecule as programs for chemistry write it: the number of atoms, a line of any text,
/// then a line for each atom, with its element and its place.
bool is_molecule(const Input& input);
/// Reads the places of the atoms, and notes that the rest is left out. Precondition: is_molecule.
/// @throws Error (bad_data) if there are more or fewer atoms than the first line says, or if the
///         second line states another order of columns, as extended XYZ may.
Cloud read_molecule(const Input& input, const ReadOptions& options);

}  // namespace ph::detail
