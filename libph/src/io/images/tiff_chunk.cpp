// SPDX-License-Identifier: MIT
// Decodes the strips and tiles of a TIFF page.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "libph/src/io/bytes/unpack.hpp"
#include "libph/src/io/images/tiff.hpp"

namespace ph::detail {
namespace {

// Decompresses PackBits. @return the number of bytes written. `more` becomes true if the data
// continue after the last byte of `to`.
std::size_t unpack_bits(std::span<const std::byte> from, std::span<std::byte> to, bool& more) {
  std::size_t done = 0, at = 0;
  while (at < from.size() && done < to.size()) {
    const auto code = static_cast<std::int8_t>(from[at++]);
    if (code == -128) continue;
    const auto count = static_cast<std::size_t>(code >= 0 ? code + 1 : 1 - code);
    const std::size_t kept = std::min(count, to.size() - done);
    more = more || kept < count;
    if (code >= 0) {
      const std::size_t there = std::min(kept, from.size() - at);
      std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(at), there,
                  to.begin() + static_cast<std::ptrdiff_t>(done));
      done += there;
      if (there < kept) break;
      at += count;
    } else {
      if (at == from.size()) break;
      std::fill_n(to.begin() + static_cast<std::ptrdiff_t>(done), kept, from[at++]);
      done += kept;
    }
  }
  more = more || at < from.size();
  return done;
}

// Adds to each number the number of the pixel before.
template <class T>
void add_up(std::span<std::byte> row, std::size_t samples) {
  const std::size_t count = row.size() / sizeof(T);
  for (std::size_t k = samples; k < count; ++k) {
    T before, number;
    std::memcpy(&before, row.data() + (k - samples) * sizeof(T), sizeof(T));
    std::memcpy(&number, row.data() + k * sizeof(T), sizeof(T));
    number = static_cast<T>(number + before);
    std::memcpy(row.data() + k * sizeof(T), &number, sizeof(T));
  }
}

// Restores floats whose bytes are stored in planes, the plane of the highest bytes first, as
// differences (predictor 3). @param each the size of a number.
void add_up_planes(std::span<std::byte> row, std::size_t samples, std::size_t each,
                   std::vector<std::byte>& planes) {
  add_up<std::uint8_t>(row, samples);
  planes.assign(row.begin(), row.end());
  const std::size_t count = row.size() / each;
  for (std::size_t k = 0; k < count; ++k) {
    for (std::size_t b = 0; b < each; ++b) {
      const std::size_t place = std::endian::native == std::endian::little ? each - 1 - b : b;
      row[k * each + place] = planes[b * count + k];
    }
  }
}

void to_native_order(std::span<std::byte> bytes, std::size_t each) {
  for (std::size_t at = 0; at + each <= bytes.size(); at += each)
    std::reverse(bytes.data() + at, bytes.data() + at + each);
}

}  // namespace

bool decode_tiff_chunk(const Input& input, const TiffPage& page, std::size_t chunk,
                       std::span<std::byte> to) {
  const std::size_t at = page.offsets.number(input, chunk);
  const std::span<const std::byte> from =
      input.bytes().subspan(at, page.sizes.number(input, chunk));
  const auto fail = [&](std::string_view what, const std::string& found,
                        const std::string& expected) {
    input.fail_at_byte(at, {fmt::format("page {}, {}: {}", page.number, page.place(chunk), what),
                            found,
                            expected,
                            {}});
  };
  bool more = false;
  std::size_t done = 0;
  switch (page.compression) {
    case TiffCompression::none:
      done = std::min(from.size(), to.size());
      std::copy_n(from.begin(), done, to.begin());
      more = from.size() > to.size();
      break;
    case TiffCompression::pack_bits:
      done = unpack_bits(from, to, more);
      break;
    case TiffCompression::lzw: {
      // Programs before 1992 wrote the bits of codes in the opposite order.
      if (from.size() > 1 && from[0] == std::byte{0} && (from[1] & std::byte{1}) != std::byte{0})
        fail("LZW data", "codes with the lowest bit first", "codes with the highest bit first");
      const auto unpacked = unpack_lzw(from, to, more);
      if (!unpacked) fail("damaged LZW data", "a code without a string", "LZW data");
      done = *unpacked;
      break;
    }
    default:
      done = inflate_zlib(input, at, from.size(), to, more);
  }
  if (done < to.size())
    fail("truncated data", fmt::format("{} bytes", done), fmt::format("{}", to.size()));
  const std::size_t each = page.bits / 8, row_bytes = page.row_bytes();
  if (page.predictor != 3 && each > 1 && page.order != std::endian::native)
    to_native_order(to, each);
  std::vector<std::byte> planes;
  for (std::size_t begin = 0; page.predictor > 1 && begin < to.size(); begin += row_bytes) {
    const std::span<std::byte> row = to.subspan(begin, row_bytes);
    if (page.predictor == 3) {
      add_up_planes(row, page.samples, each, planes);
    } else if (each == 1) {
      add_up<std::uint8_t>(row, page.samples);
    } else if (each == 2) {
      add_up<std::uint16_t>(row, page.samples);
    } else if (each == 4) {
      add_up<std::uint32_t>(row, page.samples);
    } else {
      add_up<std::uint64_t>(row, page.samples);
    }
  }
  return more;
}

}  // namespace ph::detail
