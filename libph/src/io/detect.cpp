// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstdint>
#include <string>

#include "libph/src/io/bytes/readers.hpp"
#include "libph/src/io/bytes/utf8.hpp"
#include "libph/src/io/clouds/cloud_rows.hpp"
#include "ph/detail/io/table.hpp"
#include "ph/io/read.hpp"

namespace ph {
namespace {

struct Magic {
  Format format;
  bool (*is_at_start)(const Input&);
};
constexpr std::array kMagics{Magic{Format::npy, &detail::is_npy},
                             Magic{Format::png, &detail::is_png},
                             Magic{Format::pcd, &detail::is_pcd},
                             Magic{Format::ply, &detail::is_ply},
                             Magic{Format::off, &detail::is_off},
                             Magic{Format::npz, &detail::is_npz},
                             Magic{Format::dipha, &detail::is_dipha},
                             Magic{Format::pgm, &detail::is_pgm},
                             Magic{Format::nifti, &detail::is_nifti},
                             Magic{Format::nrrd, &detail::is_nrrd},
                             Magic{Format::metaimage, &detail::is_meta_image},
                             Magic{Format::vti, &detail::is_vti},
                             Magic{Format::tiff, &detail::is_tiff}};

// Finds the format by its magic number.
std::optional<Format> by_magic(const Input& input) {
  const auto* const found =
      std::ranges::find_if(kMagics, [&](const Magic& magic) { return magic.is_at_start(input); });
  return found == kMagics.end() ? std::nullopt : std::optional(found->format);
}

// True if the magic number is there. Blanks and comments may precede the first word of a text: a
// start of blanks and comments only leaves the question open.
bool may_have(const Magic& magic, const Input& start) {
  if (magic.is_at_start(start)) return true;
  if (magic.format != Format::ply && magic.format != Format::off) return false;
  TextLines lines(start, 0, 0);
  if (!lines.next()) return true;
  const std::string first =
      std::string(lines.line().substr(0, lines.line().find_first_of(" \t"))) + '\n';
  return magic.is_at_start(Input::view(first, {}));
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
  if (extension == ".nrrd" || extension == ".nhdr") return Format::nrrd;
  if (extension == ".mha" || extension == ".mhd") return Format::metaimage;
  if (extension == ".vti") return Format::vti;
  // Files with these extensions must begin with a magic number. If it is missing, the start of the
  // file is damaged, and the reader of the format will report this.
  if (extension == ".pcd") return Format::pcd;
  if (extension == ".ply") return Format::ply;
  if (extension == ".off") return Format::off;
  if (extension == ".npy") return Format::npy;
  if (extension == ".png") return Format::png;
  if (extension == ".pgm") return Format::pgm;
  if (extension == ".tif" || extension == ".tiff") return Format::tiff;
  return std::nullopt;
}

}  // namespace

namespace detail {

bool is_text(std::string_view bytes) {
  bytes = bytes.substr(0, 4096);
  const bool has_controls = std::ranges::any_of(bytes, [](char c) {
    return c != '\n' && c != '\r' && c != '\t' && static_cast<unsigned char>(c) < 0x20;
  });
  return !has_controls && first_of_many_foreign_bytes(bytes) == std::string_view::npos;
}

std::optional<Format> format_by_content(const Input& input) {
  if (const auto format = by_magic(input)) return *format;
  if (const auto format = by_extension(input)) return *format;
  if (is_molecule(input)) return Format::xyz;
  if (is_text(input.text())) return std::nullopt;
  // Bytes without a magic number may be in Ripser's binary format. For any other bytes, the reader
  // of text reports the problem.
  return input.extension() == ".bin" ? Format::binary : Format::points;
}

Input::StartCheck start_check() {
  return [](const Input& start) {
    if (!by_magic(start)) TextLines{start};  // refuses bytes that are not text
  };
}

Input::StartCheck start_check(Format format) {
  if (format == Format::binary || format == Format::raw || format == Format::phat)
    return [](const Input&) {};
  const auto* const magic = std::ranges::find(kMagics, format, &Magic::format);
  if (magic != kMagics.end())
    return [magic](const Input& start) {
      // The reader says what is there instead of the magic number.
      if (!may_have(*magic, start)) format_info(magic->format).read(start, {});
    };
  if (format != Format::automatic) return [](const Input& start) { TextLines{start}; };
  return [](const Input& start) {
    const std::optional<Format> known = format_by_content(start);
    if (known == Format::points) refuse_bytes(start, way_to_raw());
    if (!known || known == Format::points) return;
    const Input::StartCheck check = start_check(*known);
    check(start);
  };
}

}  // namespace detail

Format detect_format(const Input& input) {
  const auto format = detail::format_by_content(input);
  return format ? *format : detail::guess_text(input, {}).format;
}

}  // namespace ph
