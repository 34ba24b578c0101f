// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <vector>

#include "barcode/parts/part_files.hpp"
#include "barcode/run.hpp"

namespace ph::barcode {

/// Computes the barcodes of the inputs that belong to one part, and writes the part. One failure
/// does not stop the others: the part records it. Precondition: arguments.part.
Outcome run_batch_part(const std::vector<std::string>& inputs, const Arguments& arguments,
                       app::Session& session);

/// Joins parts of a batch and writes one table, `input,dim,birth,death`, or one part.
/// @return the code of the first input that failed, if any did: the table is written anyway.
/// @throws Error (bad_data) naming the files, if parts do not belong together or some are missing.
Outcome join_batch_parts(const std::vector<PartFile>& files, const Job& job, app::Session& session);

}  // namespace ph::barcode
