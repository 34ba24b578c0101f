// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "libph/src/io/bytes/readers.hpp"
#include "libph/src/io/bytes/unpack.hpp"

// An NPZ is a zip archive of NPY files. The central directory at the end of the file lists the
// members. Local headers are used only to find the data.

namespace ph::detail {
namespace {

constexpr std::string_view kLocal{"PK\x03\x04", 4};
constexpr std::string_view kCentral{"PK\x01\x02", 4};
constexpr std::string_view kEnd{"PK\x05\x06", 4};
constexpr std::size_t kEndSize = 22, kMostComment = 65535;
constexpr std::size_t kLocalSize = 30;
constexpr std::uint32_t kIn64 = 0xFFFFFFFF;  // the number is in the zip64 record
constexpr std::uint16_t kZip64 = 1;          // the id of the zip64 record
constexpr std::uint16_t kStored = 0, kDeflated = 8;

struct Member {
  std::string name;
  // The position of the member's record in the central directory.
  std::size_t header_at = 0;
  std::uint16_t flags = 0, method = 0;
  std::uint32_t crc = 0;
  std::size_t packed = 0, size = 0, local_at = 0;

  std::string array() const {
    return name.ends_with(".npy") ? name.substr(0, name.size() - 4) : name;
  }
};

void expect_signature(BinaryCursor& cursor, std::string_view signature, const char* what) {
  const std::size_t at = cursor.offset();
  const auto found = cursor.take(signature.size(), what);
  if (std::memcmp(found.data(), signature.data(), signature.size()) != 0) {
    cursor.input().fail_at_byte(at, {fmt::format("damaged archive: no {}", what),
                                     printable(cursor.input().text().substr(at, 4)),
                                     printable(signature),
                                     {}});
  }
}

// Reads the sizes and the offset that need more than 32 bits. The record contains only these
// numbers, in the order of the loop below.
void read_zip64(BinaryCursor extra, std::size_t end, Member& member) {
  while (extra.offset() + 4 <= end) {
    const auto id = extra.read<std::uint16_t>("extra field");
    const auto length = extra.read<std::uint16_t>("extra field");
    if (id != kZip64) {
      extra.take(length, "extra field");
      continue;
    }
    for (std::size_t* number : {&member.size, &member.packed, &member.local_at}) {
      if (*number == kIn64) *number = extra.read<std::uint64_t>("zip64 sizes");
    }
    return;
  }
}

std::vector<Member> directory_of(const Input& input) {
  const std::string_view text = input.text();
  const std::size_t from = text.size() - std::min(text.size(), kEndSize + kMostComment);
  const std::size_t found = text.substr(from).rfind(kEnd);
  if (found == std::string_view::npos || text.size() - from - found < kEndSize) {
    if (text.size() >= kLocal.size() && !is_npz(input))
      input.fail_at_byte(0, {"not an NPZ archive", "a different magic number", "PK\\x03\\x04", {}});
    input.fail_at_byte(
        text.size(),
        {"truncated archive", "no directory at its end", "a zip archive of .npy files", {}});
  }
  BinaryCursor end(input, std::endian::little, from + found + kEnd.size());
  end.take(4, "disk numbers");
  end.take(2, "number of entries");
  const auto entries = end.read<std::uint16_t>("number of entries");
  const std::size_t size = end.read<std::uint32_t>("size of the directory");
  const std::size_t begin = end.read<std::uint32_t>("offset of the directory");
  const std::size_t comment = end.read<std::uint16_t>("length of the comment");
  end.take(comment, "comment");
  end.expect_end();
  if (begin + size > from + found) {
    input.fail_at_byte(from + found, {"damaged archive: the directory does not fit the file",
                                      fmt::format("{} bytes at byte {}", size, begin),
                                      fmt::format("its end before byte {}", from + found),
                                      "archives above 4 GiB are not read"});
  }
  std::vector<Member> members;
  BinaryCursor cursor(input, std::endian::little, begin);
  for (std::size_t i = 0; i < entries; ++i) {
    Member member;
    member.header_at = cursor.offset();
    expect_signature(cursor, kCentral, "directory entry");
    cursor.take(4, "versions");
    member.flags = cursor.read<std::uint16_t>("flags");
    member.method = cursor.read<std::uint16_t>("method");
    cursor.take(4, "time");
    member.crc = cursor.read<std::uint32_t>("checksum");
    member.packed = cursor.read<std::uint32_t>("packed size");
    member.size = cursor.read<std::uint32_t>("size");
    const std::size_t name = cursor.read<std::uint16_t>("length of the name");
    const std::size_t extra = cursor.read<std::uint16_t>("length of the extra field");
    const std::size_t remark = cursor.read<std::uint16_t>("length of the comment");
    cursor.take(8, "attributes");
    member.local_at = cursor.read<std::uint32_t>("offset of the member");
    const auto bytes = cursor.take(name, "name of a member");
    member.name.assign(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const std::size_t extra_at = cursor.offset();
    cursor.take(extra + remark, "extra field");
    read_zip64(BinaryCursor(input, std::endian::little, extra_at), extra_at + extra, member);
    members.push_back(std::move(member));
  }
  if (cursor.offset() != begin + size) {
    input.fail_at_byte(cursor.offset(), {"damaged archive: the directory ends elsewhere",
                                         fmt::format("byte {}", cursor.offset()),
                                         fmt::format("byte {}", begin + size),
                                         {}});
  }
  return members;
}

const Member& chosen(const Input& input, const std::vector<Member>& members) {
  if (input.member().empty() && members.size() == 1) return members.front();
  std::vector<std::string> names;
  for (const Member& member : members) {
    if (!input.member().empty() &&
        (member.array() == input.member() || member.name == input.member()))
      return member;
    names.push_back(printable(member.array(), 40));
  }
  refuse_members(input, std::move(names), "the archive");
}

}  // namespace

bool is_npz(const Input& input) { return input.text().starts_with(kLocal); }

Input read_npz_member(const Input& input) {
  const std::vector<Member> members = directory_of(input);
  const Member& member = chosen(input, members);
  const std::string name = fmt::format("{}:{}", input.name(), printable(member.array(), 200));
  if ((member.flags & 1U) != 0) {
    input.fail_at_byte(member.header_at, {"an encrypted member", name, "an unencrypted one", {}});
  }
  if (member.local_at > input.size()) {
    input.fail_at_byte(member.header_at, {"damaged archive: offset of a member",
                                          fmt::format("{}", member.local_at),
                                          fmt::format("at most {}", input.size()),
                                          {}});
  }
  BinaryCursor cursor(input, std::endian::little, member.local_at);
  expect_signature(cursor, kLocal, "member");
  cursor.take(kLocalSize - kLocal.size() - 4, "header of a member");
  const std::size_t lengths = std::size_t{cursor.read<std::uint16_t>("length of a name")} +
                              cursor.read<std::uint16_t>("length of an extra field");
  cursor.take(lengths, "header of a member");
  const std::size_t data_at = cursor.offset();
  cursor.take(member.packed, "member");
  // Deflate expands one byte to at most 1032 bytes.
  const bool possible =
      member.method == kStored ? member.size == member.packed : member.size / 1032 <= member.packed;
  if (!possible) {
    input.fail_at_byte(member.header_at, {"sizes of a member do not fit",
                                          fmt::format("{} bytes in {}", member.size, member.packed),
                                          "sizes that its method allows",
                                          {}});
  }
  if (member.size > std::max(kMostFree, member.packed * kMostExpansion)) {
    input.fail_at_byte(member.header_at, {"compressed data expand too much",
                                          fmt::format("{} bytes in {}", member.size, member.packed),
                                          fmt::format("at most {} times as many", kMostExpansion),
                                          "if this size is right, save the array as .npy"});
  }
  std::pmr::vector<char> bytes(memory_of(input));
  if (member.method == kStored) {
    const std::string_view stored = input.text().substr(data_at, member.size);
    bytes.assign(stored.begin(), stored.end());
  } else if (member.method == kDeflated) {
    input.require_memory(member.size);
    bytes = inflate_raw(input, data_at, member.packed, member.size);
  } else {
    input.fail_at_byte(
        member.header_at,
        {"compression method", fmt::format("{}", member.method), "0 (stored) or 8 (deflated)", {}});
  }
  if (checksum(bytes) != member.crc) {
    input.fail_at_byte(data_at, {"damaged member: wrong checksum",
                                 fmt::format("{:08x}", checksum(bytes)),
                                 fmt::format("{:08x}", member.crc),
                                 {}});
  }
  return Input::hold(std::move(bytes), name, input.context());
}

}  // namespace ph::detail
