// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "libph/src/io/bytes/field_access.hpp"
#include "libph/src/io/bytes/lzf.hpp"
#include "libph/src/io/bytes/readers.hpp"
#include "libph/src/io/clouds/pcd.hpp"
#include "ph/io/cloud.hpp"

namespace ph {
namespace {

using detail::PcdHeader;

// PCL writes files through a memory mapping, and leaves zeros after the data up to a page boundary.
void expect_padding(BinaryCursor& cursor) {
  constexpr std::size_t kLargestPage = std::size_t{1} << 16;
  if (cursor.remaining() >= kLargestPage) cursor.expect_end();  // mutant: pcd-padding
  const BinaryCursor at_padding = cursor;
  const auto padding = cursor.take(cursor.remaining(), "padding");
  if (std::any_of(padding.begin(), padding.end(), [](std::byte b) { return b != std::byte{0}; })) {
    at_padding.expect_end();
  }
}

void read_binary(const Input& input, PcdHeader& header) {
  const std::size_t there = input.size() - header.offset;
  if (there < header.bytes) {
    const std::size_t complete = there / header.cloud.stride;
    input.fail_at_byte(input.size(),
                       {fmt::format("truncated: {} of {} points", complete, header.points),
                        fmt::format("{} bytes of data", there),
                        fmt::format("{}", header.bytes),
                        {}});
  }
  BinaryCursor cursor(input, std::endian::little, header.offset);
  const auto data = cursor.take(header.bytes, "data");
  expect_padding(cursor);
  input.require_memory(header.bytes);
  header.cloud.data.assign(data.begin(), data.end());
}

// Takes the data of a compressed file field by field, and stores them record by record.
class Interleaver {
 public:
  /// @param points the number of points, at least 1.
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

  // Takes bytes of the current field. A piece may begin and end inside a point.
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
    // This is the usual case, and copying a constant length is a single instruction.
    if (width_ == 4) {
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
  std::size_t width_ = 0;     // the number of bytes of the field per point
  std::size_t position_ = 0;  // the number of bytes of the field taken so far
};

void read_compressed(const Input& input, PcdHeader& header) {
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

void read_ascii(const Input& input, PcdHeader& header) {
  Cloud& cloud = header.cloud;
  std::size_t cells_a_point = 0;
  for (const CloudField& field : cloud.fields) cells_a_point += field.count;
  const auto cells_in_all = checked_product(header.points, cells_a_point);
  // A cell takes at least two bytes. The last line may lack a line end.
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

Cloud read_pcd(const Input& input, const ReadOptions& options) {
  PcdHeader header = detail::read_pcd_header(input);
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
  detail::name_coordinates(header.cloud);
  if (header.points == 0 && !options.allow_empty) {
    input.fail(
        {"no points", {}, "at least one", mark(Setting::allow_empty) + " accepts an empty cloud"});
  }
  return std::move(header.cloud);
}

}  // namespace ph
