// SPDX-License-Identifier: MIT
// Reads the directories of a TIFF or BigTIFF file, one per page.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "libph/src/io/images/tiff.hpp"

namespace ph::detail {
namespace {

constexpr std::size_t kMostSide = std::size_t{1} << 31;

enum Tag : std::uint16_t {
  kKind = 254,
  kWidth = 256,
  kHeight = 257,
  kBits = 258,
  kCompression = 259,
  kPhotometric = 262,
  kFillOrder = 266,
  kDescription = 270,
  kStripOffsets = 273,
  kSamples = 277,
  kRowsPerStrip = 278,
  kStripSizes = 279,
  kPlanar = 284,
  kPredictor = 317,
  kTileWidth = 322,
  kTileHeight = 323,
  kTileOffsets = 324,
  kTileSizes = 325,
  kSampleFormat = 339,
};
constexpr std::array kTags{kKind,         kWidth,       kHeight,      kBits,         kCompression,
                           kPhotometric,  kFillOrder,   kDescription, kStripOffsets, kSamples,
                           kRowsPerStrip, kStripSizes,  kPlanar,      kPredictor,    kTileWidth,
                           kTileHeight,   kTileOffsets, kTileSizes,   kSampleFormat};

struct Name {
  std::size_t code;
  std::string_view name;
};
constexpr std::array kCompressions{
    Name{2, "CCITT RLE"},     Name{3, "CCITT Group 3"}, Name{4, "CCITT Group 4"},
    Name{6, "old JPEG"},      Name{7, "JPEG"},          Name{34712, "JPEG 2000"},
    Name{34887, "LERC"},      Name{34925, "LZMA"},      Name{50000, "Zstandard"},
    Name{50001, "WebP"},      Name{50002, "JPEG XL"},   Name{33003, "JPEG 2000"},
    Name{33005, "JPEG 2000"}, Name{34661, "JBIG"}};
constexpr std::array kPhotometrics{Name{3, "a palette of colours"},
                                   Name{4, "a mask"},
                                   Name{5, "CMYK"},
                                   Name{6, "YCbCr"},
                                   Name{8, "CIELab"},
                                   Name{32803, "a colour filter"}};

std::string named(std::size_t code, std::span<const Name> names) {
  const auto found = std::ranges::find(names, code, &Name::code);
  return found == names.end() ? fmt::format("{}", code) : fmt::format("{} ({})", code, found->name);
}

// Reads one directory after another.
class Directories {
 public:
  explicit Directories(const Input& input) : input_(input) {
    const std::string_view text = input.text();
    if (!is_tiff(input)) {
      input.fail_at_byte(0, {"not a TIFF file",
                             '"' + printable(text.substr(0, 4)) + '"',
                             "\"II*\\x00\" or \"MM\\x00*\"; in BigTIFF, + instead of *",
                             {}});
    }
    order_ = text[0] == 'I' ? std::endian::little : std::endian::big;
    is_big_ = text[2] == '+' || text[3] == '+';
    if (is_big_ && (integer(4, 2) != 8 || integer(6, 2) != 0))
      input.fail_at_byte(
          4, {"size of an offset in BigTIFF", fmt::format("{}", integer(4, 2)), "8, then 0", {}});
    next_ = integer(is_big_ ? 8 : 4, is_big_ ? 8 : 4);
    if (next_ == 0) input.fail({"pages of a TIFF", "none", "at least one", {}});
  }

  // Reads the next page. @return false after the last one.
  bool next(TiffPage& page) {
    if (next_ == 0) return false;
    page = {};
    page.number = ++number_;
    page.at = next_;
    page.order = order_;
    if (!seen_.insert(next_).second) {
      input_.fail_at_byte(next_, {fmt::format("page {}", number_),
                                  "a page that came before",
                                  "another page, or the end",
                                  {}});
    }
    read_entries();
    fill(page);
    return true;
  }

 private:
  std::size_t integer(std::size_t at, std::size_t bytes) const {
    if (at > input_.size() || bytes > input_.size() - at) {
      input_.fail_at_byte(input_.size(), {"truncated",
                                          "the end of the file",
                                          fmt::format("{} bytes from byte {} on", bytes, at),
                                          {}});
    }
    const std::byte* const from = input_.bytes().data() + at;
    return bytes == 2   ? load<std::uint16_t>(from, order_)
           : bytes == 4 ? load<std::uint32_t>(from, order_)
                        : static_cast<std::size_t>(load<std::uint64_t>(from, order_));
  }

  // Reads the entries with tags that are used here, and the place of the next directory.
  void read_entries() {
    entries_.clear();
    const std::size_t begin = next_, of_offset = is_big_ ? 8 : 4, of_entry = 4 + 2 * of_offset;
    const std::size_t count = integer(begin, is_big_ ? 8 : 2);
    const std::size_t first = begin + (is_big_ ? 8 : 2);
    if (count > (input_.size() - first) / of_entry) {
      input_.fail_at_byte(begin,
                          {fmt::format("truncated: the directory of page {}", number_),
                           fmt::format("{} entries", count),
                           fmt::format("at most {} in {} bytes", (input_.size() - first) / of_entry,
                                       input_.size() - first),
                           {}});
    }
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t at = first + k * of_entry;
      const auto tag = static_cast<Tag>(integer(at, 2));
      if (std::ranges::count(kTags, tag) == 0) continue;
      // The size of a type by its code, or 0 if a tag that is used here never has this type.
      constexpr std::array<std::size_t, 17> kSizes{0, 1, 1, 2, 4, 0, 0, 0, 0,
                                                   0, 0, 0, 0, 0, 0, 0, 8};
      const std::size_t type = integer(at + 2, 2);
      const std::size_t each = type < kSizes.size() ? kSizes[type] : 0;
      if (each == 0 || (type == 2) != (tag == kDescription)) {
        fail(at + 2, fmt::format("type of field {}", static_cast<int>(tag)),
             fmt::format("{}", type), tag == kDescription ? "2, text" : "1, 3, 4 or 16");
      }
      TiffNumbers numbers{integer(at + 4, of_offset), at + 4 + of_offset, each, order_};
      const auto bytes = checked_product(numbers.count, each);
      if (!bytes || *bytes > of_offset) numbers.at = integer(numbers.at, of_offset);
      if (!bytes || numbers.at > input_.size() || *bytes > input_.size() - numbers.at) {
        fail(at + 4, fmt::format("truncated: field {}", static_cast<int>(tag)),
             fmt::format("{} numbers of {} bytes at byte {}", numbers.count, each, numbers.at),
             fmt::format("numbers within the {} bytes of the file", input_.size()));
      }
      if (!entries_.emplace(tag, numbers).second)
        fail(at, fmt::format("field {}", static_cast<int>(tag)), "a second one", "one");
    }
    next_ = integer(first + count * of_entry, of_offset);
  }

  const TiffNumbers* find(Tag tag) const {
    const auto found = entries_.find(tag);
    return found == entries_.end() ? nullptr : &found->second;
  }

  [[noreturn]] void fail(std::size_t at, const std::string& what, const std::string& found,
                         const std::string& expected, const Message& hint = {}) const {
    input_.fail_at_byte(at, {fmt::format("page {}: {}", number_, what), found, expected, hint});
  }

  // The only number of a field, or the number that all samples share.
  std::size_t number(Tag tag, std::string_view what, std::size_t least, std::size_t most,
                     std::optional<std::size_t> otherwise = {}) const {
    const TiffNumbers* const numbers = find(tag);
    if (numbers == nullptr && otherwise) return *otherwise;
    if (numbers == nullptr || numbers->count == 0)
      fail(at_, std::string(what), "no such field", fmt::format("field {}", static_cast<int>(tag)));
    const std::size_t value = numbers->number(input_, 0);
    const bool is_of_samples = tag == kBits || tag == kSampleFormat;
    for (std::size_t k = 1; k < numbers->count; ++k) {
      if (is_of_samples && k < 4 && numbers->number(input_, k) == value) continue;
      if (is_of_samples && k >= 4) break;  // there are at most four samples, see fill()
      fail(numbers->at, std::string(what),
           is_of_samples ? fmt::format("{} and {}", value, numbers->number(input_, k))
                         : fmt::format("{} numbers", numbers->count),
           is_of_samples ? "the same for all samples" : "one", kToNpy);
    }
    if (value < least || value > most)
      fail(numbers->at, std::string(what), fmt::format("{}", value),
           least == most ? fmt::format("{}", least) : fmt::format("{} to {}", least, most));
    return value;
  }

  void fill(TiffPage& page) {
    at_ = page.at;
    page.kind = number(kKind, "kind of page", 0, 0xFFFFFFFF, 0);
    if (page.is_left_out()) return;
    page.width = number(kWidth, "width", 1, kMostSide);
    page.height = number(kHeight, "height", 1, kMostSide);
    if (const TiffNumbers* const text = find(kDescription)) {
      page.description = input_.text().substr(text->at, text->count);
      page.description = page.description.substr(0, page.description.find('\0'));
    }
    fill_pixels(page);
    fill_compression(page);
    fill_chunks(page);
  }

  void fill_pixels(TiffPage& page) const {
    constexpr std::size_t kAny = 0xFFFF;
    page.samples = number(kSamples, "samples per pixel", 1, kAny, 1);
    page.photometric = number(kPhotometric, "meaning of the samples", 0, kAny, 1);
    if (page.photometric > 2)
      fail(at_, "meaning of the samples", named(page.photometric, kPhotometrics), "grey or RGB",
           kToPng);
    const std::size_t least = page.photometric == 2 ? 3 : 1;
    if (page.samples < least || page.samples > least + 1)
      fail(at_, "samples per pixel", fmt::format("{}", page.samples),
           fmt::format("{} or {}, with opacity", least, least + 1),
           "save each channel as a file, or save the array as .npy and take one, a[..., 0]");
    page.bits = number(kBits, "bits per sample", 1, kAny, 1);
    // Format 4 says that the format is not known. Other programs then read unsigned numbers.
    page.format = number(kSampleFormat, "format of the samples", 1, 6, 1);
    if (page.format == 4) page.format = 1;
    if (page.format > 4)
      fail(at_, "format of the samples", fmt::format("{} (complex numbers)", page.format),
           "1, 2 or 3", "complex numbers are not filtration values");
    const bool is_known = page.bits == 8 || page.bits == 16 || page.bits == 32 || page.bits == 64 ||
                          (page.bits == 1 && page.samples == 1);
    if (!is_known || (page.format != 1 && page.bits == 1) || (page.format == 3 && page.bits == 8) ||
        (page.samples > 1 && (page.bits > 16 || page.format != 1)))
      fail(at_, "numbers of the pixels",
           fmt::format("{} bits, format {}, {} samples per pixel", page.bits, page.format,
                       page.samples),
           "integers of 1, 8, 16, 32 or 64 bits or floats of 16, 32 or 64 bits; colours of 8 or 16 "
           "bits",
           kToNpy);
    if (page.samples > 1 && number(kPlanar, "order of the samples", 1, 2, 1) != 1)
      fail(at_, "order of the samples", "one plane per channel", "all samples of a pixel together",
           "save each channel as a file, or save the array as .npy and take one, a[..., 0]");
  }

  void fill_compression(TiffPage& page) const {
    const std::size_t code = number(kCompression, "compression", 1, 0xFFFF, 1);
    page.compression = static_cast<TiffCompression>(code);
    switch (page.compression) {
      case TiffCompression::none:
      case TiffCompression::lzw:
      case TiffCompression::deflate:
      case TiffCompression::pack_bits:
      case TiffCompression::old_deflate:
        break;
      default:
        fail(at_, "compression", named(code, kCompressions), "none, LZW, Deflate or PackBits",
             "save it again with one of these, for example with tiffcp -c zip");
    }
    if (number(kFillOrder, "order of the bits", 1, 2, 1) != 1)
      fail(at_, "order of the bits", "2, the lowest bit first", "1",
           "save it again, for example with tiffcp -f msb2lsb");
    page.predictor = number(kPredictor, "predictor", 1, 3, 1);
    const bool is_packed = page.compression == TiffCompression::lzw ||
                           page.compression == TiffCompression::deflate ||
                           page.compression == TiffCompression::old_deflate;
    if (!is_packed) page.predictor = 1;  // the field has a meaning only for these compressions
    if ((page.predictor == 2 && page.bits == 1) || (page.predictor == 3 && page.format != 3))
      fail(at_, "predictor",
           fmt::format("{} for {} bits of format {}", page.predictor, page.bits, page.format),
           "1, or 2 for bytes and longer numbers, or 3 for floats");
  }

  void fill_chunks(TiffPage& page) {
    page.is_tiled = find(kTileWidth) != nullptr || find(kTileOffsets) != nullptr;
    page.chunk_width =
        page.is_tiled ? number(kTileWidth, "width of a tile", 1, kMostSide) : page.width;
    page.chunk_height =
        page.is_tiled
            ? number(kTileHeight, "height of a tile", 1, kMostSide)
            : std::min(number(kRowsPerStrip, "rows per strip", 1, SIZE_MAX, SIZE_MAX), page.height);
    const std::size_t count = page.chunks_across() * page.chunks_down();  // at most 2^62
    chunks_ += std::min(count, input_.size() + 1);
    if (chunks_ > input_.size())
      fail(at_, "truncated: strips and tiles", fmt::format("{} so far", chunks_),
           fmt::format("at most one per byte, of which there are {}", input_.size()));
    const auto list = [&](Tag tag, std::string_view what) {
      const TiffNumbers* const numbers = find(tag);
      if (numbers == nullptr || numbers->count != count)
        fail(numbers == nullptr ? at_ : numbers->at, std::string(what),
             numbers == nullptr ? "no such field" : fmt::format("{}", numbers->count),
             fmt::format("{}, for {} x {} pixels", count, page.width, page.height));
      return *numbers;
    };
    page.offsets = page.is_tiled ? list(kTileOffsets, "offsets of tiles")
                                 : list(kStripOffsets, "offsets of strips");
    page.sizes =
        page.is_tiled ? list(kTileSizes, "sizes of tiles") : list(kStripSizes, "sizes of strips");
    check_chunks(page, count);
  }

  // Checks that the chunks are in the file, and that they may hold their pixels.
  void check_chunks(const TiffPage& page, std::size_t count) const {
    // The largest number of bytes that a byte of compressed data stands for.
    const std::size_t expansion = page.compression == TiffCompression::none        ? 1
                                  : page.compression == TiffCompression::pack_bits ? 64
                                                                                   : 4096;
    for (std::size_t chunk = 0; chunk < count; ++chunk) {
      const std::size_t at = page.offsets.number(input_, chunk);
      const std::size_t size = page.sizes.number(input_, chunk);
      if (at > input_.size() || size > input_.size() - at) {
        fail(page.sizes.at + chunk * page.sizes.bytes_each,
             fmt::format("truncated: {}", page.place(chunk)),
             fmt::format("{} bytes at byte {}", size, at),
             fmt::format("bytes within the {} of the file", input_.size()));
      }
      const auto bytes = checked_product(page.row_bytes(), page.rows_of(chunk));
      if (!bytes || *bytes / expansion > size) {
        fail(page.sizes.at + chunk * page.sizes.bytes_each,
             fmt::format("truncated: {}", page.place(chunk)), fmt::format("{} bytes", size),
             bytes ? fmt::format("at least {}, for {} rows of {} bytes",
                                 (*bytes + expansion - 1) / expansion, page.rows_of(chunk),
                                 page.row_bytes())
                   : "fewer pixels");
      }
    }
  }

  static constexpr std::string_view kToNpy = "save the array as .npy";
  static constexpr std::string_view kToPng = "convert it to grey or RGB, or save the array as .npy";

  const Input& input_;
  std::endian order_ = std::endian::little;
  bool is_big_ = false;
  std::size_t next_ = 0, number_ = 0, at_ = 0, chunks_ = 0;
  std::set<std::size_t> seen_;
  std::map<Tag, TiffNumbers> entries_;
};

}  // namespace

bool is_tiff(const Input& input) {
  const std::string_view start = input.text().substr(0, 4);
  return start == std::string_view("II*\0", 4) || start == std::string_view("MM\0*", 4) ||
         start == std::string_view("II+\0", 4) || start == std::string_view("MM\0+", 4);
}

std::size_t TiffNumbers::number(const Input& input, std::size_t i) const {
  const std::byte* const from = input.bytes().data() + at + i * bytes_each;
  switch (bytes_each) {
    case 1:
      return std::to_integer<std::size_t>(*from);
    case 2:
      return load<std::uint16_t>(from, order);
    case 4:
      return load<std::uint32_t>(from, order);
    default:
      return static_cast<std::size_t>(load<std::uint64_t>(from, order));
  }
}

std::string TiffPage::place(std::size_t chunk) const {
  return fmt::format("{} {}", is_tiled ? "tile" : "strip", chunk + 1);
}

std::vector<TiffPage> read_tiff_pages(const Input& input) {
  Directories directories(input);
  std::vector<TiffPage> pages;
  for (TiffPage page; directories.next(page);) {
    require_growth(input, pages);
    pages.push_back(page);
  }
  return pages;
}

}  // namespace ph::detail
