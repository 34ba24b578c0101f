// SPDX-License-Identifier: MIT
#include <algorithm>
#include <string>
#include <vector>

#include "ph/io/read.hpp"
#include "tests/libph/io/images/volume_numbers.hpp"
#include "tests/libph/io/packed.hpp"
#include "tests/libph/io/read_support.hpp"

namespace ph::test {
namespace {

std::string header(const std::string& type, const std::string& lines,
                   const std::string& file = "LOCAL") {
  return "ObjectType = Image\nNDims = 2\nDimSize = 2 3\nElementType = " + type + '\n' + lines +
         "ElementDataFile = " + file + '\n';
}

const std::string kSix = six<std::uint8_t>(false);

ReadResult read_bytes(const std::string& bytes) {
  return read_any(Input::hold({bytes.begin(), bytes.end()}, "a.mha"));
}

std::string bytes_with(const std::string& lines) { return header("MET_UCHAR", lines) + kSix; }

TEST(ReadMetaImage, EveryTypeInBothByteOrders) {
  const auto check = [&]<class T>(T, const std::string& name) {
    for (const bool big : {false, true}) {
      for (const char* key : {"ElementByteOrderMSB = ", "BinaryDataByteOrderMSB = "}) {
        const std::string order = std::string(key) + (big ? "True\n" : "False\n");
        const Image image = image_of(header(name, order) + six<T>(big), "a.mha");
        EXPECT_EQ(image.extents, (std::vector<Index>{2, 3})) << name;
        EXPECT_EQ(image.values, kByRows) << name;
      }
    }
    EXPECT_EQ(image_of(header(name, "") + six<T>(false), "a.mha").values, kByRows);
    EXPECT_EQ(image_of(header(name, "BinaryData = False\n") + "0 10 1 11 2 12", "a.mha").values,
              kByRows);
  };
  check(std::int8_t{}, "MET_CHAR");
  check(std::uint8_t{}, "MET_UCHAR");
  check(std::int16_t{}, "MET_SHORT");
  check(std::uint16_t{}, "MET_USHORT");
  check(std::int32_t{}, "MET_INT");
  check(std::uint32_t{}, "MET_UINT");
  check(std::int32_t{}, "MET_LONG");
  check(std::uint32_t{}, "MET_ULONG");
  check(std::int64_t{}, "MET_LONG_LONG");
  check(std::uint64_t{}, "MET_ULONG_LONG");
  check(float{}, "MET_FLOAT");
  check(double{}, "MET_DOUBLE");
}

TEST(ReadMetaImage, CompressedData) {
  const std::string packed = zipped(kSix), size = std::to_string(packed.size());
  for (const std::string& lines : {std::string("CompressedData = True\n"),
                                   "CompressedData = True\nCompressedDataSize = " + size + '\n',
                                   std::string("CompressedData = 1\nCompressedDataSize = 0\n")})
    EXPECT_EQ(image_of(header("MET_UCHAR", lines) + packed, "a.mha").values, kByRows) << lines;
  EXPECT_EQ(
      image_of(header("MET_UCHAR", "CompressedData = True\n") + gzipped(kSix), "a.mha").values,
      kByRows);
  EXPECT_EQ(image_of(header("MET_UCHAR", "HeaderSize = 3\n") + "abc" + kSix, "a.mha").values,
            kByRows);
  EXPECT_EQ(image_of(header("MET_UCHAR", "HeaderSize = -1\n") + "abc" + kSix, "a.mha").values,
            kByRows);
}

TEST(ReadMetaImage, DataInAnotherFile) {
  const TempDir dir;
  const std::string text = header("MET_UCHAR", "", "six.raw");
  const auto path = dir.write("a.mhd", text);
  EXPECT_TRUE(contains(bad_data([&] { read_image(path); }), "six.raw: cannot open"));
  dir.write("six.raw", kSix);
  EXPECT_EQ(read_image(path).values, kByRows);
  dir.write("six.raw", "\x1F\x8B" + kSix.substr(2));
  EXPECT_EQ(read_image(path).values[0], 0x1F) << "raw data that look like gzip";
  dir.write("six.raw", kSix.substr(1));
  EXPECT_TRUE(contains(bad_data([&] { read_image(path); }), "six.raw"));
  dir.write("six.zraw", zipped(kSix));
  EXPECT_EQ(
      read_image(dir.write("b.mhd", header("MET_UCHAR", "CompressedData = True\n", "six.zraw")))
          .values,
      kByRows);
  EXPECT_TRUE(contains(bad_data([&] { read_bytes(text); }), "a stream has no"));
  EXPECT_TRUE(contains(bad_data([&] { read_bytes(text + "x"); }), "trailing data"));
  for (const char* many : {"LIST", "LIST 2", "slice%03d.raw 1 4 1"})
    EXPECT_TRUE(contains(bad_data([&] { read_bytes(header("MET_UCHAR", "", many)); }),
                         "expected LOCAL or one file; join the slices"))
        << many;
}

TEST(ReadMetaImage, StatesThePlacesOfTheVoxels) {
  const auto affine_of = [](const std::string& lines) {
    return read_bytes("NDims = 3\nDimSize = 1 2 3\nElementType = MET_UCHAR\n" + lines +
                      "ElementDataFile = LOCAL\n" + kSix)
        .affine;
  };
  EXPECT_FALSE(affine_of(""));
  EXPECT_EQ(affine_of("ElementSpacing = 1 2 0.5\n"),
            (Affine{{{-1, 0, 0, 0}, {0, -2, 0, 0}, {0, 0, 0.5, 0}}}));
  // The second row of the matrix is the direction of the second axis.
  const std::string matrix = " = 1 0 0 0 0.6 0.8 0 -0.8 0.6\n";
  const Affine turned{
      {{-1, 0, 0, -10}, {0, -0.6 * 2, 0.8 * 0.5, -20}, {0, 0.8 * 2, 0.6 * 0.5, 30}}};
  for (const char* name : {"TransformMatrix", "Rotation", "Orientation"})
    for (const char* place : {"Offset", "Position", "Origin"})
      EXPECT_EQ(affine_of("ElementSpacing = 1 2 0.5\n" + (name + matrix) + place + " = 10 20 30\n"),
                turned)
          << name << ' ' << place;
  const auto plane = read_bytes(bytes_with("ElementSpacing = 2 3\nOffset = 1 2\n")).affine;
  EXPECT_EQ(plane, (Affine{{{-2, 0, 0, -1}, {0, -3, 0, -2}, {0, 0, 1, 0}}}));
  const ReadResult odd = read_bytes(bytes_with("ElementSpacing = 2 inf\n"));
  EXPECT_FALSE(odd.affine);
  EXPECT_EQ(odd.notes.size(), 1U);
}

TEST(ReadMetaImage, NotesFieldsThatItDoesNotUse) {
  EXPECT_TRUE(read_bytes(bytes_with("Comment = six = 6\nModality = MET_MOD_CT\n\n")).notes.empty());
  const ReadResult result = read_bytes(bytes_with("ElementToIntensityFunctionSlope = 2\n"));
  ASSERT_EQ(result.notes.size(), 1U);
  EXPECT_TRUE(contains(result.notes[0].str(), "ElementToIntensityFunctionSlope is not used"));
}

TEST(ReadMetaImage, RefusesDamage) {
  check_prefixes(
      bytes_with("Comment = six\n"), "a.mha", [](const Input& in) { read_any(in); }, never());
  const auto packed = [](const std::string& lines) {
    return header("MET_UCHAR", "CompressedData = True\n" + lines);
  };
  expect_refused(
      "a.mha",
      {bytes_with("") + "x",
       bytes_with("NDims = 2\n"),
       bytes_with("by hand\n"),
       bytes_with("ElementNumberOfChannels = 2\n"),
       bytes_with("CompressedData = yes\n"),
       bytes_with("CompressedData = True\n"),
       bytes_with("HeaderSize = -2\n"),
       bytes_with("HeaderSize = 7\n"),
       bytes_with("ElementSpacing = 1\n"),
       bytes_with("ElementSpacing = 1 x\n"),
       bytes_with("TransformMatrix = 1 0 0\n"),
       bytes_with("Offset = 1 2 3\n"),
       bytes_with("Offset = 1 2\nOrigin = 1 2\n"),
       packed("CompressedDataSize = 99\n") + zipped(kSix),
       packed("CompressedDataSize = 3\n") + zipped(kSix),
       packed("HeaderSize = 1\n") + zipped(kSix),
       packed("BinaryData = False\n") + zipped(kSix),
       packed("") + zipped(kSix) + "x",
       packed("") + zipped(kSix + "x"),
       packed("") + zipped(kSix.substr(1)),
       packed("") + zipped(kSix).substr(0, 8),
       header("MET_STRING", "") + kSix,
       header("UCHAR", "") + kSix,
       header("MET_UCHAR", "BinaryData = False\n") + "0 10 1 11 2",
       header("MET_UCHAR", "", ""),
       "ObjectType = Tube\nElementDataFile = LOCAL\n",
       "NDims = 0\nElementDataFile = LOCAL\n",
       "NDims = 11\nDimSize = 1\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n1",
       "NDims = 2\nDimSize = 6\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n" + kSix,
       "NDims = 1\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n" + kSix,
       "NDims = 1\nDimSize = 6\nElementDataFile = LOCAL\n" + kSix,
       "= 1\nNDims = 1\n",
       "NDims = 2\nDimSize = 4294967296 4294967296\nElementType = MET_UCHAR\nElementDataFile = "
       "LOCAL\n" +
           kSix});
}

}  // namespace
}  // namespace ph::test
