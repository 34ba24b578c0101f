// SPDX-License-Identifier: MIT
#include "ph/detail/io/png.hpp"

#include <fmt/format.h>
#include <png.h>

#include <cmath>
#include <cstdlib>
#include <new>
#include <ostream>

#include "libph/src/io/bytes/readers.hpp"
#include "ph/detail/io/table.hpp"

namespace ph {
namespace {

constexpr png_uint_32 kMaxSide = 65535;
// The largest size of an ancillary chunk, in bytes.
constexpr std::size_t kMaxChunk = std::size_t{8} << 20;
// Deflate cannot expand data by a larger factor. A small file that claims a larger factor is
// refused.
constexpr std::size_t kMaxExpansion = 1032;

struct Source {
  const Input& input;
  std::size_t offset = 0;
};

// libpng is C code, so no exception may pass through it. Instead, an error is stored here, and
// longjmp then leaves libpng.
struct Report {
  std::string message;
  bool out_of_memory = false;
};

extern "C" {

[[noreturn]] static void png_failed(png_structp png, png_const_charp message) {
  auto* report = static_cast<Report*>(png_get_error_ptr(png));
  try {
    report->message = printable(message, 200);
  } catch (...) {
    report->out_of_memory = true;
  }
  png_longjmp(png, 1);
}

// The error messages of libpng are the same for lack of memory and for damaged data. The member
// `out_of_memory` distinguishes the two cases.
static void* png_allocate(png_structp png, std::size_t size) {
  void* const memory = std::malloc(size);
  if (memory == nullptr) static_cast<Report*>(png_get_mem_ptr(png))->out_of_memory = true;
  return memory;
}

static void png_release(png_structp, void* memory) { std::free(memory); }

static void png_warned(png_structp, png_const_charp) {}

static void png_take(png_structp png, png_bytep to, std::size_t size) {
  auto* source = static_cast<Source*>(png_get_io_ptr(png));
  if (size > source->input.size() - source->offset) png_error(png, "truncated");
  std::memcpy(to, source->input.text().data() + source->offset, size);
  source->offset += size;
}

static void png_put(png_structp png, png_bytep from, std::size_t size) {
  auto* out = static_cast<std::ostream*>(png_get_io_ptr(png));
  try {
    out->write(reinterpret_cast<const char*>(from), static_cast<std::streamsize>(size));
  } catch (const std::bad_alloc&) {  // an exception of the stream must not pass through C code
    static_cast<Report*>(png_get_error_ptr(png))->out_of_memory = true;
  } catch (...) {  // the stream's bad bit is checked below
  }
  if (!*out) png_error(png, "cannot write");
}

static void png_flushed(png_structp) {}

}  // extern "C"

struct Reader {
  png_structp png = nullptr;
  png_infop info = nullptr;
  ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
};

struct Writer {
  png_structp png = nullptr;
  png_infop info = nullptr;
  ~Writer() { png_destroy_write_struct(&png, &info); }
};

// Checks the lengths of chunks, because libpng trusts the length of a chunk, and allocates memory
// before it reads.
void require_chunks(const Input& input) {
  constexpr std::size_t kSignature = 8, kChecksum = 4;
  BinaryCursor cursor(input, std::endian::big, kSignature);
  for (bool end = false; !end;) {
    const std::size_t length = cursor.read<std::uint32_t>("length of a PNG chunk");
    const auto kind = cursor.take(4, "name of a PNG chunk");
    end = std::memcmp(kind.data(), "IEND", kind.size()) == 0;
    cursor.take(length, "PNG chunk");
    cursor.take(kChecksum, "checksum of a PNG chunk");
  }
}

// Each of the following functions calls libpng between setjmp and longjmp, and therefore owns
// nothing that needs a destructor. It returns false on failure.

bool read_header(Reader& reader) {
  if (setjmp(png_jmpbuf(reader.png)) != 0) return false;
  png_set_user_limits(reader.png, kMaxSide, kMaxSide);
  png_set_chunk_malloc_max(reader.png, kMaxChunk);
  png_read_info(reader.png, reader.info);
  // Expands palettes, samples of fewer than 8 bits and transparent colours.
  png_set_expand(reader.png);
  if constexpr (std::endian::native == std::endian::little) png_set_swap(reader.png);
  png_set_interlace_handling(reader.png);
  png_read_update_info(reader.png, reader.info);
  return true;
}

bool read_pixels(Reader& reader, png_bytepp rows) {
  if (setjmp(png_jmpbuf(reader.png)) != 0) return false;
  png_read_image(reader.png, rows);
  png_read_end(reader.png, nullptr);
  return true;
}

bool write_pixels(Writer& writer, std::ostream& out, const Raster& raster, png_bytepp rows) {
  constexpr int kColours[] = {0, PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                              PNG_COLOR_TYPE_RGB_ALPHA};
  if (setjmp(png_jmpbuf(writer.png)) != 0) return false;
  png_set_write_fn(writer.png, &out, &png_put, &png_flushed);
  png_set_IHDR(writer.png, writer.info, static_cast<png_uint_32>(raster.width),
               static_cast<png_uint_32>(raster.height), raster.bits, kColours[raster.channels],
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (raster.dots_per_inch > 0) {
    const auto dots_a_metre = static_cast<png_uint_32>(std::lround(raster.dots_per_inch / 0.0254));
    png_set_pHYs(writer.png, writer.info, dots_a_metre, dots_a_metre, PNG_RESOLUTION_METER);
  }
  png_write_info(writer.png, writer.info);
  if constexpr (std::endian::native == std::endian::little) {
    if (raster.bits == 16) png_set_swap(writer.png);
  }
  png_write_image(writer.png, rows);
  png_write_end(writer.png, nullptr);
  return true;
}

}  // namespace

namespace detail {

bool is_png(const Input& input) { return input.text().starts_with("\x89PNG\r\n\x1A\n"); }

}  // namespace detail

Raster read_png(const Input& input) {
  if (!detail::is_png(input)) {
    const auto foreign = detail::foreign_kind(input.text());
    input.fail_at_byte(
        0, {"not a PNG file", foreign ? std::string(foreign->name) : "a different signature",
            "\\x89PNG", foreign ? std::string(foreign->advice) : ""});
  }
  require_chunks(input);
  Report report;
  Source source{input};
  Reader reader;
  const auto fail = [&] {
    if (report.out_of_memory) throw std::bad_alloc();
    input.fail_at_byte(source.offset, {"damaged PNG", report.message, "a complete PNG image", {}});
  };
  reader.png = png_create_read_struct_2(PNG_LIBPNG_VER_STRING, &report, &png_failed, &png_warned,
                                        &report, &png_allocate, &png_release);
  if (reader.png == nullptr) throw std::bad_alloc();
  reader.info = png_create_info_struct(reader.png);
  if (reader.info == nullptr) throw std::bad_alloc();
  png_set_read_fn(reader.png, &source, &png_take);
  if (!read_header(reader)) fail();

  Raster raster;
  raster.name = input.name();
  raster.width = png_get_image_width(reader.png, reader.info);
  raster.height = png_get_image_height(reader.png, reader.info);
  raster.channels = png_get_channels(reader.png, reader.info);
  raster.bits = png_get_bit_depth(reader.png, reader.info);
  const std::size_t row_bytes = png_get_rowbytes(reader.png, reader.info);
  const auto height = static_cast<std::size_t>(raster.height);
  // Expansion turns one bit into at most 32 bits.
  if (height * row_bytes / 32 / kMaxExpansion > input.size()) {
    input.fail_at_byte(16, {"truncated: the size of the image does not fit the file",
                            fmt::format("{} x {} pixels", raster.width, raster.height),
                            fmt::format("fewer pixels in {} bytes", input.size()),
                            {}});
  }
  const std::size_t count = height * static_cast<std::size_t>(raster.width * raster.channels);
  input.require_memory(height * (row_bytes + sizeof(png_bytep)) + count * sizeof(std::uint16_t));
  raster.samples.resize(count);
  // 8-bit rows are read into the upper half of the samples and then widened from the front.
  auto* bytes = reinterpret_cast<png_bytep>(raster.samples.data());
  if (raster.bits == 8) bytes += count;
  std::vector<png_bytep> rows(height);
  for (std::size_t y = 0; y < height; ++y) rows[y] = bytes + y * row_bytes;
  if (!read_pixels(reader, rows.data())) fail();
  if (source.offset != input.size()) {
    input.fail_at_byte(source.offset, {"trailing data",
                                       fmt::format("{} more bytes", input.size() - source.offset),
                                       "the end of the file",
                                       {}});
  }
  if (raster.bits == 8) {
    for (std::size_t k = 0; k < count; ++k) raster.samples[k] = bytes[k];
  }
  return raster;
}

Raster read_png(const std::filesystem::path& path, const RunContext* context) {
  return read_png(
      Input::open(path, context, Input::Excess::refused, detail::start_check(Format::png)));
}

void Raster::check() const {
  std::optional<std::size_t> count;
  if (width >= 0 && height >= 0 && channels >= 1 && channels <= 4)
    count = checked_product(static_cast<std::size_t>(width), static_cast<std::size_t>(height));
  if (count) count = checked_product(*count, static_cast<std::size_t>(channels));
  if (count == samples.size() && (bits == 8 || bits == 16)) return;
  throw Error(ErrorKind::bad_data,
              fmt::format("{}: found {} samples of {} bits for {} x {} pixels of {} channels, "
                          "expected one sample per pixel and channel, of 8 or 16 bits",
                          name, samples.size(), bits, width, height, channels));
}

void write_png(std::ostream& out, const Raster& raster) {
  raster.check();
  if (raster.width < 1 || raster.height < 1 || raster.width > kMaxSide || raster.height > kMaxSide)
    throw Error(ErrorKind::bad_data,
                fmt::format("{}: found {} x {} pixels, expected 1 to {} per side", raster.name,
                            raster.width, raster.height, kMaxSide));
  std::vector<png_byte> bytes(raster.samples.size() * static_cast<std::size_t>(raster.bits / 8));
  if (raster.bits == 16) {
    std::memcpy(bytes.data(), raster.samples.data(), bytes.size());
  } else {
    for (std::size_t k = 0; k < bytes.size(); ++k)
      bytes[k] = static_cast<png_byte>(raster.samples[k]);
  }
  const auto height = static_cast<std::size_t>(raster.height);
  std::vector<png_bytep> rows(height);
  for (std::size_t y = 0; y < height; ++y) rows[y] = bytes.data() + y * (bytes.size() / height);
  Report report;
  Writer writer;
  writer.png = png_create_write_struct_2(PNG_LIBPNG_VER_STRING, &report, &png_failed, &png_warned,
                                         &report, &png_allocate, &png_release);
  if (writer.png == nullptr) throw std::bad_alloc();
  writer.info = png_create_info_struct(writer.png);
  if (writer.info == nullptr) throw std::bad_alloc();
  if (!write_pixels(writer, out, raster, rows.data())) {
    if (report.out_of_memory) throw std::bad_alloc();
    throw Error(ErrorKind::io, "PNG: " + report.message);
  }
}

}  // namespace ph
