// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>

#include "libph/src/io/bytes/readers.hpp"
#include "ph/detail/io/table.hpp"
#include "ph/io/read.hpp"

namespace ph {
namespace {

// Finds the format by its magic number.
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
  // Files with these extensions must begin with a magic number. If it is missing, the start of the
  // file is damaged, and the reader of the format will report this.
  if (extension == ".pcd") return Format::pcd;
  if (extension == ".ply") return Format::ply;
  if (extension == ".off") return Format::off;
  if (extension == ".npy") return Format::npy;
  if (extension == ".png") return Format::png;
  if (extension == ".pgm") return Format::pgm;
  return std::nullopt;
}

}  // namespace

namespace detail {

bool is_text(std::string_view bytes) {
  bytes = bytes.substr(0, 4096);
  return std::ranges::all_of(bytes, [](char c) {
    return c == '\n' || c == '\r' || c == '\t' || static_cast<unsigned char>(c) >= 0x20;
  });
}

std::optional<Format> format_by_content(const Input& input) {
  if (const auto format = by_magic(input)) return *format;
  if (const auto format = by_extension(input)) return *format;
  if (is_text(input.text())) return std::nullopt;
  // Bytes without a magic number may be in Ripser's binary format. For any other bytes, the reader
  // of text reports the problem.
  return input.extension() == ".bin" ? Format::binary : Format::points;
}

}  // namespace detail

Format detect_format(const Input& input) {
  const auto format = detail::format_by_content(input);
  return format ? *format : detail::guess_text(input, {}).format;
}

}  // namespace ph
