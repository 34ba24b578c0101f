// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "field_access.hpp"
#include "lzf.hpp"
#include "ph/io/cloud_io.hpp"
#include "readers.hpp"

namespace ph {
namespace {

constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();

struct Header {
  Cloud cloud;  // all but the data
  std::size_t points = 0;
  std::size_t bytes = 0;   // points * stride
  std::size_t offset = 0;  // of the data in the file
  std::size_t lines = 0;   // before the data
  PcdData data = PcdData::ascii;
};

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

// Reads the header, keyword by keyword: each at most once, DATA last.
class HeaderParser {
 public:
  explicit HeaderParser(const Input& input) : input_(input), lines_(input, 0, 0), cells_(lines_) {}

  Header parse() {
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
        lines_.fail(place, {"PCD version", printable(version, 40), "0.7", {}});
      }
    } else if (key == "FIELDS" || key == "COLUMNS") {
      if (!fields.empty()) lines_.fail(place, {"PCD header", "fields again", "them once", {}});
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
      header_.cloud.fields[k].count = static_cast<std::size_t>(cells_.integer(1, kMost, "COUNT"));
    }
  }

  std::int64_t extent(const std::string& key) {
    if (!cells_.more()) lines_.fail(end_of_line(), {"no number after " + key, {}, "one", {}});
    return cells_.integer(0, kMost, key.c_str());
  }

  Header finish() {
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
      input_.fail({"PCD header", "neither WIDTH nor POINTS", "both", {}});

    if (height_ < 0) height_ = 1;
    if (width_ < 0) width_ = points_;
    const auto product =
        checked_product(static_cast<std::size_t>(width_), static_cast<std::size_t>(height_));
    const bool fits = product && *product <= static_cast<std::size_t>(kMost);
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
      if (!bytes || *bytes > static_cast<std::size_t>(kMost) - stride) {
        input_.fail({"points too large", fmt::format("COUNT {}", field.count), "less", {}});
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
  Header header_;
  std::vector<std::string> seen_;
  std::vector<std::int64_t> sizes_;
  std::vector<char> types_;
  std::int64_t width_ = -1, height_ = -1, points_ = -1;
  std::pair<std::size_t, std::size_t> points_place_{1, 1};
};

void read_binary(const Input& input, Header& header) {
  const std::size_t there = input.size() - header.offset;
  if (there != header.bytes) {
    const std::size_t complete = there / header.cloud.stride;
    input.fail_at_byte(
        there < header.bytes ? input.size() : header.offset + header.bytes,
        {there < header.bytes ? fmt::format("truncated: {} of {} points", complete, header.points)
                              : std::string("trailing data"),
         fmt::format("{} bytes of data", there),
         fmt::format("{}", header.bytes),
         {}});
  }
  input.require_memory(header.bytes);
  const auto data = input.bytes().subspan(header.offset);
  header.cloud.data.assign(data.begin(), data.end());
}

// PCL pads compressed files with zeros towards a whole page; other trailing data is an error.
void expect_padding(BinaryCursor& cursor) {
  constexpr std::size_t kLargestPage = std::size_t{1} << 16;
  if (cursor.remaining() >= kLargestPage) cursor.expect_end();
  const BinaryCursor at_padding = cursor;
  const auto padding = cursor.take(cursor.remaining(), "padding");
  if (std::any_of(padding.begin(), padding.end(), [](std::byte b) { return b != std::byte{0}; })) {
    at_padding.expect_end();
  }
}

// Takes the data of a compressed file, field after field, and puts them record after record.
class Interleaver {
 public:
  /// @param points at least 1.
  Interleaver(Cloud& cloud, std::size_t points) : cloud_(cloud), points_(points) { start_field(); }

  void take(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
      const std::size_t size = std::min(bytes.size(), points_ * width_ - position_);
      put(bytes.first(size));
      bytes = bytes.subspan(size);
      position_ += size;
      if (position_ == points_ * width_ && ++field_ < cloud_.fields.size()) start_field();
    }
  }

 private:
  void start_field() {
    width_ = cloud_.fields[field_].count * size_of(cloud_.fields[field_].type);
    position_ = 0;
  }

  // Bytes of the current field only; a piece may begin and end inside a point.
  void put(std::span<const std::byte> bytes) {
    std::byte* record =
        cloud_.data.data() + position_ / width_ * cloud_.stride + cloud_.fields[field_].offset;
    const std::byte* from = bytes.data();
    const std::byte* const end = from + bytes.size();
    if (const std::size_t inside = position_ % width_; inside != 0) {
      const std::size_t rest = std::min(width_ - inside, bytes.size());
      std::memcpy(record + inside, from, rest);
      from += rest;
      record += cloud_.stride;
    }
    const std::size_t stride = cloud_.stride;
    if (width_ == 4) {  // nearly always; a constant length is a single move
      for (; end - from >= 4; from += 4, record += stride) std::memcpy(record, from, 4);
    } else {
      const auto width = static_cast<std::ptrdiff_t>(width_);
      for (; end - from >= width; from += width, record += stride)
        std::memcpy(record, from, width_);
    }
    if (from != end) std::memcpy(record, from, static_cast<std::size_t>(end - from));
  }

  Cloud& cloud_;
  std::size_t points_;
  std::size_t field_ = 0;
  std::size_t width_ = 0;     // bytes of the field in a point
  std::size_t position_ = 0;  // bytes of the field taken so far
};

void read_compressed(const Input& input, Header& header) {
  BinaryCursor cursor(input, std::endian::little, header.offset);
  const std::size_t compressed = cursor.read<std::uint32_t>("compressed size");
  const std::size_t uncompressed = cursor.read<std::uint32_t>("uncompressed size");
  if (uncompressed != header.bytes) {
    input.fail_at_byte(header.offset + 4, {"uncompressed size",
                                           fmt::format("{}", uncompressed),
                                           fmt::format("{}: {} points of {} bytes", header.bytes,
                                                       header.points, header.cloud.stride),
                                           {}});
  }
  if (compressed > cursor.remaining()) {
    input.fail_at_byte(input.size(), {"truncated: compressed data",
                                      fmt::format("{} bytes", cursor.remaining()),
                                      fmt::format("{}", compressed),
                                      {}});
  }
  if (uncompressed / detail::kLzfMaxExpansion > compressed) {
    input.fail_at_byte(header.offset,
                       {"compressed size",
                        fmt::format("{}", compressed),
                        fmt::format("at least {}", uncompressed / detail::kLzfMaxExpansion),
                        {}});
  }
  const std::size_t start = cursor.offset();
  const auto packed = cursor.take(compressed, "compressed data");
  expect_padding(cursor);

  input.require_memory(header.bytes);
  header.cloud.data.resize(header.bytes);
  if (header.points == 0 && packed.empty()) return;
  if (header.points == 0) input.fail_at_byte(start, {"compressed data for no points", {}, {}, {}});
  Interleaver interleaver(header.cloud, header.points);
  const auto fault = detail::lzf_decompress(
      packed, header.bytes, [&](std::span<const std::byte> piece) { interleaver.take(piece); });
  if (fault.reason != nullptr) {
    input.fail_at_byte(start + fault.offset, {"damaged compressed data", fault.reason, {}, {}});
  }
}

template <class T>
T read_cell(Cells& cells) {
  if constexpr (std::is_floating_point_v<T>) {
    return cells.floating<T>(Allow::any);
  } else if constexpr (std::is_same_v<T, std::uint64_t>) {
    return cells.unsigned64("value");
  } else {
    return static_cast<T>(
        cells.integer(std::numeric_limits<T>::min(), std::numeric_limits<T>::max(), "value"));
  }
}

void read_ascii(const Input& input, Header& header) {
  Cloud& cloud = header.cloud;
  std::size_t cells_a_point = 0;
  for (const CloudField& field : cloud.fields) cells_a_point += field.count;
  const auto cells_in_all = checked_product(header.points, cells_a_point);
  // A cell takes two bytes; the last line may have no line end.
  if (!cells_in_all || *cells_in_all > (input.size() - header.offset + 1) / 2) {
    input.fail({"truncated",
                fmt::format("{} bytes of data", input.size() - header.offset),
                fmt::format("{} points of {} numbers", header.points, cells_a_point),
                {}});
  }
  input.require_memory(header.bytes);
  cloud.data.resize(header.bytes);
  TextLines lines(input, header.offset, header.lines);
  Cells cells(lines);
  std::byte* record = cloud.data.data();
  for (std::size_t i = 0; i < header.points; ++i, record += cloud.stride) {
    if (!lines.next()) {
      input.fail({fmt::format("truncated: {} of {} points", i, header.points), {}, {}, {}});
    }
    cells.start();
    for (const CloudField& field : cloud.fields) {
      std::byte* to = record + field.offset;
      detail::visit_type(field.type, [&]<class T>(T) {
        for (std::size_t k = 0; k < field.count; ++k, to += sizeof(T)) {
          if (!cells.more()) {
            lines.fail(lines.line().data() + lines.line().size(),
                       {fmt::format("point {} is incomplete", i),
                        "the end of the line",
                        fmt::format("{} numbers", cells_a_point),
                        {}});
          }
          const T value = read_cell<T>(cells);
          std::memcpy(to, &value, sizeof(T));
        }
      });
    }
    cells.expect_end("the end of the point");
  }
  if (lines.next()) {
    lines.fail(lines.line().data(), {"trailing data",
                                     "another line",
                                     fmt::format("{} points, as the header says", header.points),
                                     {}});
  }
}

}  // namespace

namespace detail {

bool is_pcd(const Input& input) {
  std::string_view text = input.text().substr(0, 4096);
  if (text.starts_with("# .PCD") || text.starts_with("#.PCD")) return true;
  while (text.starts_with('#')) text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
  return text.starts_with("VERSION ") || text.starts_with("FIELDS ");
}

}  // namespace detail

Cloud read_pcd(const Input& input, const ReadOptions& options) {
  Header header = HeaderParser(input).parse();
  switch (header.data) {
    case PcdData::ascii:
      read_ascii(input, header);
      break;
    case PcdData::binary:
      read_binary(input, header);
      break;
    case PcdData::binary_compressed:
      read_compressed(input, header);
      break;
  }
  if (header.data != PcdData::ascii) detail::to_native(header.cloud);
  if (header.points == 0 && !options.allow_empty) {
    input.fail({"no points", {}, "at least one", "--allow-empty accepts an empty cloud"});
  }
  return std::move(header.cloud);
}

}  // namespace ph
