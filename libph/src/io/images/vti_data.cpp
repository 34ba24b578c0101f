// SPDX-License-Identifier: MIT
#include "libph/src/io/images/vti_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>

#include "libph/src/io/bytes/unpack.hpp"
#include "libph/src/io/images/markup.hpp"
#include "ph/detail/io/base64.hpp"

namespace ph::detail {
namespace {

// The bytes of an array, one after another.
class ArrayBytes {
 public:
  ArrayBytes(const Input& input, const VtiBytes& place, std::endian order)
      : input_(input),
        place_(place),
        order_(order),
        at_(place.begin),
        digits_(input.text().substr(place.begin, place.end - place.begin)) {}

  /// The place in the file of the next byte, or of the digits after the last byte.
  std::size_t at() const { return place_.is_base64 ? place_.begin + digits_.used() : at_; }
  /// There are at most this many more bytes.
  std::size_t most() const {
    const std::size_t there = place_.end - at();
    return place_.is_base64 ? there / 4 * 3 + 2 : there;
  }

  void take(std::span<std::byte> to) {
    if (to.size() > most()) refuse(to.size());
    if (!place_.is_base64) {
      std::memcpy(to.data(), input_.text().data() + at_, to.size());
      at_ += to.size();
      return;
    }
    constexpr std::size_t kStep = std::size_t{1} << 20;
    for (std::size_t done = 0; done < to.size(); done += kStep) {
      const auto step = to.subspan(done, std::min(kStep, to.size() - done));
      input_.poll();
      if (digits_.read(step) == step.size()) continue;
      if (digits_.ended()) refuse(step.size());
      input_.fail_at_byte(at(), {"damaged Base64 data",
                                 '"' + printable(input_.text().substr(at(), 4)) + '"',
                                 "four Base64 digits",
                                 {}});
    }
  }

  std::size_t take_count() {
    std::array<std::byte, 8> raw{};
    take(std::span(raw).first(place_.count_size));
    return place_.count_size == 8 ? static_cast<std::size_t>(load<std::uint64_t>(&raw[0], order_))
                                  : load<std::uint32_t>(&raw[0], order_);
  }

  /// Leaves out raw bytes.
  void skip(std::size_t bytes) {
    if (bytes > most()) refuse(bytes);
    at_ += bytes;
  }

  /// Refuses a number of bytes, because the data end before it.
  [[noreturn]] void refuse(std::size_t bytes) const {
    input_.fail_at_byte(at(), {"truncated array",
                               fmt::format("at most {} more bytes", most()),
                               fmt::format("{}", bytes),
                               {}});
  }

  void expect_end() const {
    if (!place_.is_last) return;
    const std::size_t next = input_.text().find_first_not_of(kXmlSpace, at());
    if (next < place_.end || (place_.is_base64 && digits_.has_more()))
      input_.fail_at_byte(at(), {"trailing data",
                                 fmt::format("{} more characters", place_.end - at()),
                                 "the end of the array",
                                 {}});
  }

 private:
  const Input& input_;
  const VtiBytes& place_;
  std::endian order_;
  std::size_t at_;
  Base64Digits digits_;
};

// The blocks of zlib data.
struct Blocks {
  std::size_t size_each = 0;       // the unpacked size of all blocks but the last one
  std::vector<std::size_t> sizes;  // the packed size of each block
};

void expect_size(const Input& input, std::size_t at, std::optional<std::size_t> stated,
                 std::optional<std::size_t> needed) {
  const auto text = [](std::optional<std::size_t> bytes) {
    return bytes ? fmt::format("{} bytes", *bytes) : "more than 2^64 bytes";
  };
  if (stated && stated == needed) return;
  const bool is_less = stated && (!needed || *stated < *needed);
  input.fail_at_byte(at, {is_less ? "truncated: the array does not fit the extents"
                                  : "trailing data: the array does not fit the extents",
                          text(stated),
                          text(needed),
                          {}});
}

Blocks read_blocks(const Input& input, ArrayBytes& bytes, std::size_t count_size,
                   std::optional<std::size_t> needed) {
  const std::size_t at = bytes.at();
  const std::size_t count = bytes.take_count();
  Blocks blocks{bytes.take_count(), {}};
  const std::size_t last = bytes.take_count();  // 0 if the last block is as large as the others
  std::optional<std::size_t> stated = checked_product(count, blocks.size_each);
  if (last > blocks.size_each || count == 0) stated = 0;
  if (stated && last > 0 && count > 0) *stated -= blocks.size_each - last;
  expect_size(input, at, stated, needed);
  if (count > bytes.most() / count_size) bytes.refuse(count);
  std::size_t packed = 0;
  for (std::size_t k = 0; k < count; ++k) {
    blocks.sizes.push_back(bytes.take_count());
    packed += std::min(blocks.sizes.back(), input.size());
  }
  if (packed > bytes.most()) bytes.refuse(packed);
  // Deflate expands one byte to at most 1032 bytes.
  if (*needed / 1032 > packed || *needed > std::max(kMostFree, packed * kMostExpansion)) {
    input.fail_at_byte(
        at, {"compressed data expand too much", fmt::format("{} bytes in {}", *needed, packed),
             fmt::format("at most {} times as many", kMostExpansion),
             "if this size is right, save the array as .npy"});
  }
  return blocks;
}

void unpack_blocks(const Input& input, ArrayBytes& bytes, bool is_base64, const Blocks& blocks,
                   std::span<std::byte> to) {
  for (std::size_t k = 0; k < blocks.sizes.size(); ++k) {
    const auto block = to.subspan(k * blocks.size_each,
                                  std::min(blocks.size_each, to.size() - k * blocks.size_each));
    const std::size_t at = bytes.at();
    const std::size_t packed = blocks.sizes[k];
    bool more = false;
    std::size_t done = 0;
    input.poll();
    if (is_base64) {
      std::pmr::vector<char> held(packed, memory_of(input));
      bytes.take(std::as_writable_bytes(std::span(held)));
      const Input decoded = Input::hold(
          std::move(held), fmt::format("{}, block {} of the array", input.name(), k + 1));
      done = inflate_zlib(decoded, 0, packed, block, more);
    } else {
      bytes.skip(packed);
      done = inflate_zlib(input, at, packed, block, more);
    }
    if (more || done != block.size()) {
      input.fail_at_byte(at, {fmt::format("wrong size of block {}", k + 1),
                              more ? "more bytes" : fmt::format("{} bytes", done),
                              fmt::format("{}", block.size()),
                              {}});
    }
  }
}

// ArrayBytes that `fill` writes. They are in memory, or in a temporary file if they are too large.
Input held(const Input& input, std::size_t size,
           const std::function<void(std::span<std::byte>)>& fill) {
  if (stays_in_file(input, size)) {
    ScratchFile file(size);
    fill({reinterpret_cast<std::byte*>(file.data()), size});
    return Input::hold(std::move(file), input.name(), input.context());
  }
  input.require_memory(size);
  std::pmr::vector<char> bytes(size, memory_of(input));
  fill(std::as_writable_bytes(std::span(bytes)));
  return Input::hold(std::move(bytes), input.name(), input.context());
}

}  // namespace

Image load_vti(const Input& input, const VtiBytes& place, const StoredVolume& volume) {
  const ElementType type = *element_type(volume.kind);
  const std::optional<std::size_t> needed = bytes_of(volume, type.size);
  ArrayBytes bytes(input, place, volume.order);
  if (place.is_packed) {
    const Blocks blocks = read_blocks(input, bytes, place.count_size, needed);
    return load_numbers(held(input, *needed,
                             [&](std::span<std::byte> to) {
                               unpack_blocks(input, bytes, place.is_base64, blocks, to);
                               bytes.expect_end();
                             }),
                        volume);
  }
  const std::size_t at = bytes.at();
  expect_size(input, at, bytes.take_count(), needed);
  if (*needed > bytes.most()) bytes.refuse(*needed);
  if (place.is_base64) {
    return load_numbers(held(input, *needed,
                             [&](std::span<std::byte> to) {
                               bytes.take(to);
                               bytes.expect_end();
                             }),
                        volume);
  }
  const std::size_t first = bytes.at();
  bytes.skip(*needed);
  bytes.expect_end();
  return load_elements(input, {type, volume.order, true, first}, volume.extents,
                       Input::Excess::stays_in_file);
}

}  // namespace ph::detail
