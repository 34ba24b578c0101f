// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstdint>

#include "libph/src/io/bytes/readers.hpp"
#include "ph/detail/io/table.hpp"

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
constexpr std::string_view kToMesh = "convert it to PLY";
constexpr std::string_view kToCloud = "convert it to PLY or PCD";
constexpr std::string_view kToVolume = "convert it to NIfTI, or save the array as .npy";
constexpr std::string_view kExport = "export its clouds as PCD and its images as PNG";
constexpr std::string_view kFromPickle = "save the array with numpy.save";
constexpr std::string_view kUnpack = "unpack it first, or use gzip";

constexpr std::array kMagics{
    Magic{0, "\xFF\xD8\xFF"sv, {"a JPEG picture", kToPng}},
    Magic{8, "WEBP"sv, {"a WebP picture", kToPng}},
    Magic{0, "GIF8"sv, {"a GIF picture", kToPng}},
    Magic{0, "\0\0\0\x0CjP  "sv, {"a JPEG 2000 picture", kToPng}},
    Magic{4, "ftypavif"sv, {"an AVIF picture", kToPng}},
    Magic{4, "ftypheic"sv, {"a HEIC picture", kToPng}},
    Magic{0, "v/1\x01"sv, {"an OpenEXR picture", kToNpy}},
    Magic{0, "\x89HDF\r\n\x1A\n"sv, {"an HDF5 file", kToNpy}},
    Magic{0, "MATLAB 5.0 MAT-file"sv, {"a MATLAB file", kToNpy}},
    Magic{0, "PAR1"sv, {"a Parquet file", "write the table as CSV"}},
    Magic{0, "%PDF-"sv, {"a PDF document", kToPng}},
    Magic{0, "LASF"sv, {"a LAS point cloud", kToCloud}},
    Magic{0, "ASTM-E57"sv, {"an E57 point cloud", kToCloud}},
    Magic{0,
          "%%MatrixMarket"sv,
          {"a Matrix Market file", "write a line i j distance for each pair, counted from 0"}},
    Magic{0, "# vtk DataFile"sv, {"a VTK file", "convert it to PLY, or save the array as .npy"}},
    Magic{128, "DICM"sv, {"a DICOM image", kToVolume}},
    Magic{208, "MAP "sv, {"an MRC volume", kToVolume}},
    Magic{0, "SIMPLE  ="sv, {"a FITS image", kToNpy}},
    Magic{0, "\x89MCAP0\r\n"sv, {"an MCAP recording", kExport}},
    Magic{0, "#ROSBAG V"sv, {"a ROS bag", kExport}},
    Magic{0, "SQLite format 3\0"sv, {"an SQLite database, such as a ROS 2 bag", kExport}},
    Magic{0, "glTF"sv, {"a GLB mesh", kToMesh}},
    Magic{0, "\x80\x02"sv, {"a Python pickle", kFromPickle}},
    Magic{0, "\x80\x03"sv, {"a Python pickle", kFromPickle}},
    Magic{0, "\x80\x04\x95"sv, {"a Python pickle", kFromPickle}},
    Magic{0, "\x80\x05\x95"sv, {"a Python pickle", kFromPickle}},
    Magic{0, "\x28\xB5\x2F\xFD"sv, {"data compressed with Zstandard", kUnpack}},
    Magic{0,
          "\xFD"
          "7zXZ\0"sv,
          {"data compressed with xz", kUnpack}},
    Magic{0, "BZh"sv, {"data compressed with bzip2", kUnpack}},
};

constexpr std::size_t kProbe = 4096;
// Any text may begin with a few letters. A magic number of at most this length is therefore ignored
// if the input may be a table of numbers.
constexpr std::size_t kFewLetters = 4;

// The next line of a text, without its line end, which is removed from the text.
std::string_view take_line(std::string_view& text) {
  std::string_view line = text.substr(0, text.find('\n'));
  text.remove_prefix(std::min(line.size() + 1, text.size()));
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

// The number of words in a line, if each begins like a number; otherwise 0.
std::size_t count_numbers(std::string_view line) {
  std::size_t count = 0;
  while (true) {
    const std::size_t begin = line.find_first_not_of(" \t");
    if (begin == std::string_view::npos) return count;
    if (std::string_view("0123456789+-.").find(line[begin]) == std::string_view::npos) return 0;
    line.remove_prefix(std::min(line.find_first_of(" \t", begin), line.size()));
    ++count;
  }
}

// True if the bytes begin with two letters such as P6, then comments, then a line with two sizes.
// The letters alone are not enough, because a column of a table may have them as its name.
bool is_picture(std::string_view bytes, std::array<std::string_view, 2> letters) {
  if (bytes.size() < 3 || bytes[2] != '\n' || std::ranges::count(letters, bytes.substr(0, 2)) == 0)
    return false;
  do {
    bytes.remove_prefix(bytes.find('\n') + 1);
  } while (bytes.starts_with('#') && bytes.find('\n') != std::string_view::npos);
  const std::string_view line = bytes.substr(0, bytes.find('\n'));
  const std::size_t blank = line.find(' ');
  const auto is_size = [](std::string_view word) {
    return !word.empty() && word.find_first_not_of("0123456789") == std::string_view::npos;
  };
  return blank != std::string_view::npos && is_size(line.substr(0, blank)) &&
         is_size(line.substr(blank + 1));
}

// True if the file is an OBJ mesh, which has lines "v 1 2 3" after lines that begin with a keyword
// of OBJ.
bool is_obj(std::string_view bytes) {
  constexpr std::array<std::string_view, 6> kWords{"v ", "vn ", "vt ", "o ", "g ", "mtllib "};
  for (bool is_first = true; !bytes.empty();) {
    const std::string_view line = bytes.substr(0, bytes.find('\n'));
    bytes.remove_prefix(std::min(line.size() + 1, bytes.size()));
    if (line.empty() || line[0] == '#' || line[0] == '\r') continue;
    const bool is_known =
        std::ranges::any_of(kWords, [&](std::string_view word) { return line.starts_with(word); });
    if (is_first && !is_known) return false;
    is_first = false;
    const std::size_t number = line.find_first_not_of(' ', 2);
    if (line.starts_with("v ") && number != std::string_view::npos &&
        std::string_view("0123456789+-.").find(line[number]) != std::string_view::npos)
      return true;
  }
  return false;
}

// True if the file is a PTX scan: the numbers of columns and rows, the place and the three axes of
// the scanner, a matrix of 4 x 4, then points with an intensity and possibly a colour.
bool is_ptx(std::string_view bytes) {
  for (const std::size_t width : {1, 1, 3, 3, 3, 3, 4, 4, 4, 4})
    if (count_numbers(take_line(bytes)) != width) return false;
  const std::size_t columns = count_numbers(take_line(bytes));
  return columns == 4 || columns == 7;
}

// The kind of a text that begins with XML.
std::optional<ForeignKind> xml_kind(std::string_view bytes) {
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  if (!bytes.starts_with("<?xml") && !bytes.starts_with("<VTKFile") && !bytes.starts_with("<GIFTI"))
    return std::nullopt;
  if (bytes.find("<GIFTI") != std::string_view::npos)
    return ForeignKind{"a GIFTI surface", "convert it to PLY, and save its values as .npy"};
  if (bytes.find("<VTKFile") != std::string_view::npos)
    return ForeignKind{"a VTK file", "convert it to PLY, or save the array as .npy"};
  return ForeignKind{"an XML file", "write the numbers as text or as .npy"};
}

// True if the file is an STL mesh. A text begins with "solid" and has "facet normal" in it. A
// binary file has a header of 80 bytes, then the number of triangles.
bool is_stl(std::string_view bytes, std::size_t size) {
  if (bytes.starts_with("solid") && bytes.find("facet normal") != std::string_view::npos)
    return true;
  constexpr std::size_t header = 84, triangle = 50;
  if (bytes.size() < header || is_text(bytes)) return false;
  std::uint32_t count = 0;
  for (std::size_t k = 4; k-- > 0;)
    count = count << 8 | static_cast<unsigned char>(bytes[header - 4 + k]);
  return count > 0 && size == header + std::uint64_t{triangle} * count;
}

}  // namespace

std::optional<ForeignKind> foreign_kind(std::string_view bytes) {
  const std::size_t size = bytes.size();
  bytes = bytes.substr(0, kProbe);
  const bool may_be_numbers = is_text(bytes);
  for (const Magic& magic : kMagics) {
    if (may_be_numbers && magic.bytes.size() <= kFewLetters) continue;
    if (bytes.size() > magic.offset && bytes.substr(magic.offset).starts_with(magic.bytes))
      return magic.kind;
  }
  if (is_picture(bytes, {"P3", "P6"})) return ForeignKind{"a PPM picture", kToPng};
  if (is_picture(bytes, {"P1", "P4"})) return ForeignKind{"a PBM picture", kToPng};
  if (is_picture(bytes, {"PF", "Pf"})) return ForeignKind{"a PFM picture", kToNpy};
  if (const auto kind = xml_kind(bytes)) return kind;
  if (is_ptx(bytes)) return ForeignKind{"a PTX scan", kToCloud};
  if (is_obj(bytes)) return ForeignKind{"an OBJ mesh", kToMesh};
  if (is_stl(bytes, size)) return ForeignKind{"an STL mesh", kToMesh};
  // A bitmap has its length after the two letters, followed by four bytes of zero.
  if (bytes.starts_with("BM") && bytes.size() > 14 && bytes.substr(6, 4) == "\0\0\0\0"sv)
    return ForeignKind{"a BMP picture", kToPng};
  return std::nullopt;
}

}  // namespace ph::detail
