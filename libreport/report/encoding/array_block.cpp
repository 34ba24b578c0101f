// SPDX-License-Identifier: MIT
#include "ph/detail/report/array_block.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <new>
#include <vector>

#include "ph/detail/core/file_pages.hpp"
#include "ph/detail/io/base64.hpp"
#include "ph/error.hpp"
#include "ph/io/write.hpp"

namespace ph::report {
namespace {

/// Compresses bytes and writes them as text.
class DeflatedText {
 public:
  DeflatedText(const Sink& sink, const RunContext& context) : sink_(sink), context_(context) {
    if (deflateInit(&stream_, Z_DEFAULT_COMPRESSION) != Z_OK) throw std::bad_alloc();
  }
  ~DeflatedText() { deflateEnd(&stream_); }
  DeflatedText(const DeflatedText&) = delete;
  DeflatedText& operator=(const DeflatedText&) = delete;

  void put(std::uint8_t byte) {
    in_[filled_++] = byte;
    if (filled_ == in_.size()) compress(Z_NO_FLUSH);
  }
  void finish() {
    compress(Z_FINISH);
    std::string rest;
    base64_.finish(rest);
    sink_(rest);
  }

 private:
  void compress(int flush) {
    context_.poll();
    stream_.next_in = in_.data();
    stream_.avail_in = static_cast<uInt>(filled_);
    filled_ = 0;
    do {
      stream_.next_out = out_.data();
      stream_.avail_out = static_cast<uInt>(out_.size());
      if (deflate(&stream_, flush) == Z_STREAM_ERROR)
        throw Error(ErrorKind::internal, "report: zlib lost its state");
      text_.clear();
      const auto packed = std::span(out_).first(out_.size() - stream_.avail_out);
      base64_.append(std::as_bytes(packed), text_);
      sink_(text_);
    } while (stream_.avail_out == 0);
  }

  const Sink& sink_;
  const RunContext& context_;
  z_stream stream_{};
  detail::Base64 base64_;
  // Too large for the stack of a small thread.
  static constexpr std::size_t kBlock = std::size_t{1} << 15;
  std::vector<std::uint8_t> in_ = std::vector<std::uint8_t>(kBlock);
  std::vector<std::uint8_t> out_ = std::vector<std::uint8_t>(kBlock);
  std::size_t filled_ = 0;
  std::string text_;
};

/// Writes the numbers byte by byte in the order in which they are compressed. The lowest bytes of
/// all numbers come first, then their second bytes, and so on. With `delta`, each number is first
/// replaced by its difference from the same column of the previous row.
/// @param Word the unsigned integer type that is as wide as a number. Differences modulo its range
/// also work for signed numbers.
template <class Word>
void put_numbers(const RawArray& array, std::size_t columns, bool delta, DeflatedText& text) {
  constexpr std::size_t block = 1 << 17;
  const std::byte* const bytes = array.bytes.data();
  const std::size_t count = array.bytes.size() / sizeof(Word);
  const auto number = [&](std::size_t i) {
    Word word;
    std::memcpy(&word, bytes + i * sizeof(Word), sizeof(Word));
    return word;
  };
  const auto give_back = [&](std::size_t begin, std::size_t end) {
    // mutant: report-voxels
    forget_file_pages(bytes + begin * sizeof(Word), (end - begin) * sizeof(Word));
  };
  for (std::size_t plane = 0; plane < sizeof(Word); ++plane) {
    for (std::size_t begin = 0; begin < count; begin += block) {
      const std::size_t end = std::min(count, begin + block);
      for (std::size_t i = begin; i < end; ++i) {
        const Word before = delta && i >= columns ? number(i - columns) : Word{0};
        const auto stored = static_cast<Word>(number(i) - before);
        text.put(static_cast<std::uint8_t>(stored >> 8 * plane));
      }
      if (!array.is_in_file) continue;
      give_back(begin, end);
      if (delta && end > columns) give_back(begin - std::min(begin, columns), end - columns);
    }
  }
}

std::string numbers_text(std::string_view attribute, const std::vector<double>& numbers) {
  if (numbers.empty()) return {};
  std::string text;
  for (const double x : numbers) {
    text += text.empty() ? "" : ",";
    text += shortest(x);
  }
  return fmt::format(" data-{}=\"{}\"", attribute, text);
}

std::string filter_text(bool delta, bool planes) {
  if (!delta && !planes) return {};
  return fmt::format(" data-filter=\"{}{}{}\"", delta ? "delta" : "", delta && planes ? " " : "",
                     planes ? "planes" : "");
}

}  // namespace

void write_array(const Sink& sink, const RawArray& array, const ArrayForm& form,
                 const RunContext& context) {
  const std::size_t count = array.bytes.size() / array.width;
  std::vector<std::size_t> shape = form.shape;
  if (shape.empty()) shape.push_back(count);
  std::size_t columns = 1, numbers = shape.front();
  for (std::size_t axis = 1; axis < shape.size(); ++axis) columns *= shape[axis];
  numbers *= columns;
  if (numbers != count)
    throw Error(ErrorKind::internal, fmt::format("report: {}: found {} numbers, expected {}",
                                                 array.name, count, numbers));
  sink(fmt::format(
      "<script type=\"application/x-ph-array\" data-array=\"{}\" data-type=\"{}\" "
      "data-shape=\"{}\"{}{}{}>",
      array.name, array.type, fmt::join(shape, ","), filter_text(form.delta, array.width > 1),
      numbers_text("offset", form.offset), numbers_text("scale", form.scale)));
  {
    DeflatedText text(sink, context);
    switch (array.width) {
      case 1:
        put_numbers<std::uint8_t>(array, columns, form.delta, text);
        break;
      case 2:
        put_numbers<std::uint16_t>(array, columns, form.delta, text);
        break;
      case 4:
        put_numbers<std::uint32_t>(array, columns, form.delta, text);
        break;
      default:
        put_numbers<std::uint64_t>(array, columns, form.delta, text);
    }
    text.finish();
  }
  sink("</script>\n");
}

}  // namespace ph::report
