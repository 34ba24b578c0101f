// SPDX-License-Identifier: MIT
#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace ph::fuzz {

/// The targets that libFuzzer and the replay run on any bytes.
struct Target {
  std::string name;
  /// Throws Violation, or anything else, if a property does not hold.
  std::function<void(std::string_view bytes)> run;
};

/// All of them: a target for each reader (see readers.hpp), and the others.
const std::vector<Target>& targets();
/// Null if none has this name.
const Target* find_target(std::string_view name);

// Each target is in a separate file.

/// Reads some bytes, strictly and not; what can be written is written and read again.
void run_reader(std::string_view reader, std::string_view bytes);
/// Unpacks.
void run_gzip(std::string_view bytes);
/// A picture, unchanged and with corrected checksums, and as a depth image.
void run_png(std::string_view bytes);
/// A stored tree, unchanged and with a corrected checksum.
void run_tree(std::string_view bytes);
/// The lines are the words of a command line.
void run_barcode_arguments(std::string_view bytes);
void run_distance_arguments(std::string_view bytes);
void run_segment_arguments(std::string_view bytes);
void run_vectorise_arguments(std::string_view bytes);
/// What the program of such a target answers to `--help all`; empty of all other targets.
std::string help_of(std::string_view target);
/// The input of ph-distance --groups, after a digit: the number of barcodes.
void run_distance_groups(std::string_view bytes);
/// The input of ph-vectorise --fitted; it is written and read again.
void run_vectorise_fit(std::string_view bytes);
/// Parts of an image, of a cloud, or of several inputs.
void run_image_part(std::string_view bytes);
void run_cloud_part(std::string_view bytes);
void run_inputs_part(std::string_view bytes);
/// Chooses a small filtration; all engines must agree with the oracle, and representatives must be
/// valid.
void run_engines(std::string_view bytes);
/// Distances of small diagrams beside all matchings; vectors of them.
void run_diagrams(std::string_view bytes);
/// Arrays and metadata of a report's page: written data must read back equal.
void run_report(std::string_view bytes);
// If there is a C interface:
/// Calls beside the same calls of the C++ library; some have sizes and pointers that no input has.
void run_c(std::string_view bytes);
// If there are alpha complexes:
/// Chooses points, of any doubles; bars and simplices must have the properties of an alpha complex.
void run_alpha(std::string_view bytes);
/// Chooses points; the signs and radii of their spheres must be those of exact numbers.
void run_alpha_signs(std::string_view bytes);

}  // namespace ph::fuzz
