// SPDX-License-Identifier: MIT
#include "ph/detail/core/sealed_part.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <string>

#include "libph/src/core/bytes/crc32.hpp"
#include "ph/detail/core/byte_reader.hpp"
#include "ph/detail/core/byte_writer.hpp"
#include "ph/error.hpp"

namespace ph {
namespace {

constexpr std::string_view kMagic = "ph part\n";
constexpr std::size_t kKindSize = 8, kHeaderSize = 28, kChecksumSize = 4;
constexpr std::uint32_t kVersion = 1;

std::string_view text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

[[noreturn]] void refuse(const std::string& what) {
  throw Error(ErrorKind::bad_data, "part: " + what);
}

}  // namespace

std::vector<std::byte> sealed_part(std::string_view kind, std::span<const std::byte> content) {
  assert(kind.size() <= kKindSize);
  ByteWriter writer;
  for (const char c : kMagic) writer.put(c);
  for (std::size_t i = 0; i < kKindSize; ++i) writer.put(i < kind.size() ? kind[i] : ' ');
  writer.put(kVersion);
  writer.put(std::uint64_t{content.size()});
  std::vector<std::byte> bytes = writer.take();
  bytes.reserve(kHeaderSize + content.size() + kChecksumSize);
  bytes.insert(bytes.end(), content.begin(), content.end());
  ByteWriter checksum;
  checksum.put(crc32(bytes));
  std::ranges::copy(checksum.take(), std::back_inserter(bytes));
  return bytes;
}

bool is_sealed_part(std::span<const std::byte> bytes) { return text_of(bytes).starts_with(kMagic); }

std::string_view kind_of_part(std::span<const std::byte> bytes) {
  if (!is_sealed_part(bytes))
    refuse(fmt::format("found {} bytes that do not begin with \"ph part\"", bytes.size()));
  if (bytes.size() < kHeaderSize + kChecksumSize)
    refuse(fmt::format("found {} bytes, expected {} or more", bytes.size(),
                       kHeaderSize + kChecksumSize));
  ByteReader reader(bytes.subspan(kMagic.size() + kKindSize), "part");
  if (const auto version = reader.get<std::uint32_t>("version"); version != kVersion)
    refuse(fmt::format("found version {}, expected {}", version, kVersion));
  const auto size = reader.get<std::uint64_t>("size");
  if (const std::size_t rest = bytes.size() - kHeaderSize - kChecksumSize; size != rest)
    refuse(fmt::format("found {} bytes of content, expected {}: it is incomplete", rest, size));
  ByteReader end(bytes.last(kChecksumSize), "part");
  const auto expected = end.get<std::uint32_t>("checksum");
  // mutant: part-checksum
  if (const std::uint32_t found = crc32(bytes.first(bytes.size() - kChecksumSize));
      found != expected)
    refuse(fmt::format("found checksum {:08x}, expected {:08x}: it is damaged", found, expected));
  const std::string_view kind = text_of(bytes.subspan(kMagic.size(), kKindSize));
  return kind.substr(0, kind.find_last_not_of(' ') + 1);
}

std::span<const std::byte> content_of_part(std::span<const std::byte> bytes,
                                           std::string_view kind) {
  if (const std::string_view found = kind_of_part(bytes); found != kind)
    refuse(fmt::format("found kind '{}', expected kind '{}'", found, kind));
  return bytes.subspan(kHeaderSize, bytes.size() - kHeaderSize - kChecksumSize);
}

}  // namespace ph
