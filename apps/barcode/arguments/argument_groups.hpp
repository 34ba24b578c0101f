// SPDX-License-Identifier: MIT
#pragma once
#include "apps/barcode/arguments/arguments.hpp"
#include "apps/barcode/arguments/scopes.hpp"
#include "apps/common/arguments/options.hpp"

// The options of ph-barcode, with one source file for each topic. Each `add_…` registers the
// options of a topic, where `job` must outlive `options`. Each `check_…` checks options that depend
// on one another, derives settings from them, and throws Error (usage).
namespace ph::barcode {

/// Registers the options that select the data read from a table or a picture: --columns, --delay,
/// --channel.
void add_table_options(app::Options& options, Job& job);
/// Decides how a table is read if the other options leave only one way to read it.
void check_table_arguments(Job& job);

/// Registers the options that describe an image in a file without a header: --raw-shape and others.
void add_raw_options(app::Options& options, Job& job);
/// Registers the options for images and cubical complexes.
void add_cubical_options(app::Options& options, Job& job);
/// Checks the options that describe an image without a header.
void check_image_arguments(Job& job);

/// Registers the options that select the complex.
void add_complex_options(app::Options& options, Job& job);
/// Registers the options that select the computation, which are dimensions, field, engine and
/// representatives.
void add_homology_options(app::Options& options, Job& job);

/// Registers the options that apply only to Rips complexes: collapse, samples, approximation,
/// weights.
void add_rips_options(app::Options& options, Job& job);
/// Checks that at most one option gives weights, and that no other option forbids weights.
void check_rips_arguments(Job& job);

/// Registers the options that apply only to alpha complexes.
void add_alpha_options(app::Options& options, Job& job);
void check_alpha_arguments(Job& job);

/// Registers --part, --join and the options that apply to parts.
void add_part_options(app::Options& options, Job& job);
void check_part_arguments(const Job& job);

}  // namespace ph::barcode
