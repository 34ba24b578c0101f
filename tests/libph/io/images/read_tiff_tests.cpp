// SPDX-License-Identifier: MIT
#include <map>
#include <string>
#include <vector>

#include "tests/libph/io/images/tiff_file.hpp"

namespace ph::test {
namespace {

// LZW as in section 13 of TIFF 6.0.
std::string lzw(const std::string& bytes) {
  std::map<std::string, std::uint32_t> codes;
  std::string out, string;
  std::uint32_t next = 258, waiting = 0;
  int width = 9, bits = 0;
  const auto put = [&](std::uint32_t code) {
    waiting = waiting << width | code;
    for (bits += width; bits >= 8; bits -= 8) out += static_cast<char>(waiting >> (bits - 8));
  };
  const auto code_of = [&](const std::string& s) {
    return s.size() == 1 ? std::uint32_t{static_cast<unsigned char>(s[0])} : codes.at(s);
  };
  put(256);
  for (const char byte : bytes) {
    if (string.empty() || codes.contains(string + byte)) {
      string += byte;
      continue;
    }
    put(code_of(string));
    codes[string + byte] = next++;
    string = byte;
    if (next == 4095) {
      put(256);
      codes.clear();
      next = 258;
      width = 9;
    } else if (next == 1U << width) {
      ++width;
    }
  }
  if (!string.empty()) {
    put(code_of(string));
    if (++next == 1U << width && width < 12) ++width;
  }
  put(257);
  if (bits > 0) out += static_cast<char>(waiting << (8 - bits));
  return out;
}

TEST(ReadTiff, EveryTypeInBothByteOrdersAndSizesOfOffsets) {
  for (const bool big_endian : {false, true}) {
    for (const bool bigtiff : {false, true}) {
      const auto check = [&]<class T>(T, std::uint64_t format) {
        Page page{.strips = {strip<T>(kSix, big_endian)}, .description = {}};
        page.fields[258] = {8 * sizeof(T)};
        page.fields[339] = {format};
        const Image image = image_in(Tiff{big_endian, bigtiff, {page}}.bytes());
        EXPECT_EQ(image.extents, (std::vector<Index>{2, 3}));
        EXPECT_EQ(image.values, kSix) << sizeof(T) << ' ' << format;
      };
      check(std::uint8_t{}, 1);
      check(std::uint16_t{}, 1);
      check(std::uint32_t{}, 1);
      check(std::uint64_t{}, 1);
      check(std::uint8_t{}, 4);  // an unknown format
      check(std::int8_t{}, 2);
      check(std::int16_t{}, 2);
      check(std::int32_t{}, 2);
      check(std::int64_t{}, 2);
      check(float{}, 3);
      check(double{}, 3);
    }
  }
  // 1.5 and -2 as half floats
  EXPECT_EQ(image_in(changed([](Page& page) {
              page.fields[256] = {2};
              page.fields[257] = {1};
              page.fields[258] = {16};
              page.fields[339] = {3};
              page.strips = {std::string("\0\x3E\0\xC0", 4)};
            })).values,
            (std::vector<double>{1.5, -2}));
  EXPECT_EQ(image_in(changed([](Page& page) {
              page.fields[256] = {9};
              page.fields[258] = {1};
              page.strips = {std::string("\xA0\x80\x01\0", 4)};
            })).values,
            (std::vector<double>{1, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1, 0}));
}

TEST(ReadTiff, Compressions) {
  const std::string six = strip<std::uint8_t>(kSix, false);
  const auto packed = [](std::uint64_t compression, const std::string& data) {
    return changed([&](Page& page) {
      page.fields[259] = {compression};
      page.strips = {data};
    });
  };
  EXPECT_EQ(image_in(packed(8, zipped(six))).values, kSix);
  EXPECT_EQ(image_in(packed(32946, zipped(six))).values, kSix);
  EXPECT_EQ(image_in(packed(5, lzw(six))).values, kSix);
  // Three literal bytes, nothing, one byte three times.
  EXPECT_EQ(image_in(packed(32773, std::string("\2\0\5\2\x80\xFE\7", 7))).values,
            (std::vector<double>{0, 5, 2, 7, 7, 7}));
  // Strings of codes of all widths, and full tables.
  std::string many;
  std::uint32_t random = 1;
  for (int k = 0; k < 40'000; ++k) {
    random = random * 1664525 + 1013904223;
    many += k < 20'000 ? static_cast<char>(random >> 24) : static_cast<char>((k / 500) % 3);
  }
  const Image image = image_in(changed([&](Page& page) {
    page.fields[256] = {200};
    page.fields[257] = {200};
    page.fields[259] = {5};
    page.fields[278] = {100};
    page.strips = {lzw(many.substr(0, 20'000)), lzw(many.substr(20'000))};
  }));
  for (std::size_t k = 0; k < many.size(); ++k)
    ASSERT_EQ(image.values[k], static_cast<unsigned char>(many[k])) << k;
  const ReadResult more = read_tiff(packed(8, zipped(six + "x")));
  ASSERT_EQ(more.notes.size(), 1U);
  EXPECT_TRUE(contains(more.notes[0].str(), "more data"));
}

TEST(ReadTiff, Predictors) {
  // Differences along each row of 3 pixels.
  const std::vector<double> differences{0, 5, -3, 4, 5, -8};
  const auto check = [&]<class T>(T) {
    for (const bool big : {false, true}) {
      std::vector<double> stored = differences;
      std::string raw;
      for (const double number : stored) {
        std::string one = le(static_cast<T>(static_cast<std::int64_t>(number)));
        if (big) std::reverse(one.begin(), one.end());
        raw += one;
      }
      Page page{.strips = {zipped(raw)}, .description = {}};
      page.fields[258] = {8 * sizeof(T)};
      page.fields[259] = {8};
      page.fields[317] = {2};
      EXPECT_EQ(image_in(Tiff{.big_endian = big, .pages = {page}}.bytes()).values, kSix)
          << sizeof(T);
    }
  };
  check(std::uint8_t{});
  check(std::uint16_t{});
  check(std::uint32_t{});
  check(std::uint64_t{});
  // Floats: the four planes of bytes, highest first, then differences of the bytes.
  std::string planes;
  for (int byte = 3; byte >= 0; --byte)
    for (const double number : {0.5, -2.0, 3.25})
      planes += le(static_cast<float>(number))[static_cast<std::size_t>(byte)];
  for (std::size_t k = planes.size(); k-- > 1;)
    planes[k] = static_cast<char>(planes[k] - planes[k - 1]);
  EXPECT_EQ(image_in(changed([&](Page& page) {
              page.fields[257] = {1};
              page.fields[258] = {32};
              page.fields[259] = {8};
              page.fields[317] = {3};
              page.fields[339] = {3};
              page.strips = {zipped(planes)};
            })).values,
            (std::vector<double>{0.5, -2, 3.25}));
}

TEST(ReadTiff, StripsAndTiles) {
  EXPECT_EQ(image_in(changed([](Page& page) {
              page.fields[278] = {1};
              page.strips = {std::string("\0\5\2", 3), "\4\x9\1"};
            })).values,
            kSix);
  // Four tiles of 2 x 2, which extend beyond the right end. Bytes there are not read.
  EXPECT_EQ(image_in(changed([](Page& page) {
              page.fields.erase(278);
              page.fields[257] = {3};
              page.fields[322] = {2};
              page.fields[323] = {2};
              page.strips = {std::string("\0\5\4\x9", 4), "\2z\1z", "\7\x8zz", "\6zzz"};
            })).values,
            (std::vector<double>{0, 5, 2, 4, 9, 1, 7, 8, 6}));
}

TEST(ReadTiff, OtherKindsAreNamedWithAWayOut) {
  const auto message = [](int tag, std::vector<std::uint64_t> values) {
    return bad_data([&] { image_in(changed([&](Page& page) { page.fields[tag] = values; })); });
  };
  EXPECT_TRUE(contains(message(259, {7}), "compression, found 7 (JPEG)"));
  EXPECT_TRUE(contains(message(259, {34712}), "JPEG 2000"));
  EXPECT_TRUE(contains(message(259, {50000}), "Zstandard"));
  EXPECT_TRUE(contains(message(259, {4}), "CCITT Group 4"));
  EXPECT_TRUE(contains(message(259, {99}), "found 99, expected none, LZW, Deflate or PackBits"));
  EXPECT_TRUE(contains(message(259, {7}), "save it again"));
  EXPECT_TRUE(contains(message(262, {3}), "a palette of colours"));
  EXPECT_TRUE(contains(message(262, {6}), "YCbCr"));
  EXPECT_TRUE(contains(message(258, {12}), "12 bits"));
  EXPECT_TRUE(contains(message(339, {6}), "complex numbers"));
  EXPECT_TRUE(contains(message(277, {5}), "save each channel"));
  EXPECT_TRUE(contains(message(266, {2}), "lowest bit first"));
}

TEST(ReadTiff, RefusesDamage) {
  check_prefixes(
      bytes_of(page_of_bytes()), "a.tif", [](const Input& in) { read_image(in); }, never());
  const auto with = [](int tag, std::vector<std::uint64_t> values) {
    return changed([&](Page& page) { page.fields[tag] = values; });
  };
  const auto without = [](int tag) { return changed([&](Page& page) { page.fields.erase(tag); }); };
  const auto packed = [](std::uint64_t compression, const std::string& data) {
    return changed([&](Page& page) {
      page.fields[259] = {compression};
      page.strips = {data};
    });
  };
  Tiff loop{.pages = {page_of_bytes(), page_of_bytes()}};
  loop.last_link = 14;
  Tiff odd{.bigtiff = true, .pages = {page_of_bytes()}};
  std::string other_offset = odd.bytes();
  other_offset[4] = 4;
  const std::string six = strip<std::uint8_t>(kSix, false);
  expect_refused(
      "a.tif",
      {std::string("II*\0\0\0\0\0", 8), loop.bytes(), other_offset, with(256, {0}), with(256, {4}),
       with(256, {0x80000001}), with(256, {3, 3}), with(257, {3}), with(278, {0}), with(278, {1}),
       with(317, {4}), with(258, {8, 16}), without(256), without(257), changed([](Page& page) {
         page.fields[257] = {0x80000000};
         page.fields[256] = {0x80000000};
       }),
       changed([](Page& page) { page.strips.clear(); }), packed(8, six),
       packed(8, zipped(six).substr(0, 9)), packed(8, zipped(six.substr(1))), packed(5, six),
       packed(5, lzw(six.substr(1))), packed(5, lzw(six).substr(0, 5)),
       packed(5, std::string("\0\1", 2)),
       // The first code after the table is cleared is 300.
       packed(5, "\x80\x25\x80\x80\x80\x80"), packed(32773, std::string("\5\0\5\2", 4)),
       packed(32773, "\xFB"), changed([](Page& page) {
         page.fields[259] = {8};
         page.fields[317] = {3};
         page.strips = {zipped(page.strips[0])};
       }),
       changed([](Page& page) {
         page.fields[258] = {64};
         page.fields[256] = {1};
         page.fields[257] = {1};
         page.strips = {le(std::uint64_t{9'007'199'254'740'993})};
       })});
}

TEST(ReadTiff, KeepsToTheBudget) {
  const auto file = [](std::uint64_t compression) {
    const std::string rows(4'000'000, '\1');
    return changed([&](Page& page) {
      page.fields[256] = page.fields[257] = {2000};
      page.fields[278] = {1000};
      page.fields[259] = {compression};
      page.strips.clear();
      for (const std::size_t begin : {0, 2'000'000}) {
        const std::string part = rows.substr(begin, 2'000'000);
        page.strips.push_back(compression == 1 ? part : zipped(part));
      }
    });
  };
  for (const std::uint64_t compression : {1, 8}) {
    RunContext context;
    context.memory.set_limit(std::size_t{9} << 20);
    const Image image =
        read_image(held(file(compression), "a.tif", context), {.context = &context});
    EXPECT_EQ(image.values[3'999'999], 1);
    context.memory.set_limit(std::size_t{1} << 20);
    if (compression == 8) {
      EXPECT_TRUE(fails_with(ErrorKind::resource, [&] {
        read_image(held(file(compression), "a.tif", context), {.context = &context});
      }));
    }
  }
}

}  // namespace
}  // namespace ph::test
