// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "libph/src/io/bytes/readers.hpp"
#include "libph/src/io/clouds/pcd.hpp"

namespace ph::detail {
namespace {

constexpr std::int64_t kMostRecords = std::numeric_limits<std::int64_t>::max();
constexpr std::size_t kMostRecordsPointBytes = std::size_t{1} << 20;

std::optional<FieldType> field_type(char type, std::int64_t size) {
  constexpr std::array kUnsigned{FieldType::uint8, FieldType::uint16, FieldType::uint32,
                                 FieldType::uint64};
  constexpr std::array kSigned{FieldType::int8, FieldType::int16, FieldType::int32,
                               FieldType::int64};
  const std::size_t log = size == 1 ? 0 : size == 2 ? 1 : size == 4 ? 2 : size == 8 ? 3 : 4;
  if (log == 4) return std::nullopt;
  if (type == 'U') return kUnsigned[log];
  if (type == 'I') return kSigned[log];
  if (type == 'F' && log >= 2) return log == 2 ? FieldType::float32 : FieldType::float64;
  return std::nullopt;
}

// Reads the header keyword by keyword. Each keyword occurs at most once, and DATA comes last.
class PcdHeaderParser {
 public:
  explicit PcdHeaderParser(const Input& input)
      : input_(input), lines_(input, 0, 0), cells_(lines_) {}

  PcdHeader parse() {
    while (true) {
      if (!lines_.next()) {
        input_.fail({"truncated PCD header", "the end of the file", "a line DATA", {}});
      }
      cells_ = Cells(lines_);
      cells_.start();
      const char* place = cells_.place();
      const std::string key(cells_.word());
      if (std::find(seen_.begin(), seen_.end(), key) != seen_.end()) {
        lines_.fail(place, {"PCD header", "a second " + key, "each keyword once", {}});
      }
      seen_.push_back(key);
      if (key == "DATA") break;
      parse_line(key, place);
      cells_.expect_end("the end of the line " + key);
    }
    return finish();
  }

 private:
  const char* end_of_line() const { return lines_.line().data() + lines_.line().size(); }

  void need_cell(const std::string& key) {
    if (!cells_.more()) {
      lines_.fail(end_of_line(), {"line " + key + " too short",
                                  "the end of the line",
                                  fmt::format("{} cells", header_.cloud.fields.size()),
                                  {}});
    }
  }

  void parse_line(const std::string& key, const char* place) {
    auto& fields = header_.cloud.fields;
    if (key == "VERSION") {
      const std::string_view version = cells_.more() ? cells_.word() : std::string_view();
      if (std::string_view(".7 0.7 .6 0.6 .5 0.5").find(version) == std::string_view::npos ||
          version.size() < 2) {
        lines_.fail(place, {"PCD version", printable(version, 40), "0.7, 0.6 or 0.5", {}});
      }
    } else if (key == "FIELDS" || key == "COLUMNS") {
      if (!fields.empty()) lines_.fail(place, {"PCD header", "a second list of fields", "one", {}});
      while (cells_.more()) fields.push_back({std::string(cells_.word())});
      sizes_.assign(fields.size(), 4);
      types_.assign(fields.size(), 'F');
      check_names(place);
    } else if (key == "SIZE" || key == "TYPE" || key == "COUNT") {
      if (fields.empty())
        lines_.fail(place, {"PCD header", key + " first", "FIELDS before it", {}});
      for (std::size_t k = 0; k < fields.size(); ++k) {
        need_cell(key);
        parse_cell(key, k);
      }
    } else if (key == "WIDTH") {
      width_ = extent(key);
    } else if (key == "HEIGHT") {
      height_ = extent(key);
    } else if (key == "POINTS") {
      points_place_ = {lines_.number(), lines_.column(place)};
      points_ = extent(key);
    } else if (key == "VIEWPOINT") {
      for (double& number : header_.cloud.viewpoint) {
        if (!cells_.more()) {
          lines_.fail(end_of_line(),
                      {"line VIEWPOINT too short", "the end of the line", "7 numbers", {}});
        }
        number = cells_.number();
      }
    } else {
      lines_.fail(place, {"PCD header",
                          printable(key, 40),
                          "VERSION, FIELDS, SIZE, TYPE, COUNT, WIDTH, HEIGHT, VIEWPOINT, POINTS or "
                          "DATA",
                          {}});
    }
  }

  void check_names(const char* place) {
    const auto& fields = header_.cloud.fields;
    std::vector<std::string_view> names;
    for (const CloudField& field : fields) {
      if (field.name != "_") names.push_back(field.name);  // "_" is padding
    }
    std::sort(names.begin(), names.end());
    const auto twice = std::adjacent_find(names.begin(), names.end());
    if (twice != names.end()) {
      lines_.fail(place, {"field named twice", printable(*twice, 40), "different names", {}});
    }
    if (fields.empty()) lines_.fail(place, {"no fields", {}, "names", {}});
  }

  void parse_cell(const std::string& key, std::size_t k) {
    const char* place = cells_.place();
    if (key == "SIZE") {
      sizes_[k] = cells_.integer(1, 8, "SIZE");
      if (sizes_[k] == 3 || (sizes_[k] > 4 && sizes_[k] != 8)) {
        lines_.fail(place, {"SIZE", fmt::format("{}", sizes_[k]), "1, 2, 4 or 8", {}});
      }
    } else if (key == "TYPE") {
      const std::string_view type = cells_.word();
      if (type != "F" && type != "U" && type != "I") {
        lines_.fail(place, {"TYPE", printable(type, 40), "F, U or I", {}});
      }
      types_[k] = type[0];
    } else {
      header_.cloud.fields[k].count =
          static_cast<std::size_t>(cells_.integer(1, kMostRecords, "COUNT"));
    }
  }

  std::int64_t extent(const std::string& key) {
    if (!cells_.more()) lines_.fail(end_of_line(), {"no number after " + key, {}, "one", {}});
    return cells_.integer(0, kMostRecords, key.c_str());
  }

  PcdHeader finish() {
    Cloud& cloud = header_.cloud;
    const std::string_view data = cells_.more() ? cells_.word() : std::string_view();
    if (data == "ascii") {
      header_.data = PcdData::ascii;
    } else if (data == "binary") {
      header_.data = PcdData::binary;
    } else if (data == "binary_compressed") {
      header_.data = PcdData::binary_compressed;
    } else {
      lines_.fail(lines_.line().data(),
                  {"DATA", printable(data, 40), "ascii, binary or binary_compressed", {}});
    }
    header_.offset = lines_.offset();
    header_.lines = lines_.number();
    if (cloud.fields.empty()) input_.fail({"PCD header", "no FIELDS", "them before DATA", {}});
    if (width_ < 0 && points_ < 0)
      input_.fail({"PCD header", "neither WIDTH nor POINTS", "at least one of them", {}});

    if (height_ < 0) height_ = 1;
    if (width_ < 0) width_ = points_;
    const auto product =
        checked_product(static_cast<std::size_t>(width_), static_cast<std::size_t>(height_));
    const bool fits = product && *product <= static_cast<std::size_t>(kMostRecords);
    if (!fits || (points_ >= 0 && *product != static_cast<std::size_t>(points_))) {
      input_.fail_at(points_place_.first, points_place_.second,
                     {"POINTS is not WIDTH x HEIGHT",
                      points_ < 0 ? "" : fmt::format("{}", points_),
                      fmt::format("{} x {}", width_, height_),
                      {}});
    }
    header_.points = *product;
    cloud.width = width_;
    cloud.height = height_;

    std::size_t stride = 0;
    for (std::size_t k = 0; k < cloud.fields.size(); ++k) {
      CloudField& field = cloud.fields[k];
      const auto type = field_type(types_[k], sizes_[k]);
      if (!type) {
        input_.fail({fmt::format("field {}", printable(field.name, 40)),
                     fmt::format("TYPE {} of SIZE {}", types_[k], sizes_[k]),
                     "F of 4 or 8, U or I of 1, 2, 4 or 8",
                     {}});
      }
      field.type = *type;
      field.offset = stride;
      const auto bytes = checked_product(field.count, size_of(*type));
      if (!bytes || *bytes > kMostRecordsPointBytes - stride) {
        input_.fail({"points too large",
                     fmt::format("COUNT {}", field.count),
                     fmt::format("at most {} bytes per point", kMostRecordsPointBytes),
                     {}});
      }
      stride += *bytes;
    }
    cloud.stride = stride;
    const auto bytes = checked_product(header_.points, stride);
    if (!bytes) {
      input_.fail({"truncated: the header does not fit the file",
                   fmt::format("{} points of {} bytes", header_.points, stride),
                   fmt::format("at most {} bytes", input_.size() - header_.offset),
                   {}});
    }
    header_.bytes = *bytes;
    return std::move(header_);
  }

  const Input& input_;
  TextLines lines_;
  Cells cells_;
  PcdHeader header_;
  std::vector<std::string> seen_;
  std::vector<std::int64_t> sizes_;
  std::vector<char> types_;
  std::int64_t width_ = -1, height_ = -1, points_ = -1;
  std::pair<std::size_t, std::size_t> points_place_{1, 1};
};

}  // namespace

bool is_pcd(const Input& input) {
  std::string_view text = input.text().substr(0, 4096);
  if (text.starts_with("# .PCD") || text.starts_with("#.PCD")) return true;
  while (text.starts_with('#')) text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
  return text.starts_with("VERSION ") || text.starts_with("FIELDS ");
}

PcdHeader read_pcd_header(const Input& input) { return PcdHeaderParser(input).parse(); }

}  // namespace ph::detail
