// SPDX-License-Identifier: MIT
#pragma once
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "ph/io/read.hpp"

namespace ph {

/// The input formats, in the order of the programs' --format option.
enum class Format {
  automatic,  ///< by content and extension
  points,
  distance,
  lower_distance,
  upper_distance,
  sparse,
  binary,
  dipha,
  npy,
  pgm,
  png,
  perseus,
  nifti,
  phat,
  simplices,
  off,
  ply,
  pcd,
  npz,
  xyz,
  pts,
  raw,
  grid,
};

/// What was read, whatever the format.
struct ReadResult {
  std::variant<Points, DistanceMatrix, SparseDistances, Image, SimplicesInput, BoundaryInput, Mesh>
      data;
  Format format = Format::automatic;  ///< never automatic in a result
  std::string description;            ///< "1024 points in R^3, CSV"
  std::vector<std::string> notes;     ///< what was assumed: "line 1 is a header: skipped"
  /// For Points: row i is point point_ids[i] of the input. Empty: row i is point i, none was left
  /// out.
  std::vector<Index> point_ids;
  /// For an Image: the axes that the file says close up on themselves. Empty: none.
  std::vector<bool> periodic;
};

/// One line of the table of formats: its name, what it is, and a line of it.
struct FormatInfo {
  Format format;
  std::string_view name;         ///< as in --format
  std::string_view description;  ///< "one point a line: numbers separated by blanks or commas"
  std::string_view example;      ///< "0.5 1.25 -3e-2"
  /// Null if the format is not built in.
  ReadResult (*read)(const Input&, const ReadOptions&);
};

/// All formats. Adding one is a function and a line of this table.
std::span<const FormatInfo> formats();
const FormatInfo& format_info(Format format);
/// The format of a name of --format ("lower-distance").
std::optional<Format> format_from_name(std::string_view name);

/// Decides by content first (magic numbers, shape of the first lines), then by extension. Never
/// returns Format::automatic; text of numbers without more evidence is `points`. Reads no options:
/// see read_any for text that they tell more about.
Format detect_format(const Input& input);

/// Reads any format.
/// @param path "-" is standard input. @param format Format::automatic: see detect_format.
/// @param values_path values of the cells of a boundary matrix or of the vertices of a mesh; empty:
///        none. @throws Error as the readers do; Error (not_built_in) if the format is not there;
///        Error (usage) if values are given for a format that takes none.
ReadResult read_any(const std::filesystem::path& path, Format format = Format::automatic,
                    const ReadOptions& options = {}, const std::filesystem::path& values_path = {});
ReadResult read_any(const Input& input, Format format = Format::automatic,
                    const ReadOptions& options = {}, const std::filesystem::path& values_path = {});

}  // namespace ph
