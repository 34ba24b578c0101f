// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <ostream>

#include "libph/src/io/bytes/readers.hpp"
#include "libph/src/io/points/npy_header.hpp"
#include "libph/src/io/tables/array.hpp"
#include "ph/io/cloud.hpp"

namespace ph {

namespace detail {

bool is_npy(const Input& input) { return input.text().starts_with(kNpyMagic); }

bool is_npy_of_floats(const Input& input) {
  const std::string descr = read_npy_header(input).descr;
  return descr.size() > 1 && descr[1] == 'f';
}

NpyLayout npy_layout(const Input& input) {
  NpyHeader header = read_npy_header(input);
  if (header.descr.empty() && !header.fields.empty()) {
    input.fail({"a structured array", fmt::format("fields {}", names_of_fields(header.fields)),
                "numbers of one type", "its fields can be read as the coordinates of points"});
  }
  const auto type = npy_type(header.descr);
  if (!type) {
    input.fail({"NPY element type",
                printable(header.descr, 40),
                "booleans, integers or floats of at most 8 bytes",
                {}});
  }
  NpyLayout npy{{type->element, type->order, header.fortran_order, header.offset},
                std::move(header.shape),
                header.descr[1]};
  npy.count = count_elements(input, npy.array, npy.shape);
  return npy;
}

Image read_npy_array(const Input& input, Input::Excess excess) {
  if (is_npz(input)) return read_npy_array(read_npz_member(input));
  NpyLayout npy = npy_layout(input);
  for (std::size_t k = 0; npy.kind == 'b' && k < npy.count; ++k) {
    const auto value = std::to_integer<int>(input.bytes()[npy.array.offset + k]);
    if (value > 1) {
      input.fail_at_byte(npy.array.offset + k,
                         {"not a boolean", fmt::format("{}", value), "0 or 1", {}});
    }
  }
  return load_array(input, npy.array, std::move(npy.shape), excess);
}

namespace {

std::string place_of(std::size_t voxel, const std::vector<Index>& extents) {
  std::vector<Index> place(extents.size());
  auto rest = static_cast<Index>(voxel);
  for (std::size_t axis = place.size(); axis-- > 0;) {
    place[axis] = rest % extents[axis];
    rest /= extents[axis];
  }
  return fmt::format("{}", fmt::join(place, ", "));
}

// Calls `use(begin, end)` for blocks of the numbers. After each call, the pages of the block may
// leave the memory.
template <class T, class Use>
void for_each_block(std::span<const T> all, bool in_file, const Input& input, Use&& use) {
  constexpr std::size_t block = 1 << 20;
  for (std::size_t begin = 0; begin < all.size(); begin += block) {
    input.poll();
    const std::span<const T> part = all.subspan(begin, std::min(all.size() - begin, block));
    use(begin, begin + part.size());
    if (in_file) forget_file_pages(part.data(), part.size_bytes());
  }
}

template <class T>
std::size_t count_nan(std::span<const T> all, bool in_file, const Input& input) {
  std::size_t count = 0;
  for_each_block(all, in_file, input, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) count += all[k] != all[k] ? 1 : 0;
  });
  return count;
}

}  // namespace

Image without_nan_pixels(Image image, const Input& input, const ReadOptions& options) {
  Voxels& values = image.values;
  const bool in_file = values.is_in_file();
  std::size_t masked = 0;
  with_voxels(values.type(), values.data(), [&]<class T>(const T* first) {
    if constexpr (std::is_floating_point_v<T>) {
      const std::span<const T> all(first, values.size());
      masked = count_nan(all, in_file, input);
      if (masked == 0) return;
      const auto is_nan = [](T value) { return std::isnan(value); };
      if (options.nan == NanPolicy::error) {
        const auto at = static_cast<std::size_t>(std::ranges::find_if(all, is_nan) - all.begin());
        input.fail({fmt::format("value at [{}]", place_of(at, image.extents)), "NaN", "a number",
                    mark(Setting::nan, "drop") + " masks such voxels"});
      }
    }
  });
  image.masked = masked > 0;
  if (image.masked)
    note(options, fmt::format("{} NaN: masked",
                              masked == 1 ? "1 voxel is" : fmt::format("{} voxels are", masked)));
  if (image.values.empty() && !options.allow_empty) {
    input.fail({"no voxels", fmt::format("shape ({})", fmt::join(image.extents, ", ")),
                "at least one", mark(Setting::allow_empty) + " accepts an empty image"});
  }
  return image;
}

}  // namespace detail

Image read_npy_image(const Input& input, const ReadOptions& options) {
  Image image = detail::read_npy_array(input, Input::Excess::stays_in_file);
  // A single number becomes an image of one voxel.
  if (image.extents.empty()) image.extents.push_back(1);
  return detail::without_nan_pixels(std::move(image), input, options);
}

void write_npy(std::ostream& out, std::span<const std::uint32_t> labels, Index width,
               Index height) {
  const bool is_size = width >= 0 && height >= 0;
  if (!is_size || checked_product(static_cast<std::size_t>(width),
                                  static_cast<std::size_t>(height)) != labels.size()) {
    throw Error(ErrorKind::bad_data,
                fmt::format("labels: found {}, expected {} x {}", labels.size(), width, height));
  }
  const std::string shape =
      height > 1 ? fmt::format("({}, {})", height, width) : fmt::format("({},)", width);
  std::string header =
      fmt::format("{{'descr': '<u4', 'fortran_order': False, 'shape': {}, }}", shape);
  // The data start at a multiple of 64. The header ends in a line feed.
  const std::size_t before = detail::kNpyMagic.size() + 4;
  header.resize((before + header.size() + 1 + 63) / 64 * 64 - before - 1, ' ');
  header += '\n';
  out.write(detail::kNpyMagic.data(), static_cast<std::streamsize>(detail::kNpyMagic.size()));
  const char lead[] = {1, 0, static_cast<char>(header.size() & 0xFF),
                       static_cast<char>(header.size() >> 8)};
  out.write(lead, sizeof(lead));
  out.write(header.data(), static_cast<std::streamsize>(header.size()));
  constexpr std::size_t kBlock = 1 << 14;
  std::array<char, 4 * kBlock> bytes;
  for (std::size_t begin = 0; begin < labels.size(); begin += kBlock) {
    const auto block = labels.subspan(begin, std::min(kBlock, labels.size() - begin));
    for (std::size_t i = 0; i < block.size(); ++i)
      for (std::size_t k = 0; k < 4; ++k)
        bytes[4 * i + k] = static_cast<char>((block[i] >> (8 * k)) & 0xFF);
    out.write(bytes.data(), static_cast<std::streamsize>(4 * block.size()));
  }
  if (!out) throw Error(ErrorKind::io, "cannot write labels");
}

}  // namespace ph
