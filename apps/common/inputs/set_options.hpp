// SPDX-License-Identifier: MIT
#pragma once
#include <string_view>

#include "apps/common/arguments/option_scope.hpp"
#include "ph/io/read.hpp"
#include "ph/rips.hpp"

namespace ph::app {

class Options;

// The options that say how points and distances are read, in all programs that read them. Each
// `add_…` registers options in the current topic. @param to must outlive `options`.

/// Registers --symmetrise, --from-correlation and --diagonal.
/// @param matrices full distance matrices. @param distances distances of any kind.
void add_matrix_options(Options& options, const Scope& matrices, const Scope& distances,
                        ReadOptions& to);

/// Registers --columns.
void add_columns_option(Options& options, const Scope& scope, ReadOptions& to);

/// Registers --metric.
void add_metric_option(Options& options, const Scope& scope, RipsOptions& to);

/// Registers --raw-points, --raw-type, --raw-big-endian and --raw-skip.
/// @param points points without a header. @param numbers anything without a header.
/// @param usual_type the default of --raw-type in words.
void add_raw_options(Options& options, const Scope& points, const Scope& numbers,
                     std::string_view usual_type, ReadOptions& to);
/// The layout, which is added if there is none. Its type is empty until an option states it.
RawLayout& raw_layout(ReadOptions& options);
/// Settles the type of the numbers. @throws Error (usage) on a byte order for numbers of one byte.
void settle_raw(RawLayout& layout);

}  // namespace ph::app
