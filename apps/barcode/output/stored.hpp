// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "apps/barcode/arguments/arguments.hpp"
#include "apps/barcode/job/job.hpp"
#include "apps/barcode/output/outputs.hpp"
#include "apps/common/run/session.hpp"
#include "ph/detail/io/reader.hpp"
#include "ph/detail/report/metadata.hpp"

namespace ph::barcode {

/// A hint for barcodes that are too large for the memory.
inline std::string fewer_bars() {
  return "use fewer bars, or raise " + mark(Setting::memory_limit);
}

/// Reads a stored barcode and writes what the job requests, such as a converted file, a plot or a
/// report.
/// @throws Error (usage) if a plot needs more than bars; Error like read_barcode and OutputFile.
Outcome run_stored(const Job& job, const Input& input, Outputs& outputs, app::Session& session);

/// The formats for the distances between two barcodes.
enum class DistanceFormat { text, csv, json };
/// The content of a file with the distances between two barcodes.
std::string distances_file(const std::vector<report::Distance>& distances,
                           std::span<const Barcode> barcodes,
                           const std::vector<std::string>& left_out, const Job& job,
                           DistanceFormat format);
/// The format that --output-format or the extension of -o selects. @throws Error (usage) on any
/// other format.
DistanceFormat distance_format(const Job& job);

}  // namespace ph::barcode
