// SPDX-License-Identifier: MIT
// Reads NRRD, versions 1 to 5: a header of text, then the numbers, in the same file or another one.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "libph/src/io/images/volume.hpp"
#include "ph/detail/core/lower_case.hpp"

namespace ph::detail {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kNrrdMagic = "NRRD000";
constexpr std::int64_t kMostNrrdAxes = 16;
constexpr std::int64_t kNrrdMost = std::numeric_limits<std::int64_t>::max();

struct TypeName {
  std::string_view kind;  // as for element_type
  std::string_view name;
};
constexpr std::array kNrrdTypes{TypeName{"i1", "signed char"},
                                TypeName{"i1", "int8"},
                                TypeName{"i1", "int8_t"},
                                TypeName{"u1", "uchar"},
                                TypeName{"u1", "unsigned char"},
                                TypeName{"u1", "uint8"},
                                TypeName{"u1", "uint8_t"},
                                TypeName{"i2", "short"},
                                TypeName{"i2", "short int"},
                                TypeName{"i2", "signed short"},
                                TypeName{"i2", "signed short int"},
                                TypeName{"i2", "int16"},
                                TypeName{"i2", "int16_t"},
                                TypeName{"u2", "ushort"},
                                TypeName{"u2", "unsigned short"},
                                TypeName{"u2", "unsigned short int"},
                                TypeName{"u2", "uint16"},
                                TypeName{"u2", "uint16_t"},
                                TypeName{"i4", "int"},
                                TypeName{"i4", "signed int"},
                                TypeName{"i4", "int32"},
                                TypeName{"i4", "int32_t"},
                                TypeName{"u4", "uint"},
                                TypeName{"u4", "unsigned int"},
                                TypeName{"u4", "uint32"},
                                TypeName{"u4", "uint32_t"},
                                TypeName{"i8", "longlong"},
                                TypeName{"i8", "long long"},
                                TypeName{"i8", "long long int"},
                                TypeName{"i8", "signed long long"},
                                TypeName{"i8", "signed long long int"},
                                TypeName{"i8", "int64"},
                                TypeName{"i8", "int64_t"},
                                TypeName{"u8", "ulonglong"},
                                TypeName{"u8", "unsigned long long"},
                                TypeName{"u8", "unsigned long long int"},
                                TypeName{"u8", "uint64"},
                                TypeName{"u8", "uint64_t"},
                                TypeName{"f4", "float"},
                                TypeName{"f8", "double"}};

// Fields that may be written without the blank.
struct Spelling {
  std::string_view written, name;
};
constexpr std::array kNrrdSpellings{
    Spelling{"datafile", "data file"}, Spelling{"lineskip", "line skip"},
    Spelling{"byteskip", "byte skip"}, Spelling{"oldmin", "old min"},
    Spelling{"oldmax", "old max"},     Spelling{"axismins", "axis mins"},
    Spelling{"axismaxs", "axis maxs"}, Spelling{"sampleunits", "sample units"},
    Spelling{"centerings", "centers"}, Spelling{"blocksize", "block size"}};

// Fields that the reader uses, then fields that do not change the numbers or their places.
constexpr std::array kNrrdFields{"type"sv,
                                 "dimension"sv,
                                 "sizes"sv,
                                 "encoding"sv,
                                 "endian"sv,
                                 "data file"sv,
                                 "line skip"sv,
                                 "byte skip"sv,
                                 "kinds"sv,
                                 "spacings"sv,
                                 "space"sv,
                                 "space dimension"sv,
                                 "space directions"sv,
                                 "space origin"sv,
                                 "content"sv,
                                 "number"sv,
                                 "sample units"sv,
                                 "thicknesses"sv,
                                 "centers"sv,
                                 "labels"sv,
                                 "units"sv,
                                 "space units"sv,
                                 "measurement frame"sv,
                                 "min"sv,
                                 "max"sv,
                                 "block size"sv};

// The spaces whose coordinates are known, and the signs that turn them into the coordinates of
// NIfTI.
struct Space {
  std::string_view name;
  std::array<double, 3> signs;
};
constexpr std::array kNrrdSpaces{Space{"right-anterior-superior", {1, 1, 1}},
                                 Space{"ras", {1, 1, 1}},
                                 Space{"left-anterior-superior", {-1, 1, 1}},
                                 Space{"las", {-1, 1, 1}},
                                 Space{"left-posterior-superior", {-1, -1, 1}},
                                 Space{"lps", {-1, -1, 1}},
                                 Space{"scanner-xyz", {1, 1, 1}},
                                 Space{"3d-right-handed", {1, 1, 1}},
                                 Space{"3d-left-handed", {1, 1, 1}}};

// Axes whose numbers are no components of a colour, a vector or a tensor.
constexpr std::array kNrrdKinds{"domain"sv, "space"sv, "time"sv, "???"sv, "none"sv};

class Nrrd {
 public:
  Nrrd(const Input& input, const ReadOptions& options) : header_(input), options_(options) {}

  /// The name of the file of the data, if the data are not in the file of the header.
  std::optional<std::string> data_file() {
    read_fields();
    if (volume_.file == nullptr) return std::nullopt;
    return std::string(volume_.file->value);
  }

  Volume read() {
    read_fields();
    const auto axes =
        static_cast<std::size_t>(header_.integer(need("dimension"), 1, kMostNrrdAxes));
    const HeaderField& sizes = need("sizes");
    volume_.extents = header_.integers(sizes, 1, kNrrdMost);
    if (volume_.extents.size() != axes)
      header_.fail(sizes, fmt::format("{} sizes, because the dimension is {}", axes, axes));
    set_type();
    set_data();
    set_places();
    return load_volume(header_, volume_, options_);
  }

 private:
  const HeaderField* find(std::string_view name) const { return header_.find(std::string(name)); }
  const HeaderField& need(std::string_view name) const { return header_.need(std::string(name)); }

  // Reads the lines up to an empty one. Without an empty line, the file is only a header.
  void read_fields() {
    const Input& input = header_.input();
    if (!is_nrrd(input)) {
      input.fail_at_byte(0, {"not an NRRD file",
                             '"' + printable(input.text().substr(0, kNrrdMagic.size())) + '"',
                             "\"NRRD000\", then a version",
                             {}});
    }
    header_.next_line();
    const std::string_view version = header_.line().substr(kNrrdMagic.size());
    if (version.size() != 1 || version[0] < '1' || version[0] > '5')
      input.fail_at(1, kNrrdMagic.size() + 1,
                    {"NRRD version", '"' + printable(version, 20) + '"', "1 to 5", {}});
    bool has_end = false;
    while (!has_end && header_.next_line()) {
      const std::string_view line = header_.line();
      has_end = line.empty();
      if (!has_end && line[0] != '#') read_field(line);
    }
    volume_.offset = header_.offset();
    volume_.file = find("data file");
    if (volume_.file == nullptr && !has_end)
      input.fail_at_byte(input.size(), {"truncated in the NRRD header",
                                        "the end of the file",
                                        "an empty line, then the data",
                                        {}});
    if (volume_.file == nullptr) return;
    if (volume_.offset != input.size())
      input.fail_at_byte(volume_.offset,
                         {"trailing data",
                          fmt::format("{} more bytes", input.size() - volume_.offset),
                          "the end of the header, because the data are in another file",
                          {}});
    volume_.offset = 0;
    const std::string_view file = volume_.file->value;
    if (file.empty() || file == "LIST" || file.starts_with("LIST ") ||
        file.find('%') != std::string_view::npos)
      header_.fail(*volume_.file, "one file",
                   "join the files, for example with unu save -f nrrd, or save the array as .npy");
  }

  void read_field(std::string_view line) {
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos) {
      header_.input().fail_at(header_.number(), 1,
                              {"NRRD header",
                               '"' + printable(line, 40) + '"',
                               "a line FIELD: VALUE, or KEY:=VALUE, or a comment",
                               {}});
    }
    if (line.substr(colon + 1).starts_with('=')) return;  // a pair of the user
    std::string name = lower_case(line.substr(0, colon));
    for (const Spelling& spelling : kNrrdSpellings)
      if (name == spelling.written) name = spelling.name;
    header_.add(name, colon);
    if (std::ranges::count(kNrrdFields, name) == 0)
      note(options_,
           fmt::format("line {}: the field {} is not used", header_.number(), printable(name, 40)));
  }

  void set_type() {
    const HeaderField& type = need("type");
    const std::string name = lower_case(type.value);
    const auto* const known = std::ranges::find(kNrrdTypes, name, &TypeName::name);
    if (known == kNrrdTypes.end())
      header_.fail(type, "a type of integers or floats, such as uint8, short or float",
                   name == "block" ? "save the array as .npy" : "");
    volume_.kind = known->kind;
  }

  void set_data() {
    const HeaderField& encoding = need("encoding");
    const std::string name = lower_case(encoding.value);
    if (name == "raw") {
      volume_.encoding = VolumeEncoding::raw;
    } else if (name == "gzip" || name == "gz") {
      volume_.encoding = VolumeEncoding::packed;
    } else if (name == "ascii" || name == "text" || name == "txt") {
      volume_.encoding = VolumeEncoding::text;
    } else {
      header_.fail(encoding, "raw, gzip or ascii",
                   "save it again with one of these, for example with unu save -e gzip");
    }
    const HeaderField* const endian = find("endian");
    if (endian != nullptr) {
      const std::string order = lower_case(endian->value);
      if (order != "little" && order != "big") header_.fail(*endian, "little or big");
      volume_.order = order == "big" ? std::endian::big : std::endian::little;
    } else if (volume_.kind[1] != '1' && volume_.encoding != VolumeEncoding::text) {
      need("endian");
    }
    if (const HeaderField* const lines = find("line skip"))
      volume_.lines = static_cast<std::size_t>(header_.integer(*lines, 0, kNrrdMost));
    const HeaderField* const skip = find("byte skip");
    if (skip == nullptr) return;
    const std::int64_t bytes = header_.integer(*skip, -1, kNrrdMost);
    volume_.at_end = bytes < 0;
    if (volume_.at_end && volume_.encoding != VolumeEncoding::raw)
      header_.fail(*skip, "0 or more for this encoding");
    volume_.skip = volume_.at_end ? 0 : static_cast<std::size_t>(bytes);
  }

  // The vectors of the axes, one per axis. A vector without numbers stands for `none`.
  std::vector<std::vector<double>> vectors_in(const HeaderField& field) const {
    std::vector<std::vector<double>> vectors;
    std::string_view rest = field.value;
    while (!rest.empty()) {
      if (rest[0] == ' ' || rest[0] == '\t') {
        rest.remove_prefix(1);
      } else if (rest.starts_with("none")) {
        vectors.emplace_back();
        rest.remove_prefix(4);
      } else {
        const std::size_t end = rest.find(')');
        if (rest[0] != '(' || end == std::string_view::npos)
          header_.fail(field, "vectors such as (1,0,0), or none");
        std::string inner(rest.substr(1, end - 1));
        std::ranges::replace(inner, ',', ' ');
        vectors.push_back(header_.numbers(field, inner));
        rest.remove_prefix(end + 1);
      }
    }
    return vectors;
  }

  // The vectors of axes that are parallel to the axes of space. A spacing of NaN means an axis
  // without a place in space.
  std::vector<std::vector<double>> vectors_by_spacings(const HeaderField& field) const {
    const std::vector<double> spacings = header_.numbers(field, field.value);
    if (spacings.size() != volume_.extents.size())
      header_.fail(field, fmt::format("{} numbers, one for each axis", volume_.extents.size()));
    std::vector<std::vector<double>> vectors;
    std::size_t known = 0;
    for (const double spacing : spacings) {
      vectors.emplace_back();
      if (std::isnan(spacing) || known == 3) continue;
      vectors.back().resize(3);
      vectors.back()[known++] = spacing;
    }
    return vectors;
  }

  // Sets the affine map to space, and refuses axes whose numbers are components.
  void set_places() {
    const HeaderField* const directions = find("space directions");
    const HeaderField* const spacings = find("spacings");
    std::vector<std::vector<double>> vectors(volume_.extents.size());
    if (directions != nullptr) {
      vectors = vectors_in(*directions);
      if (vectors.size() != volume_.extents.size())
        header_.fail(*directions,
                     fmt::format("{} vectors, one for each axis", volume_.extents.size()));
    } else if (spacings != nullptr) {
      vectors = vectors_by_spacings(*spacings);
    }
    drop_components(vectors);
    while (!vectors.empty() && vectors.back().empty()) vectors.pop_back();
    if (vectors.empty()) return;
    const std::size_t width = vectors[0].size();
    for (const auto& vector : vectors)
      if (vector.size() != width) header_.fail(*directions, "vectors of the same length");
    std::vector<double> origin;
    if (const HeaderField* const field = find("space origin")) {
      const auto origins = vectors_in(*field);
      if (origins.size() != 1 || origins[0].size() != width)
        header_.fail(*field, fmt::format("one vector of {} numbers", width));
      origin = origins[0];
    }
    const std::array<double, 3> signs = signs_of_space();
    if (width == 2 || width == 3) volume_.affine = affine_of(vectors, origin, signs);
    if (!volume_.affine)
      note(options_, width == 2 || width == 3
                         ? std::string(kNoPlaces)
                         : fmt::format("the places of the voxels are not used, because the space "
                                       "has {} dimensions instead of 2 or 3",
                                       width));
  }

  // Refuses an axis whose numbers are the components of a colour or of a vector. Such an axis of
  // size 1 is dropped.
  void drop_components(std::vector<std::vector<double>>& vectors) {
    std::vector<std::string> kinds(volume_.extents.size());
    const HeaderField* const field = find("kinds");
    if (field != nullptr) {
      const auto words = VolumeHeader::words(*field);
      if (words.size() != kinds.size())
        header_.fail(*field, fmt::format("{} words, one for each axis", kinds.size()));
      std::ranges::transform(words, kinds.begin(), lower_case);
    }
    for (std::size_t axis = 0; axis < kinds.size();) {
      const bool is_component =
          !kinds[axis].empty() && std::ranges::count(kNrrdKinds, kinds[axis]) == 0;
      const bool has_place_later =
          std::any_of(vectors.begin() + static_cast<std::ptrdiff_t>(axis), vectors.end(),
                      [](const auto& vector) { return !vector.empty(); });
      if (!is_component && !(vectors[axis].empty() && has_place_later)) {
        ++axis;
        continue;
      }
      if (volume_.extents[axis] != 1) {
        const HeaderField* const directions = find("space directions");
        header_.fail(is_component            ? *field
                     : directions != nullptr ? *directions
                                             : need("spacings"),
                     "axes of space or time, because an image has one number per voxel",
                     fmt::format("take one component of axis {0}, for example with unu slice -a "
                                 "{0} -p 0",
                                 axis));
      }
      const auto place = static_cast<std::ptrdiff_t>(axis);
      if (kinds.size() == 1) return;
      kinds.erase(kinds.begin() + place);
      vectors.erase(vectors.begin() + place);
      volume_.extents.erase(volume_.extents.begin() + place);
    }
  }

  // The signs of the coordinates in the space of NIfTI, whose coordinates point right, forward and
  // up.
  std::array<double, 3> signs_of_space() const {
    const HeaderField* const space = find("space");
    if (space == nullptr) return {1, 1, 1};
    const std::string name = lower_case(space->value);
    const auto* const known = std::ranges::find(kNrrdSpaces, name, &Space::name);
    if (known != kNrrdSpaces.end()) return known->signs;
    note(options_, fmt::format("the space {} is not known: its coordinates are used as they are",
                               printable(space->value, 40)));
    return {1, 1, 1};
  }

  VolumeHeader header_;
  const ReadOptions& options_;
  StoredVolume volume_;
};

}  // namespace

bool is_nrrd(const Input& input) { return input.text().starts_with(kNrrdMagic); }

Volume read_nrrd(const Input& input, const ReadOptions& options) {
  return Nrrd(input, options).read();
}

std::optional<std::string> nrrd_data_file(const Input& input) {
  return Nrrd(input, {}).data_file();
}

}  // namespace ph::detail
