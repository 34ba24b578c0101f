// SPDX-License-Identifier: MIT
#include "libph/src/io/bytes/unpack.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <new>

#include "ph/detail/core/format_size.hpp"

namespace ph::detail {
namespace {

// The number of bytes unpacked between two checks.
constexpr std::size_t kStep = std::size_t{1} << 20;

// The state of zlib, and the compressed bytes that it reads.
class Inflater {
 public:
  /// @param window_bits as for inflateInit2: 31 for gzip, -15 for raw deflate.
  Inflater(std::string_view packed, int window_bits) : packed_(packed) {
    if (inflateInit2(&stream_, window_bits) != Z_OK) throw std::bad_alloc();
  }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
  ~Inflater() { inflateEnd(&stream_); }

  /// Unpacks up to `size` bytes. @return the number of bytes unpacked. If it is less than `size`,
  /// the stream has ended (see `ended`), is damaged (see `damage`), or is truncated.
  std::size_t unpack(char* to, std::size_t size) {
    std::size_t done = 0;
    while (done < size && !ended_ && damage_.empty()) {
      // The counts of zlib have 32 bits.
      const std::size_t in = std::min(packed_.size() - used_, std::size_t{1} << 30);
      const std::size_t out = std::min(size - done, std::size_t{1} << 30);
      stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed_.data() + used_));
      stream_.avail_in = static_cast<uInt>(in);
      stream_.next_out = reinterpret_cast<Bytef*>(to + done);
      stream_.avail_out = static_cast<uInt>(out);
      const int code = inflate(&stream_, Z_NO_FLUSH);
      const std::size_t taken = in - stream_.avail_in, given = out - stream_.avail_out;
      used_ += taken;
      done += given;
      if (code == Z_STREAM_END) {
        ended_ = true;
      } else if (code == Z_MEM_ERROR) {
        throw std::bad_alloc();
      } else if (code != Z_OK && code != Z_BUF_ERROR) {
        damage_ = stream_.msg != nullptr ? stream_.msg : "not deflate data";
      } else if (taken == 0 && given == 0) {
        break;  // the input ends before the stream ends
      }
    }
    return done;
  }
  /// Continues with the next member of a gzip file.
  void restart() {
    inflateReset(&stream_);
    ended_ = false;
  }

  std::size_t used() const { return used_; }
  bool ended() const { return ended_; }
  const std::string& damage() const { return damage_; }

 private:
  std::string_view packed_;
  std::size_t used_ = 0;
  bool ended_ = false;
  std::string damage_;
  z_stream stream_{};
};

// A buffer in a temporary file. Its pages leave memory once they are written.
class FileBuffer {
 public:
  explicit FileBuffer(std::size_t bytes) : file_(bytes) {}
  char* data() { return file_.data(); }
  std::size_t size() const { return size_; }
  std::size_t capacity() const { return file_.size(); }
  void resize(std::size_t bytes) {
    if (bytes > capacity()) file_.resize(std::max(bytes, capacity() + capacity() / 2));
    constexpr std::size_t many = std::size_t{1} << 24;
    if (bytes >= written_ + many) {
      forget_file_pages(file_.data() + written_, size_ - written_);
      written_ = size_;
    }
    size_ = bytes;
  }
  ScratchFile take() {
    file_.resize(size_);
    return std::move(file_);
  }

 private:
  ScratchFile file_;
  std::size_t size_ = 0, written_ = 0;
};

}  // namespace

bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1F\x8B"); }

std::pmr::memory_resource* memory_of(const Input& input) {
  return input.context() != nullptr ? &input.context()->memory : std::pmr::new_delete_resource();
}

std::size_t stated_size(std::string_view packed) {
  if (packed.size() < 18) return 0;
  const auto* trailer = reinterpret_cast<const std::byte*>(packed.data() + packed.size() - 4);
  return load<std::uint32_t>(trailer, std::endian::little);
}

namespace {

template <class Buffer>
void unpack_into(Buffer& bytes, const Packed& source, std::size_t most) {
  const auto& [input, offset, stated] = source;
  const std::string_view packed = input.text().substr(offset);
  const std::size_t reasonable =
      std::max(kMostFree, checked_product(packed.size(), kMostExpansion).value_or(SIZE_MAX));
  const bool is_zlib = !is_gzip(packed);
  const std::string_view kind = is_zlib ? "zlib" : "gzip";
  Inflater inflater(packed, is_zlib ? 15 : 15 + 16);
  for (;;) {
    input.poll();
    const std::size_t before = bytes.size();
    // If the stated size is too large, and the data unpacked so far have expanded by more than the
    // allowed factor, the rest is not unpacked. Unpacking it could only confirm the stated size.
    const bool goes_on = stated > reasonable && before / kMostExpansion > inflater.used();
    if (before >= reasonable || goes_on) {
      input.fail_at_byte(offset + inflater.used(),
                         {"compressed data expand too much",
                          fmt::format("more than {} MiB", (goes_on ? stated : before) >> 20),
                          fmt::format("at most {} times {} bytes", kMostExpansion, packed.size()),
                          "if this size is right, unpack the data first"});
    }
    if (before >= most) {
      throw Error(ErrorKind::resource,
                  fmt::format("{}: unpacks to more than the memory limit allows, {}",
                              mark_place(input.name()), format_size(static_cast<double>(most))));
    }
    const std::size_t room = std::max(std::min(bytes.capacity() - before, kStep), std::size_t{1});
    bytes.resize(before + std::min(room == 1 ? kStep : room, most - before));
    const std::size_t wanted = bytes.size() - before;
    const std::size_t done = inflater.unpack(bytes.data() + before, wanted);
    bytes.resize(before + done);
    if (!inflater.damage().empty()) {
      input.fail_at_byte(offset + inflater.used(), {fmt::format("damaged {} data", kind),
                                                    inflater.damage(),
                                                    fmt::format("{} data", kind),
                                                    {}});
    }
    if (!inflater.ended()) {
      if (done == wanted) continue;
      input.fail_at_byte(input.size(), {fmt::format("truncated {} data", kind),
                                        fmt::format("the end after {} bytes", packed.size()),
                                        "the end of the compressed stream",
                                        {}});
    }
    const std::string_view rest = packed.substr(inflater.used());
    if (rest.empty()) return;
    if (is_zlib || !is_gzip(rest)) {
      input.fail_at_byte(
          offset + inflater.used(),
          {fmt::format("trailing data after {} data", kind),
           fmt::format("{} more bytes", rest.size()),
           is_zlib ? "the end of the file" : "the end of the file or a further gzip member",
           {}});
    }
    inflater.restart();
  }
}

// The initial size of the buffer. It is about the stated size, but at most four times the packed
// size, because the stated size may be false. It is always larger than kStep.
std::size_t likely_size(const Packed& packed) {
  const std::size_t size = packed.input.size() - packed.offset;
  return std::clamp(packed.size, kStep, std::max(4 * size, kStep)) + 1;
}

}  // namespace

std::string unpacked_start(std::string_view packed, std::size_t most) {
  std::string start(most, '\0');
  start.resize(Inflater(packed, 15 + 16).unpack(start.data(), most));
  return start;
}

std::pmr::vector<char> unpack(const Packed& packed, std::size_t most) {
  std::pmr::vector<char> bytes(memory_of(packed.input));
  bytes.reserve(std::min(likely_size(packed), most));
  unpack_into(bytes, packed, most);
  return bytes;
}

ScratchFile unpack_to_file(const Packed& packed) {
  FileBuffer bytes(likely_size(packed));
  unpack_into(bytes, packed, SIZE_MAX);
  return bytes.take();
}

std::pmr::vector<char> inflate_raw(const Input& input, std::size_t offset, std::size_t packed_size,
                                   std::size_t size) {
  Inflater inflater(input.text().substr(offset, packed_size), -15);
  std::pmr::vector<char> bytes(memory_of(input));
  // The loop tries to unpack one byte more than the stated size, in order to notice any excess. The
  // buffer grows with the data.
  for (;;) {
    input.poll();
    const std::size_t before = bytes.size();
    const std::size_t wanted = std::min(std::max(before, kStep), size + 1 - before);
    if (before + wanted > size) bytes.reserve(size + 1);
    bytes.resize(before + wanted);
    const std::size_t done = inflater.unpack(bytes.data() + before, wanted);
    bytes.resize(before + done);
    if (!inflater.damage().empty()) {
      input.fail_at_byte(offset + inflater.used(),
                         {"damaged deflate data", inflater.damage(), "deflate data", {}});
    }
    if (inflater.ended() || done < wanted || bytes.size() > size) break;
  }
  if (!inflater.ended() || bytes.size() != size || inflater.used() != packed_size) {
    input.fail_at_byte(offset, {"wrong sizes of compressed data",
                                fmt::format("{} bytes from {}", bytes.size(), inflater.used()),
                                fmt::format("{} bytes from {}", size, packed_size),
                                {}});
  }
  return bytes;
}

std::size_t inflate_zlib(const Input& input, std::size_t offset, std::size_t packed_size,
                         std::span<std::byte> to, bool& more) {
  Inflater inflater(input.text().substr(offset, packed_size), 15);
  const std::size_t done = inflater.unpack(reinterpret_cast<char*>(to.data()), to.size());
  char next = 0;
  more = done == to.size() && inflater.unpack(&next, 1) == 1;
  const bool is_whole = inflater.ended() || more;
  if (!inflater.damage().empty()) {
    input.fail_at_byte(offset + inflater.used(),
                       {"damaged zlib data", inflater.damage(), "zlib data", {}});
  }
  if (!is_whole) {
    input.fail_at_byte(offset + packed_size, {"truncated zlib data",
                                              fmt::format("the end after {} bytes", packed_size),
                                              "the end of the compressed stream",
                                              {}});
  }
  return done;
}

std::uint32_t checksum(std::span<const char> bytes) {
  return static_cast<std::uint32_t>(
      crc32_z(crc32_z(0, nullptr, 0), reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace ph::detail
