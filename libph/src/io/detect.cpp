// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>
#include <utility>

#include "ph/io/formats.hpp"
#include "readers.hpp"

namespace ph {
namespace {

constexpr std::size_t kProbedLines = 64;

bool starts_like_text(const Input& input) {
  const std::string_view probe = input.text().substr(0, 4096);
  return std::none_of(probe.begin(), probe.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\r' && c != '\t';
  });
}

// Formats with a magic number, and formats known by nothing but their name.
std::optional<Format> by_magic(const Input& input) {
  if (detail::is_npy(input)) return Format::npy;
  if (detail::is_png(input)) return Format::png;
  if (detail::is_pcd(input)) return Format::pcd;
  if (detail::is_ply(input)) return Format::ply;
  if (detail::is_off(input)) return Format::off;
  if (detail::is_npz(input)) return Format::npz;
  if (detail::is_dipha(input)) return Format::dipha;
  if (detail::is_pgm(input)) return Format::pgm;
  if (detail::is_nifti(input)) return Format::nifti;
  return std::nullopt;
}

std::optional<Format> by_extension(const Input& input) {
  const std::string& extension = input.extension();
  if (extension == ".phat") return Format::phat;
  if (extension == ".simplices") return Format::simplices;
  if (extension == ".sparse" || extension == ".coo") return Format::sparse;
  if (extension == ".perseus" || extension == ".cub") return Format::perseus;
  if (extension == ".dipha") return Format::dipha;
  if (extension == ".xyz" || extension == ".xyzrgb") return Format::xyz;
  if (extension == ".pts" && detail::is_counted(input)) return Format::pts;
  if (extension == ".npz") return Format::npz;
  if (extension == ".nii" || extension == ".hdr") return Format::nifti;
  // Damaged at the start: let their own readers say what is wrong.
  if (extension == ".pcd") return Format::pcd;
  if (extension == ".ply") return Format::ply;
  if (extension == ".off") return Format::off;
  if (extension == ".npy") return Format::npy;
  if (extension == ".png") return Format::png;
  if (extension == ".pgm") return Format::pgm;
  return std::nullopt;
}

// Lengths of the rows and the diagonal tell a matrix from a set of points, which cannot be ragged.
Format by_rows(const Input& input) {
  TextLines lines(input);
  Cells cells(lines);
  std::vector<std::size_t> lengths;
  bool zero_diagonal = true, first = true;
  while (lengths.size() < kProbedLines && lines.next()) {
    if (std::exchange(first, false) && !header_names(lines.line()).empty()) continue;
    if (lines.line().find(':') != std::string_view::npos) return Format::simplices;
    std::size_t length = 0;
    for (cells.start(); cells.more(); ++length) {
      const std::string_view word = cells.word();
      if (length == lengths.size()) {
        zero_diagonal = zero_diagonal && word.find_first_not_of("0.+-") == std::string_view::npos;
      }
    }
    lengths.push_back(length);
  }
  const std::size_t rows = lengths.size();
  if (rows < 3) return Format::points;
  bool rising = lengths[0] == 1, falling = true, square = zero_diagonal;
  for (std::size_t i = 0; i < rows; ++i) {
    rising = rising && lengths[i] == i + 1;
    falling = falling && lengths[i] + i == lengths[0];
    square = square && lengths[i] == lengths[0];
  }
  if (rising) return Format::lower_distance;
  if (falling) return Format::upper_distance;
  if (!square || lengths[0] < rows) return Format::points;
  std::size_t all_rows = rows;
  while (lines.next() && all_rows <= lengths[0]) ++all_rows;
  return all_rows == lengths[0] ? Format::distance : Format::points;
}

}  // namespace

Format detect_format(const Input& input) {
  if (const auto format = by_magic(input)) return *format;
  if (const auto format = by_extension(input)) return *format;
  if (!starts_like_text(input)) {
    // Bytes without a magic number: Ripser's binary has none. Anything else is told why by the
    // reader of text.
    return input.extension() == ".bin" ? Format::binary : Format::points;
  }
  return by_rows(input);
}

}  // namespace ph
