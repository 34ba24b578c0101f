// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <string>

#include "apps/barcode/job/job.hpp"
#include "apps/common/manual/manual.hpp"

namespace ph::barcode {

/// Reads the command line, and prints nothing.
/// @return the answer to --help, --version or --formats, if one of these options was given.
/// @throws Error (usage), which names the option; Error (not_built_in).
std::optional<std::string> parse_arguments(int argc, const char* const* argv, Job& job);

/// The manual of ph-barcode.
const app::Manual& manual();
/// The manual of ph-barcode-mpi.
const app::Manual& manual_of_ranks();

/// The answer to --formats, which lists all formats that are read or written, each with an example.
std::string formats_table();

}  // namespace ph::barcode
