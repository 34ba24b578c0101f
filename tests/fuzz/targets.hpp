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
  /// Throws Violation, or another exception, if a property does not hold.
  std::function<void(std::string_view bytes)> run;
};

/// All targets: one for each reader (see readers.hpp), and the others.
const std::vector<Target>& targets();
/// Null if no target has this name.
const Target* find_target(std::string_view name);

// Each of these targets has its own file.

/// Reads some bytes strictly and leniently. If a result can be written, writes it and reads it
/// again.
void run_reader(std::string_view reader, std::string_view bytes);
/// Unpacks a gzip file.
void run_gzip(std::string_view bytes);
/// Reads a picture with its own checksums, with corrected checksums, and as a depth image.
void run_png(std::string_view bytes);
/// Reads a stored tree with its own checksum and with a corrected checksum.
void run_tree(std::string_view bytes);
/// Takes the lines as the words of a command line.
void run_barcode_arguments(std::string_view bytes);
void run_cluster_arguments(std::string_view bytes);
void run_distance_arguments(std::string_view bytes);
void run_segment_arguments(std::string_view bytes);
void run_vectorise_arguments(std::string_view bytes);
/// The output of `--help all` of the program whose command line the target fuzzes; empty for
/// targets that fuzz something else.
std::string help_of(std::string_view target);
/// Reads the input of ph-distance --groups. The first byte is a digit, the number of barcodes. The
/// other bytes are the input.
void run_distance_groups(std::string_view bytes);
/// Reads the input of ph-vectorise --fitted, writes it and reads it again.
void run_vectorise_fit(std::string_view bytes);
/// Reads a part of an image, a part of a cloud, or a part of a batch.
void run_image_part(std::string_view bytes);
void run_cloud_part(std::string_view bytes);
void run_inputs_part(std::string_view bytes);
/// Chooses a small filtration. All engines must agree with the oracle, and representatives must be
/// valid.
void run_engines(std::string_view bytes);
/// Compares distances between small diagrams with the best of all matchings, and computes vectors
/// of the diagrams.
void run_diagrams(std::string_view bytes);
/// Writes arrays and metadata of a report page, and checks that reading gives the same data.
void run_report(std::string_view bytes);
// Only if the C interface is built. Compares calls of the C interface with calls of the C++
// library. Some calls have impossible sizes and pointers.
void run_c(std::string_view bytes);
// Only if alpha complexes are built. Chooses points with arbitrary doubles. Bars and simplices must
// have the properties of an alpha complex.
void run_alpha(std::string_view bytes);
/// Chooses points. The signs and radii of their spheres must equal the signs and radii that exact
/// integers give.
void run_alpha_signs(std::string_view bytes);

}  // namespace ph::fuzz
