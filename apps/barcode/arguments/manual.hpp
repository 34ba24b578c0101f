// SPDX-License-Identifier: MIT
#pragma once
#include <string>

#include "common/manual/manual.hpp"

namespace ph::barcode {

/// What the program says of itself beside its options.
const app::Manual& manual();
/// The same of ph-barcode-mpi.
const app::Manual& manual_of_ranks();

/// The answer to --formats: what is read and what is written, a format each, with an example.
std::string formats_table();

}  // namespace ph::barcode
