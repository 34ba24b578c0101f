// SPDX-License-Identifier: MIT
#pragma once
#include <filesystem>
#include <vector>

#include "ph/io/read.hpp"

namespace ph::detail {

/// The files whose bytes are read in addition to an input, in the order in which they are read: the
/// file that holds the numbers of an NRRD or MetaImage header, or the slices in a folder. Reads
/// only headers, each at most 1 MiB.
/// @param format the format in which the input is read. @return no files if the input has none, is
/// no file and no folder, or cannot be read; the readers report what is wrong.
std::vector<std::filesystem::path> further_files(const std::filesystem::path& path,
                                                 Format format = Format::automatic);

}  // namespace ph::detail
