// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "ph/detail/io/base64.hpp"
#include "ph/io/read.hpp"
#include "tests/libph/io/images/volume_numbers.hpp"
#include "tests/libph/io/packed.hpp"
#include "tests/libph/io/read_support.hpp"
#include "tests/support/run_contexts.hpp"

namespace ph::test {
namespace {

std::string base64(const std::string& bytes) {
  std::string text;
  detail::Base64 writer;
  writer.append(std::as_bytes(std::span(bytes)), text);
  writer.finish(text);
  return text;
}

/// The parts of a VTI file with an image of 2 x 3 points.
struct Vti {
  std::string root = "byte_order=\"LittleEndian\"";
  std::string image = "WholeExtent=\"0 1 0 2 0 0\"";
  std::string extent = "0 1 0 2 0 0";
  std::string points = {}, cells = {};  ///< the content of PointData and of CellData
  std::string scalars = {};             ///< the attributes of both
  std::string appended = {};            ///< the element of the appended data

  std::string text() const {
    return fmt::format(
        "<?xml version=\"1.0\"?>\n<!-- by hand -->\n<VTKFile type=\"ImageData\" {}>\n<ImageData "
        "{}>\n<Piece Extent=\"{}\">\n<PointData{}>{}</PointData>\n<CellData{}>{}</CellData>\n"
        "</Piece>\n</ImageData>\n{}</VTKFile>",
        root, image, extent, scalars, points, scalars, cells, appended);
  }
};

std::string array(const std::string& type, const std::string& more, const std::string& content) {
  return fmt::format("\n<DataArray type=\"{}\" {}>{}</DataArray>\n", type, more, content);
}
std::string ascii(const std::string& numbers, const std::string& more = "Name=\"a\"") {
  return array("UInt8", more + " format=\"ascii\"", '\n' + numbers + '\n');
}

const std::string kText = "0 10 1\n11 2 12";

std::string bytes_with(const std::string& points) { return Vti{.points = points}.text(); }

ReadResult read_bytes(const std::string& bytes) {
  return read_any(Input::hold({bytes.begin(), bytes.end()}, "a.vti"));
}
std::string refusal(const std::string& bytes) {
  return bad_data([&] { read_bytes(bytes); });
}

std::string in_order(std::string bytes, bool big) {
  if (big) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}
std::string count_of(std::size_t count, bool wide, bool big) {
  return wide ? in_order(le(std::uint64_t{count}), big)
              : in_order(le(static_cast<std::uint32_t>(count)), big);
}

/// The counts and the data of blocks of `each` bytes.
std::pair<std::string, std::string> blocks_of(const std::string& bytes, std::size_t each, bool wide,
                                              bool big) {
  std::string sizes, data;
  std::size_t count = 0;
  for (std::size_t at = 0; at < bytes.size(); at += each, ++count) {
    const std::string block = zipped(bytes.substr(at, each));
    sizes += count_of(block.size(), wide, big);
    data += block;
  }
  return {count_of(count, wide, big) + count_of(each, wide, big) +
              count_of(bytes.size() % each, wide, big) + sizes,
          data};
}

TEST(ReadVti, EveryTypeInEveryEncoding) {
  const auto check = [&]<class T>(T, const std::string& type) {
    EXPECT_EQ(image_of(bytes_with(array(type, "format=\"ascii\"", kText)), "a.vti").values,
              kByRows);
    for (const bool big : {false, true}) {
      for (const bool wide : {false, true}) {
        const std::string numbers = six<T>(big);
        const std::string plain = count_of(numbers.size(), wide, big) + numbers;
        // Five bytes do not divide the numbers, and one block holds all of them.
        for (const std::size_t each : {std::size_t{0}, std::size_t{5}, numbers.size()}) {
          Vti vti;
          vti.root = fmt::format("byte_order=\"{}\" header_type=\"{}\"{}",
                                 big ? "BigEndian" : "LittleEndian", wide ? "UInt64" : "UInt32",
                                 each > 0 ? " compressor=\"vtkZLibDataCompressor\"" : "");
          const auto [head, data] =
              each > 0 ? blocks_of(numbers, each, wide, big) : std::pair(plain, std::string());
          vti.points =
              array(type, "format=\"binary\"", "\n  " + base64(head) + base64(data) + '\n');
          EXPECT_EQ(image_of(vti.text(), "a.vti").values, kByRows) << vti.text();
          for (const std::string encoding : {"raw", "base64"}) {
            const std::string before = "xyz=";
            vti.points = array(type, "format=\"appended\" offset=\"4\"", "");
            vti.appended = "<AppendedData encoding=\"" + encoding + "\">\n _" + before +
                           (encoding == "raw" ? head + data : base64(head) + base64(data)) +
                           "\n</AppendedData>\n";
            const Image image = image_of(vti.text(), "a.vti");
            EXPECT_EQ(image.extents, (std::vector<Index>{2, 3}));
            EXPECT_EQ(image.values, kByRows) << type << big << wide << each << encoding;
          }
        }
      }
    }
  };
  check(std::int8_t{}, "Int8");
  check(std::uint8_t{}, "UInt8");
  check(std::int16_t{}, "Int16");
  check(std::uint16_t{}, "UInt16");
  check(std::int32_t{}, "Int32");
  check(std::uint32_t{}, "UInt32");
  check(std::int64_t{}, "Int64");
  check(std::uint64_t{}, "UInt64");
  check(float{}, "Float32");
  check(double{}, "Float64");
}

TEST(ReadVti, CountAndNumbersMayBeTwoBase64Texts) {
  const std::string numbers = six<std::uint8_t>(false);
  const std::string two = base64(count_of(6, false, false)) + base64(numbers);
  EXPECT_EQ(image_of(bytes_with(array("UInt8", "format=\"binary\"", two)), "a.vti").values,
            kByRows);
}

TEST(ReadVti, ReadsWhatVtkWrites) {
  // Written by VTK 9.7: the numbers of six points as Float32 in one block, then a vector.
  const std::string file =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"ImageData\" version=\"0.1\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt32\" compressor=\"vtkZLibDataCompressor\">\n"
      "  <ImageData WholeExtent=\"1 3 0 1 2 2\" Origin=\"10 20 30\" Spacing=\"1 2 0.5\" "
      "Direction=\"0 -1 0 1 0 0 0 0 1\">\n    <FieldData>\n"
      "      <DataArray type=\"Int32\" Name=\"t\" NumberOfTuples=\"1\" format=\"appended\" "
      "RangeMin=\"7\" RangeMax=\"7\" offset=\"0\"                   >\n      </DataArray>\n"
      "    </FieldData>\n    <Piece Extent=\"1 3 0 1 2 2\"                  >\n"
      "      <PointData Scalars=\"dens<ity\" Vectors=\"vec\">\n"
      "        <DataArray type=\"Float32\" Name=\"dens<ity\" format=\"appended\" RangeMin=\"0\" "
      "RangeMax=\"9\" offset=\"40\"                  >\n        </DataArray>\n"
      "        <DataArray type=\"Float64\" Name=\"vec\" NumberOfComponents=\"3\" "
      "format=\"appended\" offset=\"96\"                  >\n"
      "          <InformationKey name=\"L2_NORM_RANGE\" location=\"vtkDataArray\" length=\"1\">\n"
      "            <Value index=\"0\">\n              2.2360679775\n            </Value>\n"
      "          </InformationKey>\n        </DataArray>\n      </PointData>\n"
      "      <CellData>\n      </CellData>\n    </Piece>\n  </ImageData>\n"
      "  <AppendedData encoding=\"base64\">\n"
      "   _AQAAAACAAAAEAAAADAAAAA==eF5jZ2BgAAAAIAAIAQAAAACAAAAYAAAAGAAAAA==eF5jYACBBQ5AAogbgFjAE"
      "UjbAwAc/ALxAQAAAACAAACQAAAAOQAAAA==eF5jYEAGH+yhDAcIxQGlBaC0CJSWgNIyUFoBSitBaRUorQalNaC0F"
      "pTWgdJ6UNoAShs6AADpMAcp\n  </AppendedData>\n</VTKFile>\n";
  const ReadResult result = read_bytes(file);
  const auto& image = std::get<Image>(result.data);
  EXPECT_EQ(image.extents, (std::vector<Index>{3, 2}));
  EXPECT_EQ(image.values, (std::vector<double>{0, 4, 5, 9, 2, 1}));
  // The first point has the index (1, 0, 2).
  EXPECT_EQ(result.affine, (Affine{{{0, -2, 0, 10}, {1, 0, 0, 21}, {0, 0, 0.5, 31}}}));
  EXPECT_EQ(result.format, Format::vti);
  ASSERT_EQ(result.notes.size(), 1U);
  EXPECT_TRUE(contains(result.notes[0].str(), "dens<ity, which the file marks as its scalars"));
}

TEST(ReadVti, StatesThePlacesOfPointsAndCells) {
  Vti vti{.image = "WholeExtent=\"0 1 0 2 4 5\"", .extent = "0 1 0 2 4 5"};
  vti.points = ascii(kText + ' ' + kText);
  EXPECT_FALSE(read_bytes(vti.text()).affine);
  EXPECT_EQ(std::get<Image>(read_bytes(vti.text()).data).extents, (std::vector<Index>{2, 3, 2}));
  vti.image += " Spacing=\"1 2 0.5\" Origin=\"10 20 30\"";
  EXPECT_EQ(read_bytes(vti.text()).affine,
            (Affine{{{1, 0, 0, 10}, {0, 2, 0, 20}, {0, 0, 0.5, 32}}}));
  // There is a cell between two points, and its place is its middle.
  vti.points.clear();
  vti.cells = ascii("7 8");
  const ReadResult cells = read_bytes(vti.text());
  EXPECT_EQ(std::get<Image>(cells.data).extents, (std::vector<Index>{1, 2}));
  EXPECT_EQ(std::get<Image>(cells.data).values, (std::vector<double>{7, 8}));
  EXPECT_EQ(cells.affine, (Affine{{{1, 0, 0, 10.5}, {0, 2, 0, 21}, {0, 0, 0.5, 32.25}}}));
  vti.image = "WholeExtent=\"0 1 0 2 4 5\" Spacing=\"1 inf 1\"";
  const ReadResult odd = read_bytes(vti.text());
  EXPECT_FALSE(odd.affine);
  EXPECT_EQ(odd.notes.size(), 1U);
  // Cells of a plane lie in the plane.
  vti.image = "WholeExtent=\"0 1 0 2 4 4\" Spacing=\"1 1 1\"";
  vti.extent = "0 1 0 2 4 4";
  EXPECT_EQ(read_bytes(vti.text()).affine,
            (Affine{{{1, 0, 0, 0.5}, {0, 1, 0, 0.5}, {0, 0, 1, 4}}}));
}

TEST(ReadVti, ChoosesAnArray) {
  const std::string a = ascii("1 1 1 1 1 1"), b = ascii(kText, "Name=\"b\"");
  Vti vti{.points = a + b};
  EXPECT_TRUE(contains(refusal(vti.text()),
                       "several arrays in the image, found 2 (a, b), expected one; choose one, for "
                       "example a.vti:a"));
  vti.scalars = " Scalars=\"b\"";
  EXPECT_EQ(image_of(vti.text(), "a.vti").values, kByRows);
  const TempDir dir;
  const std::string path = dir.write("a.vti", vti.text()).string();
  EXPECT_EQ(read_image(path + ":a").values[5], 1);
  EXPECT_EQ(read_image(path + ":b").values, kByRows);
  EXPECT_TRUE(
      contains(bad_data([&] { read_image(path + ":c"); }), "found c, expected one of a, b"));
  dir.write("a.vti", bytes_with(a + a));
  EXPECT_TRUE(contains(bad_data([&] { read_image(path + ":a"); }), "a second array a"));
  // Both kinds of data have an array that is marked.
  vti.cells = ascii("7 8", "Name=\"b\"");
  EXPECT_TRUE(contains(refusal(vti.text()), "several arrays in the image, found 3"));
  EXPECT_TRUE(contains(refusal(bytes_with("")), "no arrays"));
}

TEST(ReadVti, ArraysThatExceedTheMemoryLimitStayInFiles) {
  constexpr std::size_t side = 128;
  std::string numbers;
  for (std::size_t k = 0; k < side * side * side; ++k)
    numbers += le(static_cast<std::uint16_t>(k * 7));
  Vti vti;
  vti.image = "WholeExtent=\"0 127 0 127 0 127\"";
  vti.extent = "0 127 0 127 0 127";
  const TempDir dir;
  const auto check = [&](const std::string& data, const std::string& encoding) {
    vti.points = array("UInt16", "format=\"appended\" offset=\"0\"", "");
    vti.appended = "<AppendedData encoding=\"" + encoding + "\">_" + data + "</AppendedData>";
    const auto path = dir.write("a.vti", vti.text());
    const Image expected = read_image(path);
    EXPECT_EQ(expected.values[1], static_cast<std::uint16_t>(side * side * 7));
    LimitedContext context(3'000'000);
    ReadOptions options;
    options.context = &context;
    const Image found = read_image(path, options);
    EXPECT_TRUE(found.values.is_in_file());
    EXPECT_TRUE(found.values.doubles() == expected.values.doubles());
    EXPECT_LE(context.memory.peak(), context.memory.limit());
  };
  const std::string plain = count_of(numbers.size(), false, false) + numbers;
  check(plain, "raw");
  check(base64(plain), "base64");
  vti.root += " compressor=\"vtkZLibDataCompressor\"";
  const auto [head, data] = blocks_of(numbers, 1 << 15, false, false);
  check(head + data, "raw");
  check(base64(head) + base64(data), "base64");
}

TEST(ReadVti, RefusesDamage) {
  const std::string plain = count_of(6, false, false) + six<std::uint8_t>(false);
  const auto binary = [](const std::string& text) {
    return bytes_with(array("UInt8", "format=\"binary\"", text));
  };
  const auto appended = [](const std::string& encoding, const std::string& data,
                           const std::string& more = "offset=\"0\"") {
    Vti vti{.points = array("UInt8", "format=\"appended\" " + more, "")};
    vti.appended = "<AppendedData encoding=\"" + encoding + "\">_" + data + "</AppendedData>";
    return vti.text();
  };
  const auto packed = [](const std::string& head, const std::string& data) {
    Vti vti{.points = array("UInt8", "format=\"binary\"", base64(head) + base64(data))};
    vti.root += " compressor=\"vtkZLibDataCompressor\"";
    return vti.text();
  };
  for (const std::string& whole : {bytes_with(ascii(kText)), binary(base64(plain)),
                                   appended("raw", plain), appended("base64", base64(plain))})
    check_prefixes(
        whole, "a.vti", [](const Input& in) { read_image(in); }, never());
  const auto counts = [](std::initializer_list<std::size_t> numbers) {
    std::string bytes;
    for (const std::size_t number : numbers) bytes += count_of(number, false, false);
    return bytes;
  };
  const std::string six_packed = zipped(six<std::uint8_t>(false));
  const std::size_t size = six_packed.size();
  ASSERT_EQ(image_of(packed(counts({1, 6, 0, size}), six_packed), "a.vti").values, kByRows);
  struct Case {
    std::string bytes, message;
  };
  const auto in_root = [](const std::string& root) {
    return Vti{.root = root, .points = array("UInt8", "format=\"binary\"", "")}.text();
  };
  const std::vector<Case> cases{
      {"0 1\n", "not a VTI file"},
      {"<svg/>", "not a VTI file"},
      {"<VTKFile type=\"PolyData\"></VTKFile>", "type, found PolyData, expected ImageData"},
      {"<VTKFile></VTKFile>", "VTKFile without type"},
      {"<VTKFile type=\"ImageData\"></VTKFile>", "no arrays"},
      {bytes_with(ascii(kText)) + "x", "trailing data, found 1 more"},
      {appended("raw", plain) + "x", "trailing data, found 1 more"},
      {bytes_with(ascii(kText) + "x"), "text outside an array"},
      {bytes_with(ascii(kText + "<b/>7")), "text outside an array"},
      {bytes_with(ascii(kText + " 13")), "trailing data, found another number"},
      {bytes_with(ascii("0 10 1       ")), "truncated: too few numbers"},
      {bytes_with(ascii("0 10 1 11 2 256")), ":8:13: number out of range"},
      {bytes_with(ascii(kText, "Name=\"a\" Name=\"b\"")), "a second attribute Name"},
      {bytes_with(ascii(kText, "Name=a")), "an attribute NAME="},
      {bytes_with("</PointData>"), "expected </Piece>"},
      {bytes_with("<>"), "the tag of an element"},
      {bytes_with(ascii(kText, "NumberOfComponents=\"3\"")), "NumberOfComponents, found 3"},
      {bytes_with(array("Bit", "format=\"ascii\"", kText)), "type, found Bit, expected Int8"},
      {bytes_with(array("UInt8", "format=\"hex\"", kText)), "ascii, binary or appended"},
      {bytes_with(array("UInt8", "", kText)), "DataArray without format"},
      {bytes_with(array("UInt8", "format=\"appended\" offset=\"0\"", "")),
       "no element AppendedData"},
      {appended("raw", plain, ""), "DataArray without offset"},
      {appended("raw", plain, "offset=\"11\""),
       "offset, found 11, expected whole numbers from 0 to"},
      {appended("hex", plain), "encoding, found hex, expected raw or base64"},
      {appended("raw", plain + "x"), "trailing data"},
      {appended("raw", counts({7}) + plain.substr(4)), "trailing data: the array does not fit"},
      {appended("raw", counts({5}) + plain.substr(4)), "truncated: the array does not fit"},
      {appended("raw", plain.substr(0, 9)), "truncated array"},
      {binary(base64(plain + "x")), "trailing data"},
      {binary(base64(plain) + "AAAA"), "trailing data"},
      {binary(base64(plain.substr(0, 9))), "truncated array"},
      {binary(base64(plain.substr(0, 7)) + "!AAA"), "damaged Base64 data"},
      {binary(base64(plain).substr(0, 14) + "B="), "damaged Base64 data"},
      {binary("="), "truncated array"},
      {in_root(""), "VTKFile without byte_order"},
      {in_root("byte_order=\"Middle\""), "LittleEndian or BigEndian"},
      {in_root("byte_order=\"LittleEndian\" header_type=\"UInt8\""), "UInt32 or UInt64"},
      {in_root("byte_order=\"LittleEndian\" compressor=\"vtkLZ4DataCompressor\""),
       "SetCompressorTypeToZLib"},
      {packed(counts({1, 6, 0, size}), six_packed + "x"), "trailing data"},
      {packed(counts({1, 6, 7, size}), six_packed), "does not fit the extents"},
      {packed(counts({0, 6, 0}), six_packed), "does not fit the extents"},
      {packed(counts({2, 3, 0, size}), six_packed), "array"},
      {packed(counts({1, 6, 0, size + 9}), six_packed), "truncated array"},
      {packed(counts({1, 6, 0, size}), std::string(size, 'x')), "block 1 of the array: byte"},
      {packed(counts({1, 6, 0, size}), zipped("12345")), "array"},
      {packed(counts({1, 6, 0, zipped("12345").size()}), zipped("12345")), "wrong size of block 1"},
      {packed(counts({1, 6, 0, zipped("1234567").size()}), zipped("1234567")), "wrong size of"},
      {Vti{.image = "Spacing=\"1 1 1\"", .points = ascii(kText)}.text(), "without WholeExtent"},
      {Vti{.image = "WholeExtent=\"0 1 0 2\"", .points = ascii(kText)}.text(), "three axes"},
      {Vti{.image = "WholeExtent=\"0 -1 0 2 0 0\"", .points = ascii(kText)}.text(), "three axes"},
      {Vti{.extent = "0 1 0 1 0 0", .points = ascii(kText)}.text(), "the extent of the image"},
      {Vti{.image = "WholeExtent=\"0 1 0 2 0 0\" Spacing=\"1 1\"", .points = ascii(kText)}.text(),
       "expected 3 numbers"},
      {Vti{.points = ascii(kText) + "</PointData></Piece><Piece Extent=\"0 1 0 2 0 0\"><PointData>"}
           .text(),
       "a second Piece, expected one; join the pieces"},
  };
  for (const auto& [bytes, message] : cases) {
    const std::string found = bad_data([&] {
      read_any(Input::hold({bytes.begin(), bytes.end()}, "a.vti"), Format::vti);
    });
    EXPECT_TRUE(contains(found, message)) << message << "\n  is not in  " << found;
  }
}

TEST(ReadVti, RefusesFalseSizesBeforeItAllocates) {
  Vti vti{.image = "WholeExtent=\"0 999999 0 999999 0 0\"", .extent = "0 999999 0 999999 0 0"};
  const std::size_t tera = 1'000'000'000'000;
  vti.root = "byte_order=\"LittleEndian\" header_type=\"UInt64\"";
  vti.points = array("UInt8", "format=\"binary\"", base64(count_of(tera, true, false)));
  EXPECT_TRUE(contains(refusal(vti.text()), "truncated array"));
  vti.points = ascii("1 2");
  EXPECT_TRUE(contains(refusal(vti.text()), "truncated: the sizes do not fit the file"));
  vti.root += " compressor=\"vtkZLibDataCompressor\"";
  const std::string block = zipped("12");
  const std::string head = count_of(1, true, false) + count_of(tera, true, false) +
                           count_of(0, true, false) + count_of(block.size(), true, false);
  vti.points = array("UInt8", "format=\"binary\"", base64(head) + base64(block));
  EXPECT_TRUE(contains(refusal(vti.text()), "expand too much"));
  const std::string many = count_of(tera, true, false) + count_of(1, true, false);
  vti.points = array("UInt8", "format=\"binary\"", base64(many + count_of(0, true, false)));
  EXPECT_TRUE(contains(refusal(vti.text()), "truncated array"));
  vti.image = "WholeExtent=\"0 2147483646 0 2147483646 0 2147483646\"";
  vti.extent = "0 2147483646 0 2147483646 0 2147483646";
  EXPECT_TRUE(contains(refusal(vti.text()), "more than 2^64"));
}

}  // namespace
}  // namespace ph::test
