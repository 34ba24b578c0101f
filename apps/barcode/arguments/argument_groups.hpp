// SPDX-License-Identifier: MIT
#pragma once
#include "apps/barcode/arguments/arguments.hpp"
#include "apps/barcode/arguments/scopes.hpp"
#include "apps/common/arguments/options.hpp"

// The options of ph-barcode by topic, a file each. `add_…` registers them, and `arguments` must
// outlive `options`. `check_…` looks at what no single one of them can see, sets what follows from
// them, and throws Error (usage).
namespace ph::barcode {

/// What of a table or a picture is read: --columns, --channel.
void add_table_options(app::Options& options, Job& job);
/// Decides what a table means where other options leave one reading only.
void check_table_arguments(Job& job);

/// How an image lies in a file without a header.
void add_raw_options(app::Options& options, Job& job);
/// Those that images and cubical complexes have.
void add_cubical_options(app::Options& options, Job& job);
/// Of both.
void check_image_arguments(Job& job);

/// Which complex is built.
void add_complex_options(app::Options& options, Job& job);
/// What is computed of it: dimensions, field, engine, representatives.
void add_homology_options(app::Options& options, Job& job);

/// Those that only Rips complexes have: collapse, samples, approximation, weights.
void add_rips_options(app::Options& options, Job& job);
/// Weights come from one place, and exclude what makes sense for plain distances only.
void check_rips_arguments(Job& job);

/// Those that only alpha complexes have.
void add_alpha_options(app::Options& options, Job& job);
void check_alpha_arguments(Job& job);

/// --part, --join and what goes with them.
void add_part_options(app::Options& options, Job& job);
void check_part_arguments(const Job& job);

}  // namespace ph::barcode
