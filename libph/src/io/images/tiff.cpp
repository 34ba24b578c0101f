// SPDX-License-Identifier: MIT
// Makes an image from the pages of a TIFF file.
#include "libph/src/io/images/tiff.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "libph/src/io/bytes/unpack.hpp"
#include "libph/src/io/tables/array.hpp"

namespace ph::detail {
namespace {

constexpr std::string_view kOneChannel =
    "save each channel as a file, or save the array as .npy and take one, a[:, 0]";

std::string kind_of(const TiffPage& page) {
  constexpr std::string_view kFormats[] = {"", "uint", "int", "float"};
  return fmt::format("{} x {} pixels of {}{}{}", page.width, page.height, kFormats[page.format],
                     page.bits, page.samples == 1 ? "" : fmt::format(", {} samples", page.samples));
}

// Leaves out pages that repeat others in a lower resolution, and masks. Refuses pages that differ
// from the first one.
std::vector<TiffPage> pages_of(const Input& input, const ReadOptions& options) {
  std::vector<TiffPage> pages = read_tiff_pages(input);
  const std::size_t all = pages.size();
  std::erase_if(pages, [](const TiffPage& page) { return page.is_left_out(); });
  if (pages.empty())
    input.fail({"no page of full resolution", fmt::format("{} others", all), "at least one", {}});
  if (const std::size_t left_out = all - pages.size(); left_out > 0)
    note(options, fmt::format("pages of reduced resolution and masks are not read: {} of {} pages",
                              left_out, all));
  const TiffPage& first = pages[0];
  for (const TiffPage& page : pages) {
    if (kind_of(page) != kind_of(first) || page.photometric != first.photometric)
      input.fail_at_byte(
          page.at,
          {fmt::format("page {}", page.number),
           page.photometric == first.photometric ? kind_of(page) : "another meaning of the samples",
           fmt::format("{}, as on page {}", kind_of(first), first.number),
           "save the pages that belong together as a file"});
  }
  if (first.photometric == 0)
    note(options, "0 is white in this file (WhiteIsZero); the values are read as they are stored");
  return pages;
}

// The number after a name in the description of a page, such as 12 after "slices="; 1 if there is
// none.
std::size_t number_after(std::string_view text, std::string_view name) {
  const std::size_t found = text.find(name);
  if (found == std::string_view::npos) return 1;
  text.remove_prefix(found + name.size());
  std::size_t number = 1;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return std::max<std::size_t>(number, 1);
}

// The pages as the program that wrote the file describes them.
struct Description {
  std::size_t images = 1, channels = 1, slices = 1, frames = 1;
  bool is_described = false;
  bool has_slices_first = true;  // the slices of one time follow each other
};

Description described_by(const TiffPage& page) {
  const std::string_view text = page.description;
  Description stack;
  if (text.starts_with("ImageJ=")) {
    stack = {number_after(text, "\nimages="),
             number_after(text, "\nchannels="),
             number_after(text, "\nslices="),
             number_after(text, "\nframes="),
             true,
             true};
    // A stack that is no hyperstack states only its images.
    if (stack.channels == 1 && stack.slices == 1 && stack.frames == 1) stack.slices = stack.images;
    if (page.samples > 1) stack.channels = 1;  // the colours of a pixel
  } else if (text.find("<OME") != std::string_view::npos) {
    stack = {1,
             number_after(text, " SizeC=\""),
             number_after(text, " SizeZ=\""),
             number_after(text, " SizeT=\""),
             true,
             text.find("DimensionOrder=\"XYT") == std::string_view::npos &&
                 text.find("DimensionOrder=\"XYCT") == std::string_view::npos};
    if (page.samples > 1) stack.channels = 1;
    stack.images = stack.channels * stack.slices * stack.frames;
  }
  return stack;
}

// The sizes of the axes. @param count the number of images. One page of ImageJ may stand for
// several images.
std::vector<Index> extents_of(const Input& input, const TiffPage& first, const Description& stack,
                              std::size_t count) {
  const auto index = [](std::size_t size) { return static_cast<Index>(size); };
  std::vector<Index> extents;
  if (stack.is_described) {
    if (stack.channels > 1) {
      input.fail_at_byte(
          first.at, {"channels", fmt::format("{}", stack.channels),
                     "1, because an image has one number per voxel", std::string(kOneChannel)});
    }
    const auto described = checked_product(stack.slices, stack.frames);
    if (!described || *described != count)
      input.fail_at_byte(first.at, {"truncated: number of images", fmt::format("{}", count),
                                    described ? fmt::format("{}, for {} slices and {} times",
                                                            *described, stack.slices, stack.frames)
                                              : "fewer slices and times",
                                    "are the other images in another file?"});
    if (stack.frames > 1 && stack.slices > 1) {
      if (!stack.has_slices_first)
        input.fail_at_byte(first.at, {"order of the pages", "all times of one slice together",
                                      "all slices of one time together", "save the array as .npy"});
      extents = {index(stack.frames), index(stack.slices)};
    }
  }
  if (extents.empty() && count > 1) extents = {index(count)};
  extents.insert(extents.end(), {index(first.height), index(first.width)});
  return extents;
}

class TiffImage {
 public:
  TiffImage(const Input& input, const ReadOptions& options)
      : input_(input), options_(options), pages_(pages_of(input, options)), first_(pages_[0]) {}

  Image read() {
    if (first_.samples == 1 && options_.channel != Channel::automatic &&
        options_.channel != Channel::grey)
      refuse_channel(options_.channel, "grey", input_);
    const Description stack = described_by(first_);
    // ImageJ writes files above 4 GB with one directory, behind which all images follow.
    is_long_ = pages_.size() == 1 && stack.is_described && stack.images > 1 &&
               first_.description.starts_with("ImageJ=");
    count_ = is_long_ ? stack.images : pages_.size();
    std::vector<Index> extents = extents_of(input_, first_, stack, count_);
    require_size();
    if (first_.samples > 1) return colours(std::move(extents));
    const ElementType type = type_of_samples();
    if (const auto begin = place_of_all(type.size)) {
      return without_nan_pixels(load_elements(input_, {type, first_.order, false, *begin},
                                              std::move(extents), Input::Excess::stays_in_file),
                                input_, options_);
    }
    if (is_long_)
      input_.fail_at_byte(first_.at,
                          {"images of ImageJ", fmt::format("{} images in one page", count_),
                           fmt::format("{} images without compression, one after another", count_),
                           "is the file truncated?"});
    return without_nan_pixels({std::move(extents), decoded(type)}, input_, options_);
  }

 private:
  // The type of the numbers that a decoded chunk has.
  ElementType type_of_samples() const {
    const std::size_t bytes = std::max<std::size_t>(first_.bits / 8, 1);
    const char letter = first_.format == 1 ? 'u' : first_.format == 2 ? 'i' : 'f';
    return *element_type(fmt::format("{}{}", letter, bytes));
  }

  // Compares the size of the image with the size of the file, because pages may share their data.
  void require_size() {
    std::optional<std::size_t> bytes = std::max<std::size_t>(first_.bits / 8, 1);
    for (const std::size_t size : {first_.samples, first_.width, first_.height, count_})
      if (bytes) bytes = checked_product(*bytes, size);
    const std::size_t reasonable =
        std::max(kMostFree, checked_product(input_.size(), kMostExpansion).value_or(SIZE_MAX));
    if (!bytes || *bytes > reasonable) {
      input_.fail_at_byte(first_.at,
                          {"compressed data expand too much",
                           bytes ? fmt::format("{} MiB", *bytes >> 20) : "more than 2^64 bytes",
                           fmt::format("at most {} times {} bytes", kMostExpansion, input_.size()),
                           "if this size is right, save the file without compression"});
    }
    bytes_ = *bytes;
  }

  // The place of the numbers, if they lie one after another in the file as in an array.
  std::optional<std::size_t> place_of_all(std::size_t each) const {
    const std::size_t begin = first_.offsets.number(input_, 0);
    std::size_t next = begin;
    for (const TiffPage& page : pages_) {
      if (page.compression != TiffCompression::none || page.bits == 1 ||
          page.chunk_width != page.width)
        return std::nullopt;
      for (std::size_t chunk = 0; chunk < page.chunks_down(); ++chunk) {
        const std::size_t bytes = page.rows_of(chunk) * page.row_bytes();
        const bool is_padded =
            chunk * page.chunk_height + page.rows_of(chunk) > page.height && page.is_tiled;
        if (page.offsets.number(input_, chunk) != next || is_padded) return std::nullopt;
        if (page.sizes.number(input_, chunk) != bytes && !is_long_) return std::nullopt;
        next += bytes;
      }
    }
    const std::size_t bytes = count_ * first_.width * first_.height * each;
    // The images behind the first one end before the directory, if it comes after them.
    const std::size_t end = is_long_ && first_.at > begin ? first_.at : input_.size();
    if (bytes > end - begin) return std::nullopt;
    return begin;
  }

  // Decodes all chunks. Calls `take(bytes, place, count)` for each part of a row: `count` samples
  // that begin at this place in the image.
  template <class Take>
  void decode(const Take& take) {
    std::size_t largest = 0, surplus = 0;
    for (const TiffPage& page : pages_)
      largest = std::max(largest, page.chunk_height * page.row_bytes());
    input_.require_memory(largest);
    std::vector<std::byte> buffer(largest);
    for (std::size_t number = 0; number < pages_.size(); ++number) {
      const TiffPage& page = pages_[number];
      const std::size_t across = page.chunks_across();
      for (std::size_t chunk = 0; chunk < across * page.chunks_down(); ++chunk) {
        input_.poll();
        const std::size_t row_bytes = page.row_bytes();
        const std::span<std::byte> bytes = std::span(buffer).first(page.rows_of(chunk) * row_bytes);
        surplus += decode_tiff_chunk(input_, page, chunk, bytes) ? 1 : 0;
        input_.done_with(page.offsets.number(input_, chunk), page.sizes.number(input_, chunk));
        const std::size_t top = chunk / across * page.chunk_height,
                          left = chunk % across * page.chunk_width;
        const std::size_t rows = std::min(page.rows_of(chunk), page.height - top),
                          columns = std::min(page.chunk_width, page.width - left);
        for (std::size_t y = 0; y < rows; ++y)
          take(bytes.data() + y * row_bytes,
               (((number * page.height + top + y) * page.width) + left) * page.samples,
               columns * page.samples);
      }
    }
    if (surplus > 0)
      note(options_, fmt::format("{} strip{} or tile{} more data than {} pixels need; the rest is "
                                 "not read",
                                 surplus, surplus == 1 ? "" : "s", surplus == 1 ? " has" : "s have",
                                 surplus == 1 ? "its" : "their"));
  }

  template <class T>
  void decode_into(std::span<T> to, const ElementType& type, bool in_file) {
    std::size_t forgotten = 0;
    decode([&](const std::byte* from, std::size_t place, std::size_t count) {
      T* const row = to.data() + place;
      if (first_.bits == 1) {
        for (std::size_t k = 0; k < count; ++k)
          row[k] = static_cast<T>(std::to_integer<unsigned>(from[k / 8]) >> (7 - k % 8) & 1U);
      } else if (type.is_native) {
        std::memcpy(row, from, count * sizeof(T));
        if constexpr (std::is_floating_point_v<T>)
          for (std::size_t k = 0; k < count; ++k) row[k] += 0;  // the sum turns -0.0 into +0.0
      } else {
        for (std::size_t k = 0; k < count; ++k) row[k] = converted<T>(from + k * type.size, type);
      }
      constexpr std::size_t many = std::size_t{1} << 24;
      if (in_file && (place - std::min(place, forgotten)) * sizeof(T) > many) {
        forget_file_pages(to.data() + forgotten, (place - forgotten) * sizeof(T));
        forgotten = place;
      }
    });
  }

  template <class T>
  T converted(const std::byte* from, const ElementType& type) const {
    bool exact = true;
    const double value = type.load(from, std::endian::native, exact);
    if (!exact)
      input_.fail({"integer that a double cannot hold",
                   fmt::format("one near {:.0f}", value),
                   "at most 2^53",
                   {}});
    return static_cast<T>(value);
  }

  Voxels decoded(const ElementType& type) {
    const std::size_t count = count_ * first_.width * first_.height;
    return with_voxels(type.stored, nullptr, [&]<class T>(const T*) {
      if (stays_in_file(input_, count * sizeof(T))) {
        return voxels_in_file<T>(type.stored, count,
                                 [&](std::span<T> to) { decode_into(to, type, true); });
      }
      input_.require_memory(count * sizeof(T));
      std::vector<T> values(count);
      decode_into(std::span<T>(values), type, false);
      return Voxels(std::move(values));
    });
  }

  // Reads all pages as one high picture, from which a channel is taken.
  Image colours(std::vector<Index> extents) {
    input_.take_memory();
    Raster raster;
    raster.name = input_.name();
    raster.width = static_cast<Index>(first_.width);
    raster.height = static_cast<Index>(count_ * first_.height);
    raster.channels = static_cast<int>(first_.samples);
    raster.bits = static_cast<int>(first_.bits);
    const std::size_t count = bytes_ / (first_.bits / 8);
    input_.require_memory(count * sizeof(std::uint16_t));
    raster.samples.resize(count);
    decode([&](const std::byte* from, std::size_t place, std::size_t samples) {
      for (std::size_t k = 0; k < samples; ++k)
        raster.samples[place + k] = first_.bits == 8
                                        ? std::to_integer<std::uint16_t>(from[k])
                                        : load<std::uint16_t>(from + 2 * k, std::endian::native);
    });
    Image image = image_of(std::move(raster), input_, options_);
    image.extents = std::move(extents);
    return image;
  }

  const Input& input_;
  const ReadOptions& options_;
  std::vector<TiffPage> pages_;
  const TiffPage& first_;
  std::size_t count_ = 0, bytes_ = 0;  // images, and bytes of the decoded numbers
  bool is_long_ = false;               // one directory stands for several images
};

}  // namespace

Image read_tiff_image(const Input& input, const ReadOptions& options) {
  return TiffImage(input, options).read();
}

}  // namespace ph::detail
