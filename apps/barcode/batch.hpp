// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <vector>

#include "apps/barcode/arguments/arguments.hpp"
#include "apps/barcode/parts/part_files.hpp"
#include "apps/barcode/run.hpp"
#include "apps/common/run/session.hpp"

namespace ph::barcode {

/// The format that --output-format or the name of the output selects. @throws Error (usage) on a
/// picture.
BarcodeFormat output_format(const Job& job, app::Session& session);

/// Runs the job for all inputs. With an output folder, an input that fails does not stop the other
/// inputs. Its error is printed to stderr, and the exit code of the first failure is returned at
/// the end.
int run_all(const Job& job, app::Session& session);

/// Computes the part that the arguments name. Precondition: `sharing.part` is set. @return the exit
/// code.
/// @throws Error.
int run_part(const Job& job, app::Session& session);

/// Joins the inputs, all of which are parts. @return the exit code. @throws Error.
int run_join(const Job& job, BarcodeFormat format, app::Session& session);

/// Computes the barcodes of the inputs that belong to one part, and writes the part. An input that
/// fails does not stop the other inputs. The part records the failure. Precondition:
/// job.sharing.part is set.
Outcome run_batch_part(const std::vector<std::string>& inputs, const Job& job,
                       app::Session& session);

/// Joins parts of a batch and writes one table, `input,dim,birth,death`, or one part.
/// @return an outcome with the exit code of the first input that failed, if any input failed. The
/// table is written in any case.
/// @throws Error (bad_data), which names the files, if parts do not belong together or some are
/// missing.
Outcome join_batch_parts(const std::vector<PartFile>& files, const Places& places,
                         app::Session& session);

/// The inputs, with each folder replaced by its files. The data file of a header that is also an
/// input is left out, with a note.
/// @throws Error (no_input) if a folder has no file of a known format.
std::vector<std::string> inputs_of_batch(const Job& job, app::Session& session);

}  // namespace ph::barcode
