// SPDX-License-Identifier: MIT
#include <array>

#include "table.hpp"

namespace ph::detail {
namespace {

using namespace std::string_view_literals;

struct Magic {
  std::size_t offset;
  std::string_view bytes;
  ForeignKind kind;
};

constexpr std::string_view kToPng = "convert it to PNG";
constexpr std::string_view kToNpy = "save the array as .npy";
constexpr std::string_view kUnpack = "unpack it first, or use gzip";

constexpr std::array kMagics{
    Magic{0, "\xFF\xD8\xFF"sv, {"a JPEG picture", kToPng}},
    Magic{0, "II*\0"sv, {"a TIFF picture", "convert it to PNG, or save the array as .npy"}},
    Magic{0, "MM\0*"sv, {"a TIFF picture", "convert it to PNG, or save the array as .npy"}},
    Magic{0, "II+\0"sv, {"a BigTIFF picture", kToNpy}},
    Magic{0, "MM\0+"sv, {"a BigTIFF picture", kToNpy}},
    Magic{8, "WEBP"sv, {"a WebP picture", kToPng}},
    Magic{0, "GIF8"sv, {"a GIF picture", kToPng}},
    Magic{0, "\0\0\0\x0CjP  "sv, {"a JPEG 2000 picture", kToPng}},
    Magic{4, "ftypavif"sv, {"an AVIF picture", kToPng}},
    Magic{4, "ftypheic"sv, {"a HEIC picture", kToPng}},
    Magic{0, "v/1\x01"sv, {"an OpenEXR picture", kToNpy}},
    Magic{0, "\x89HDF\r\n\x1A\n"sv, {"an HDF5 file", kToNpy}},
    Magic{0, "MATLAB 5.0 MAT-file"sv, {"a MATLAB file", kToNpy}},
    Magic{0, "PAR1"sv, {"a Parquet file", "write the table as CSV"}},
    Magic{0, "P6\n"sv, {"a PPM picture", kToPng}},
    Magic{0, "P3\n"sv, {"a PPM picture", kToPng}},
    Magic{0, "%PDF-"sv, {"a PDF document", kToPng}},
    Magic{0, "LASF"sv, {"a LAS point cloud", "convert it to PLY or PCD"}},
    Magic{0, "ASTM-E57"sv, {"an E57 point cloud", "convert it to PLY or PCD"}},
    Magic{0, "# vtk DataFile"sv, {"a VTK file", "convert it to PLY, or save the array as .npy"}},
    Magic{0, "\x28\xB5\x2F\xFD"sv, {"data compressed with Zstandard", kUnpack}},
    Magic{0,
          "\xFD"
          "7zXZ\0"sv,
          {"data compressed with xz", kUnpack}},
    Magic{0, "BZh"sv, {"data compressed with bzip2", kUnpack}},
};

}  // namespace

std::optional<ForeignKind> foreign_kind(std::string_view bytes) {
  for (const Magic& magic : kMagics)
    if (bytes.size() > magic.offset && bytes.substr(magic.offset).starts_with(magic.bytes))
      return magic.kind;
  // A bitmap has its own length behind its two letters.
  if (bytes.starts_with("BM") && bytes.size() > 14 && bytes.substr(6, 4) == "\0\0\0\0"sv)
    return ForeignKind{"a BMP picture", kToPng};
  return std::nullopt;
}

}  // namespace ph::detail
