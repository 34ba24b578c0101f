// SPDX-License-Identifier: MIT
#pragma once
#include <gtest/gtest.h>
#include <zlib.h>

#include <string>

namespace ph::test {

/// The bytes compressed by zlib. @param window_bits zlib's parameter, which also selects the
/// format.
inline std::string packed(const std::string& bytes, int level, int window_bits) {
  std::string out(compressBound(static_cast<uLong>(bytes.size())) + 64, '\0');
  z_stream stream{};
  EXPECT_EQ(deflateInit2(&stream, level, Z_DEFLATED, window_bits, 8, Z_DEFAULT_STRATEGY), Z_OK);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

inline std::string gzipped(const std::string& bytes, int level = 9) {
  return packed(bytes, level, 15 + 16);
}

/// The bytes compressed as one zlib stream.
inline std::string zipped(const std::string& bytes) { return packed(bytes, 6, 15); }

/// The bytes compressed without a header, as in ZIP.
inline std::string deflated(const std::string& bytes) { return packed(bytes, 6, -15); }

}  // namespace ph::test
