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

// A header of an image with 2 x 3 pixels, with these lines in addition.
std::string header(const std::string& type, const std::string& lines) {
  return "NRRD0004\n# by hand\ntype: " + type + "\ndimension: 2\nsizes: 2 3\n" + lines + '\n';
}

const std::string kSix = six<std::uint8_t>(false);

ReadResult read_bytes(const std::string& bytes) {
  return read_any(Input::hold({bytes.begin(), bytes.end()}, "a.nrrd"));
}

std::string bytes_with(const std::string& lines) {
  return header("uint8", lines + "encoding: raw\n") + kSix;
}

TEST(ReadNrrd, EveryTypeByAllItsNames) {
  const auto check = [&]<class T>(T, const std::vector<std::string>& names) {
    for (const std::string& name : names) {
      for (const bool big : {false, true}) {
        const std::string endian = std::string("endian: ") + (big ? "big" : "little") + '\n';
        const Image image =
            image_of(header(name, endian + "encoding: raw\n") + six<T>(big), "a.nrrd");
        EXPECT_EQ(image.extents, (std::vector<Index>{2, 3})) << name;
        EXPECT_EQ(image.values, kByRows) << name;
      }
      EXPECT_EQ(image_of(header(name, "encoding: text\n") + "0 10 1\n11 2 12\n", "a.nrrd").values,
                kByRows)
          << name;
    }
  };
  check(std::int8_t{}, {"signed char", "int8", "int8_t"});
  check(std::uint8_t{}, {"uchar", "unsigned char", "uint8", "uint8_t"});
  check(std::int16_t{},
        {"short", "short int", "signed short", "signed short int", "int16", "int16_t"});
  check(std::uint16_t{}, {"ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"});
  check(std::int32_t{}, {"int", "signed int", "int32", "int32_t"});
  check(std::uint32_t{}, {"uint", "unsigned int", "uint32", "uint32_t"});
  check(std::int64_t{}, {"longlong", "long long", "long long int", "signed long long",
                         "signed long long int", "int64", "int64_t"});
  check(std::uint64_t{},
        {"ulonglong", "unsigned long long", "unsigned long long int", "uint64", "uint64_t"});
  check(float{}, {"float"});
  check(double{}, {"double", "DOUBLE"});
}

TEST(ReadNrrd, Encodings) {
  const std::string packed = gzipped("junk" + kSix);
  EXPECT_EQ(image_of(header("uint8", "encoding: gz\nbyte skip: 4\n") + packed, "a.nrrd").values,
            kByRows);
  EXPECT_EQ(image_of(header("uint8", "encoding: gzip\nline skip: 2\n") + "a\nb\n" + gzipped(kSix),
                     "a.nrrd")
                .values,
            kByRows);
  EXPECT_EQ(
      image_of(header("uint8", "encoding: raw\nbyteskip: -1\n") + "junk" + kSix, "a.nrrd").values,
      kByRows);
  EXPECT_EQ(image_of(header("uint8", "encoding: raw\nlineskip: 1\nbyteskip: 2\n") + "ab\ncd" + kSix,
                     "a.nrrd")
                .values,
            kByRows);
  EXPECT_EQ(image_of(header("float", "encoding: ascii\n") + "0 10 1 11\t2.0\n+12", "a.nrrd").values,
            kByRows);
  std::string dos = header("uint8", "encoding: raw\n");
  for (std::size_t at = 0; (at = dos.find('\n', at)) != std::string::npos; at += 2)
    dos.insert(at, "\r");
  EXPECT_EQ(image_of(dos + kSix, "a.nrrd").values, kByRows);
}

TEST(ReadNrrd, DataInAnotherFile) {
  const TempDir dir;
  const std::string lines = "encoding: raw\ndata file: six.raw\n";
  const auto path = dir.write("a.nhdr", header("uint8", lines));
  EXPECT_TRUE(contains(bad_data([&] { read_image(path); }), "six.raw: cannot open"));
  dir.write("six.raw", kSix);
  EXPECT_EQ(read_image(path).values, kByRows);
  // The bytes of raw data may look like gzip.
  dir.write("six.raw", "\x1F\x8B" + kSix.substr(2));
  EXPECT_EQ(read_image(path).values[0], 0x1F);
  EXPECT_EQ(std::get<Image>(read_any(path).data).values[0], 0x1F);
  dir.write("six.raw", kSix + "x");
  EXPECT_TRUE(contains(bad_data([&] { read_image(path); }), "six.raw"));
  // A header may end without an empty line. A blank may be in the name of a file.
  dir.write("six numbers.raw", kSix);
  const auto other =
      dir.write("b.nhdr",
                "NRRD0001\ntype: uchar\ndimension: 2\nsizes: 2 3\nencoding: raw\ndatafile: six "
                "numbers.raw");
  EXPECT_EQ(read_image(other).values, kByRows);
  // A header from elsewhere is in no folder.
  EXPECT_TRUE(contains(bad_data([&] { read_bytes(header("uint8", lines)); }), "a stream has no"));
  for (const char* many : {"LIST", "LIST 2", "slice%03d.raw 1 4 1", "slice%03d.raw 1 4 1 2"}) {
    const std::string list =
        header("uint8", "encoding: raw\ndata file: " + std::string(many) + '\n');
    EXPECT_TRUE(contains(bad_data([&] { read_bytes(list); }), "expected one file; join")) << many;
  }
}

TEST(ReadNrrd, StatesThePlacesOfTheVoxels) {
  const auto affine_of = [](const std::string& lines, const std::string& sizes = "1 2 3") {
    return read_bytes("NRRD0005\ntype: uint8\nencoding: raw\ndimension: " +
                      std::to_string(std::count(sizes.begin(), sizes.end(), ' ') + 1) +
                      "\nsizes: " + sizes + '\n' + lines + '\n' + kSix)
        .affine;
  };
  EXPECT_FALSE(affine_of(""));
  const std::string directions = "space directions: (1,0.5,0) (0,2,0) (0,0,3)\n";
  const std::string origin = "space origin: (10,20,30)\n";
  const Affine as_it_is{{{1, 0, 0, 10}, {0.5, 2, 0, 20}, {0, 0, 3, 30}}};
  const Affine turned{{{-1, 0, 0, -10}, {-0.5, -2, 0, -20}, {0, 0, 3, 30}}};
  const Affine left{{{-1, 0, 0, -10}, {0.5, 2, 0, 20}, {0, 0, 3, 30}}};
  for (const char* space : {"space: right-anterior-superior\n", "space: RAS\n",
                            "space: scanner-xyz\n", "space dimension: 3\n"})
    EXPECT_EQ(affine_of(space + directions + origin), as_it_is) << space;
  for (const char* space : {"space: left-posterior-superior\n", "space: LPS\n"})
    EXPECT_EQ(affine_of(space + directions + origin), turned) << space;
  EXPECT_EQ(affine_of("space: left-anterior-superior\n" + directions + origin), left);
  // Without an origin, the first voxel is at 0.
  EXPECT_EQ(affine_of("space: LPS\nspace directions: (1,0,0) (0,1,0) (0,0,1)\n"),
            (Affine{{{-1, 0, 0, 0}, {0, -1, 0, 0}, {0, 0, 1, 0}}}));
  EXPECT_EQ(affine_of("spacings: 1 2 0.5\n"),
            (Affine{{{1, 0, 0, 0}, {0, 2, 0, 0}, {0, 0, 0.5, 0}}}));
  // A plane gets a third vector of length 1 across it.
  EXPECT_EQ(
      affine_of("space dimension: 2\nspace directions: (0,2) (2,0)\nspace origin: (1,2)\n", "2 3"),
      (Affine{{{0, 2, 0, 1}, {2, 0, 0, 2}, {0, 0, -1, 0}}}));
  EXPECT_EQ(affine_of("space: RAS\nspace directions: (2,0,0) (0,0,2)\n", "2 3"),
            (Affine{{{2, 0, 0, 0}, {0, 0, -1, 0}, {0, 2, 0, 0}}}));
  EXPECT_EQ(affine_of("spacings: 3\n", "6"), (Affine{{{3, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}}}));
  // An axis of size 1 without a place is dropped, and so is a last axis of time.
  const std::string four = "space: RAS\nspace directions: none (1,0,0) (0,1,0) (0,0,1)\n";
  const ReadResult one = read_bytes(
      "NRRD0005\ntype: uint8\nencoding: raw\ndimension: 4\nsizes: 1 1 2 3\n" + four + '\n' + kSix);
  EXPECT_EQ(std::get<Image>(one.data).extents, (std::vector<Index>{1, 2, 3}));
  EXPECT_TRUE(one.affine);
  EXPECT_TRUE(affine_of("space: RAS\nspace directions: (1,0,0) (0,1,0) (0,0,1) none\n", "1 1 2 3"));
  const auto note_of = [](const std::string& lines) {
    const ReadResult result = read_bytes(bytes_with(lines));
    EXPECT_FALSE(result.affine);
    EXPECT_EQ(result.notes.size(), 1U);
    return result.notes.empty() ? std::string() : result.notes[0].str();
  };
  EXPECT_TRUE(contains(note_of("space directions: (1,0,0,0) (0,1,0,0)\n"), "4 dimensions"));
  EXPECT_TRUE(contains(note_of("space directions: (1,0,inf) (0,1,0)\n"), "not used"));
}

TEST(ReadNrrd, NotesFieldsThatItDoesNotUse) {
  EXPECT_TRUE(read_bytes(bytes_with("content: six\nmy key:=1: 2\n")).notes.empty());
  for (const char* line : {"colour: red", "old min: 0", "axis mins: 0 0"}) {
    const ReadResult result = read_bytes(bytes_with(std::string(line) + '\n'));
    ASSERT_EQ(result.notes.size(), 1U) << line;
    EXPECT_TRUE(contains(result.notes[0].str(), "is not used")) << result.notes[0].str();
  }
}

TEST(ReadNrrd, RefusesComponents) {
  for (const char* kinds : {"RGB-color domain", "vector domain", "domain list", "complex space"})
    EXPECT_TRUE(
        contains(bad_data([&] { read_bytes(bytes_with("kinds: " + std::string(kinds) + '\n')); }),
                 "take one component of axis"))
        << kinds;
  EXPECT_TRUE(
      contains(bad_data([&] { read_bytes(bytes_with("space directions: none (1,0,0)\n")); }),
               "take one component of axis 0"));
  EXPECT_EQ(std::get<Image>(read_bytes(bytes_with("kinds: domain time\n")).data).values, kByRows);
}

TEST(ReadNrrd, RefusesDamage) {
  check_prefixes(
      bytes_with("content: six\n"), "a.nrrd", [](const Input& in) { read_image(in); }, never());
  const std::string raw = "encoding: raw\n";
  expect_refused(
      "a.nrrd",
      {bytes_with("") + "x",
       "NRRD0006\ntype: uint8\ndimension: 2\nsizes: 2 3\nencoding: raw\n\n" + kSix,
       "NRRD00\n",
       header("char", raw) + kSix,
       header("block", raw) + kSix,
       header("short", raw) + kSix + kSix,
       header("uint8", "encoding: bzip2\n") + kSix,
       header("uint8", "encoding: hex\n") + "000a010b020c",
       header("uint8", "type: uint8\n" + raw) + kSix,
       header("uint8", "endian: middle\n" + raw) + kSix,
       header("uint8", "sizes 2 3\n" + raw) + kSix,
       header("uint8", "byte skip: -2\n" + raw) + kSix,
       header("uint8", "byte skip: 7\n" + raw) + kSix,
       header("uint8", "line skip: 7\n" + raw) + kSix,
       header("uint8", "byte skip: 9223372036854775808\n" + raw) + kSix,
       header("uint8", "kinds: domain\n" + raw) + kSix,
       header("uint8", "space directions: (1,0)\n" + raw) + kSix,
       header("uint8", "space directions: (1,0) (0,1,0)\n" + raw) + kSix,
       header("uint8", "space directions: (1,0) 0,1\n" + raw) + kSix,
       header("uint8", "space directions: (1,0) (0,x)\n" + raw) + kSix,
       header("uint8", "space directions: (1,0) (0,1)\nspace origin: (1,2,3)\n" + raw) + kSix,
       header("uint8", "spacings: 1\n" + raw) + kSix,
       header("uint8", "encoding: gzip\n") + kSix,
       header("uint8", "encoding: gzip\n") + gzipped(kSix) + "x",
       header("uint8", "encoding: gzip\n") + gzipped(kSix + "x"),
       header("uint8", "encoding: gzip\nbyte skip: 9\n") + gzipped(kSix),
       header("uint8", "encoding: gzip\nbyte skip: -1\n") + gzipped(kSix),
       header("uint8", "encoding: text\n") + "0 10 1 11 2",
       header("uint8", "encoding: text\n") + "0 10 1 11 2 12 13",
       header("uint8", "encoding: text\n") + "0 10 1 11 2 256",
       header("int8", "encoding: text\n") + "0 10 1 11 2 -129",
       header("uint8", "encoding: text\n") + "0 10 1 11 2 0.5",
       header("uint16", "encoding: text\n") + "0 10 1 11 2 nan",
       header("int64", "encoding: text\n") + "0 10 1 11 2 9007199254740993",
       header("float", "encoding: text\n") + "0 10 1 11 2 nan",
       "NRRD0004\ntype: uint8\ndimension: 2\nsizes: 2 0\nencoding: raw\n\n",
       "NRRD0004\ntype: uint8\ndimension: 0\nsizes:\nencoding: raw\n\n",
       "NRRD0004\ntype: uint8\ndimension: 17\nsizes: 1\nencoding: raw\n\n",
       "NRRD0004\ntype: uint8\ndimension: 2\nsizes: 6\nencoding: raw\n\n" + kSix,
       "NRRD0004\ntype: uint8\ndimension: 2\nsizes: 4294967296 4294967296\nencoding: raw\n\n" +
           kSix,
       "NRRD0004\ntype: uint8\ndimension: 2\nsizes: 4294967296 4294967296\nencoding: text\n\n1",
       "NRRD0004\ntype: uint8\ndimension: 2\nsizes: 4294967296 4294967296\nencoding: gzip\n\n" +
           gzipped(kSix),
       "NRRD0004\ndimension: 2\nsizes: 2 3\nencoding: raw\n\n" + kSix,
       "NRRD0004\ntype: uint8\nsizes: 2 3\nencoding: raw\n\n" + kSix,
       "NRRD0004\ntype: uint8\ndimension: 2\nencoding: raw\n\n" + kSix,
       "NRRD0004\ntype: uint8\ndimension: 2\nsizes: 2 3\n\n" + kSix});
}

TEST(ReadNrrd, KeepsToTheBudget) {
  const std::string sizes = "NRRD0004\ntype: int\ndimension: 2\nsizes: 1000 1000\nendian: little\n";
  const std::string bytes(4'000'000, '\1');
  for (const bool is_packed : {false, true}) {
    const std::string file = sizes + "encoding: " + (is_packed ? "gzip" : "raw") + "\n\n" +
                             (is_packed ? gzipped(bytes) : bytes);
    RunContext context;
    context.memory.set_limit(std::size_t{7} << 20);
    // The doubles take 8 MB. They do not fit, and are put into a file.
    const Image image = read_image(held(file, "a.nrrd", context), {.context = &context});
    EXPECT_TRUE(image.values.is_in_file()) << is_packed;
    EXPECT_EQ(image.values[999'999], 0x01010101);
  }
}

}  // namespace
}  // namespace ph::test
