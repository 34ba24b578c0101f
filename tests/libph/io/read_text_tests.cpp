// SPDX-License-Identifier: MIT
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "ph/io/read.hpp"
#include "ph/io/write.hpp"
#include "tests/libph/io/read_support.hpp"
#include "tests/support/patience.hpp"

namespace ph::test {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

Points points(const std::string& text, const ReadOptions& options = {}) {
  return read_points(Input::view(text, "p.csv"), options);
}

TEST(ReadPoints, AcceptsTheOrdinaryShapes) {
  const Points expected = Points{{1, -2.5, 3e-2}, {4, 5, 6}};
  for (const std::string text : {
           "1 -2.5 3e-2\n4 5 6\n",
           "1,-2.5,3e-2\n4,5,6",
           "1 , -2.5\t, 3e-2 ,\r\n4,5,6,\r\n",
           "1;-2.5;3e-2\n4;5;6\n",
           "\t1\t-2.5\t3e-2\n\n  # comment\n4 5 6 # at the end\n",
           "1 -2.5 3e-2#c\n4 5 6#c#\n",
           "\xEF\xBB\xBF+1 -2.50 0.03\n4 5.0 6.\n",
           "x,y,z\n1,-2.5,3e-2\n4,5,6\n",
           "point x,\"a, b\",z 1\n1,-2.5,.03\n4,5,6\n",
           "\"x 1\" y z\n1 -2.5 .03\n4 5 6\n",
       }) {
    EXPECT_EQ(points(text), expected) << text;
  }
}

TEST(ReadAny, RefusesJson) {
  const auto message = [](const std::string& text) {
    return bad_data([&] { read_any(Input::view(text, "s.json")); });
  };
  const std::string own =
      message("{\n  \"format\": \"ph-segment\",\n  \"objects\": [{\"x\": 1}]\n}\n");
  EXPECT_TRUE(contains(own, "s.json: not numbers, found a JSON file of libph, expected points"));
  EXPECT_TRUE(contains(own, "it is a result, not an input"));
  EXPECT_TRUE(
      contains(message(" {\"points\": [[1, 2], [3, 4]]}"),
               "found a JSON file, expected points, distances, an image or a complex; write "
               "the numbers as text or as .npy"));
}

TEST(ReadPoints, KeepsTheNumbersExactly) {
  const Points p = points("0.1 4.9e-324 1.7976931348623157e308\n-0 1e-400 -1e-99999999999\n");
  EXPECT_EQ(p(0, 0), 0.1);
  EXPECT_EQ(p(0, 1), 4.9e-324);
  EXPECT_EQ(p(0, 2), std::numeric_limits<double>::max());
  EXPECT_FALSE(std::signbit(p(1, 0)));
  EXPECT_EQ(p(1, 1), 0);
  EXPECT_EQ(p(1, 2), 0);
  // Digits before and after the point count as well, and the exponent may be of any size.
  const Points tiny = points("0.00012e-400 12.5e-9223372036854775807 -100.0e-999\n");
  for (Index k = 0; k < 3; ++k) EXPECT_EQ(tiny(0, k), 0);
}

struct BadText {
  const char* text;
  const char* place;  // ":line:column:", or a part of the message
  const char* what;
};

TEST(ReadPoints, NamesWhatIsWrongAndWhere) {
  for (const auto& [text, place, what] : std::vector<BadText>{
           {"", "p.csv: ", "no points"},
           {"\n \t\n# only\n\r\n", "p.csv: ", "no points"},
           {"x y\n", "p.csv: ", "no points"},
           {"1 2\n3 nan\n", ":2:3:", "not a number, found \"nan\""},
           {"1 2\n3 inf\n", ":2:3:", "infinite"},
           {"-inf 2\n3 4\n", ":1:1:", "infinite"},
           {"1 2\n3 1e400\n", ":2:3:", "out of range, found \"1e400\""},
           {"1 2\n3 1.5e9223372036854775807\n", ":2:3:", "out of range"},
           {"1 2\n3 100e307\n", ":2:3:", "out of range"},
           {"1 2\n-1e999999999999 3\n", ":2:1:", "out of range"},
           {"1 2\n0x1p3 3\n", ":2:1:", "hexadecimal"},
           {"1 2\n1,5 3\n", ":2:1:", "decimal point"},
           {"1,5 2,5\n", ":1:3:", "decimal point"},
           {"1,5;2,5\n", ":1:3:", "decimal point"},
           {"1 2\n1_000 3\n", ":2:1:", "digit separators"},
           {"1 2\n1.0abc 3\n", ":2:1:", "\"1.0abc\""},
           {"1 2\n3 -\n", ":2:3:", "not a number"},
           {"1 2\n3 1e\n", ":2:3:", "\"1e\""},
           {"1 2\n3 1e+\n", ":2:3:", "\"1e+\""},
           {"1 2\n+-3 1\n", ":2:1:", "not a number"},
           {"1 2\nnan(7) 1\n", ":2:1:", "not a number"},
           {"1,2\n3,'4'\n", ":2:3:", "without quotes"},
           {"1,2\n3,\"4\n", ":2:3:", "not a number"},
           {"1,2\n3,\"\"\n", ":2:3:", "not a number"},
           {"1,2\n3,,4\n", ":2:3:", "empty cell"},
           {",1,2\n", ":1:1:", "empty cell"},
           {"0 1\n1 -1.#IND\n", ":2:3:", "found \"-1.#IND\", expected a decimal number; write NaN"},
           {"0 1\n1 1.#INF00\n", ":2:3:", "write infinity as inf"},
           {"1 a#3\n", ":1:3:", "not a number, found \"a#3\", expected a decimal number; write a"},
           {"1 2 3\n4 5\n", ":2:1:", "ragged row, found 2 cells, expected 3, as in line 1"},
           {"1 2 3\n\n4 5 6 7\n", ":3:1:", "found 4 cells"},
           {"x,y\n1,\n2,\n",
            ":2:1:", "found 1 cell, expected 2, the number of names in the header; nan drop"},
           {"x,y\n1,2\n2,\n3,4\n", ":3:1:", "expected 2, as in line 2; nan drop"},
           {"x 1 2\n", ":1:1:", "not a number, found \"x\""},
           {"1,2\n3 4\n", ":2:1:", "mixed separators"},
           {"1 2,3\n", ":1:3:", "mixed separators"},
           {"1,2;3\n", ":1:3:", "mixed separators"},
           {"1 2\rr 3 4\r", ":1:3:", "end lines with a line feed"},
       }) {
    const std::string message = bad_data([&] { points(text); });
    EXPECT_TRUE(contains(message, place)) << message;
    EXPECT_TRUE(contains(message, what)) << message;
  }
}

TEST(ReadPoints, RefusesWhatIsNotText) {
  const std::string utf16(
      "\xFF\xFE"
      "1\0 \0"
      "2\0",
      8);
  EXPECT_TRUE(contains(bad_data([&] { points(utf16); }), "UTF-16"));
  const std::string unmarked("1\0 \0002\0\n\0003\0 \0004\0\n\0", 16);
  EXPECT_TRUE(contains(bad_data([&] { points(unmarked); }), "UTF-16"));
  EXPECT_TRUE(contains(bad_data([] { points(std::string("1 2\n3 \0\n", 8)); }), "NUL byte"));
  EXPECT_TRUE(contains(bad_data([] { points("1 2\n\x01\x02\xFF 3\n"); }), "\\x01\\x02\\xFF"));
  const std::string late = std::string(5000, '\n') + std::string("1 \0002\n", 5);
  EXPECT_TRUE(contains(bad_data([&] { points(late); }), ":5001:3:"));
}

TEST(ReadPoints, OptionsDecideAboutDoubtfulInput) {
  EXPECT_EQ(points("", {.allow_empty = true}).rows(), 0);
  std::vector<std::string> notes;
  std::vector<Index> dropped;
  const Points p =
      points("x y\n1 2\nnan 3\n4 5\n", {.nan = NanPolicy::drop,
                                        .note = [&](const Message& m) { notes.push_back(m.str()); },
                                        .dropped = &dropped});
  EXPECT_EQ(p, (Points{{1, 2}, {4, 5}}));
  EXPECT_EQ(dropped, std::vector<Index>{1});
  ASSERT_EQ(notes.size(), 2U);
  EXPECT_TRUE(contains(notes[0], "line 1 is a header"));
  const ReadResult result =
      read_any(Input::view("1 2\nnan 3\n4 5\n", "p"), Format::points, {.nan = NanPolicy::drop});
  EXPECT_EQ(result.point_ids, (std::vector<Index>{0, 2}));
}

TEST(ReadPoints, TakesOneHugeLineInLinearTime) {
  const auto start = std::chrono::steady_clock::now();
  const std::string digits(std::size_t{70} << 20, '7');
  EXPECT_TRUE(contains(bad_data([&] { points(digits); }), "line too long"));
  std::string cells;
  while (cells.size() < (std::size_t{8} << 20)) cells += "1 ";
  EXPECT_EQ(points(cells).cols(), static_cast<Index>(cells.size() / 2));
  std::string word = "1\n";
  word.append(1 << 20, 'x');
  EXPECT_TRUE(contains(bad_data([&] { points(word); }), "..."));
  EXPECT_LT(std::chrono::steady_clock::now() - start, patience(20));
}

DistanceMatrix square(const std::string& text, const ReadOptions& options = {}) {
  return read_distances(Input::view(text, "d.txt"), options);
}

TEST(ReadDistances, ReadsTheSameMatrixInAllShapes) {
  const std::string binary = le(1.0f) + le(2.0f) + le(3.0f) + le(4.0f) + le(5.0f) +
                             le(std::numeric_limits<float>::infinity());
  const std::vector<DistanceMatrix> matrices{
      square("0 1 2 4\n1 0 3 5\n2 3 0 inf\n4 5 inf 0\n"),
      square("a,b,c,d\n0,1,2,4\n1,0,3,5\n2,3,0,inf\n4,5,inf,0"),
      read_lower_distances(Input::view("1\n2 3\n4 5 inf\n", "l")),
      read_lower_distances(Input::view("\n1,\n2,3,\n4,5,inf,\n", "l")),
      read_lower_distances(Input::view("1 2 3 4 5 inf\n", "l")),
      read_upper_distances(Input::view("1 2 4\n3 5\ninf\n", "u")),
      read_upper_distances(Input::view("1 2 4 3 5 inf\n", "u")),
      read_binary_distances(Input::view(binary, "b"))};
  for (const DistanceMatrix& d : matrices) {
    ASSERT_EQ(d.size(), 4);
    EXPECT_EQ(d(0, 1), 1);
    EXPECT_EQ(d(2, 0), 2);
    EXPECT_EQ(d(1, 2), 3);
    EXPECT_EQ(d(3, 0), 4);
    EXPECT_EQ(d(3, 1), 5);
    EXPECT_EQ(d(2, 3), kInf);
  }
  EXPECT_EQ(square("0\n").size(), 1);
  EXPECT_EQ(read_lower_distances(Input::view("7\n", "l")).size(), 2);
  EXPECT_EQ(square("", {.allow_empty = true}).size(), 0);
}

TEST(ReadDistances, NamesWhatIsWrong) {
  for (const auto& [text, place, what] : std::vector<BadText>{
           {"", "d.txt: ", "no points"},
           {"0 1\n1 0\n2 3\n", "d.txt:3:1:", "not square"},
           {"0 1 2\n1 0 3\n", "d.txt: ", "expected 3 rows"},
           {"0 1 2 3 4 5\n1 0\n", "d.txt: ", "2 rows, the first of 6 cells"},
           {"0 1 2\n1 0\n2 3 0\n", ":2:1:", "row 1 of the matrix is too short, found 2 cells"},
           {"0 1 2\n1 0 3 4\n2 3 0\n", ":2:1:", "too long"},
           {"0 1\n1 2\n", ":2:3:", "non-zero diagonal, found 2"},
           {"1 .5\n.5 1\n", ":1:1:", "from_correlation"},
           {"0 1\n2 0\n", ":2:1:", "d(1,0) = 2 but d(0,1) = 1"},
           {"0 -1\n-1 0\n", ":1:3:", "negative distance"},
           {"0 -inf\n-inf 0\n", ":1:3:", "negative distance"},
           {"0 nan\nnan 0\n", ":1:3:", "not a number"},
       }) {
    const std::string message = bad_data([&] { square(text); });
    EXPECT_TRUE(contains(message, place)) << message;
    EXPECT_TRUE(contains(message, what)) << message;
  }
  for (const char* text :
       {"1\n2\n", "1\n2 3 4\n", "1 2\n3\n", "1 2\n", "1\n2 -3\n", "1\n2 nan\n"}) {
    bad_data([&] { read_lower_distances(Input::view(text, "l")); });
  }
  for (const char* text : {"1 2 3\n4 5\n", "1 2 3\n4\n", "1 2\n", "1 2\n3\n4\n", "3 2\n1 1\n"}) {
    bad_data([&] { read_upper_distances(Input::view(text, "u")); });
  }
  for (const std::string& bytes : {std::string("abc"), le(1.0f) + le(2.0f), le(-1.0f),
                                   le(std::numeric_limits<float>::quiet_NaN()), std::string()}) {
    bad_data([&] { read_binary_distances(Input::view(bytes, "b")); });
  }
}

TEST(ReadDistances, OptionsDecideAboutDoubtfulInput) {
  const char* text = "0 1\n2 0\n";
  EXPECT_EQ(square(text, {.symmetrise = Symmetrise::max})(0, 1), 2);
  EXPECT_EQ(square(text, {.symmetrise = Symmetrise::min})(0, 1), 1);
  EXPECT_EQ(square(text, {.symmetrise = Symmetrise::lower})(0, 1), 2);
  EXPECT_EQ(square("0 1\n1.0000001 0\n")(0, 1), 1.0000001);
  EXPECT_EQ(square("1 .25\n.25 1\n", {.from_correlation = true})(0, 1), 0.75);
  bad_data([] { square("1 1.5\n1.5 1\n", {.from_correlation = true}); });
  bad_data([] { square("0 .5\n.5 0\n", {.from_correlation = true}); });
  EXPECT_EQ(square("0 nan\nnan 0\n", {.nan = NanPolicy::drop})(0, 1), kInf);
}

TEST(ReadSparse, ReadsPairs) {
  const SparseDistances s =
      read_sparse(Input::view("# i j d\n3 0 1.5\n0 1 2\n1 0 2\n5 1 inf\n", "s"));
  EXPECT_EQ(s.size(), 6);
  EXPECT_EQ(s.edges(), (std::vector<WeightedEdge>{{0, 1, 2}, {0, 3, 1.5}}));
  for (const auto& [text, place, what] : std::vector<BadText>{
           {"", "s: ", "no points"},
           {"0 1 1\n-1 2 1\n", ":2:1:", "out of range, found \"-1\""},
           {"0 4000000000 1\n", ":1:3:", "out of range"},
           {"0 99999999999999999999 1\n", ":1:3:", "out of range"},
           {"0 1.0 1\n", ":1:3:", "not an integer"},
           {"0 1 1\n2 3 1\n1 0 2\n", ":3:1:", "listed again"},
           {"0 1 1\n2 2 0\n", ":2:3:", "joined to itself"},
           {"0 1 -1\n", ":1:5:", "negative distance"},
           {"0 1 nan\n", ":1:5:", "not a number"},
           {"0 1 1\n0 2\n", ":2:4:", "distance missing"},
           {"0\n", ":1:2:", "second point missing"},
           {"0 1 1 1\n", ":1:7:", "extra cell"},
       }) {
    const std::string message = bad_data([&] { read_sparse(Input::view(text, "s")); });
    EXPECT_TRUE(contains(message, place)) << message;
    EXPECT_TRUE(contains(message, what)) << message;
  }
}

TEST(ReadSimplices, ReadsSimplicesWithTheirLines) {
  const SimplicesInput s =
      read_simplices(Input::view("# a\n0 : 0\n1:-inf\n\n0 1 : 2.5\n", "s.txt"));
  ASSERT_EQ(s.simplices.size(), 3U);
  EXPECT_EQ(s.simplices.values, (std::vector<double>{0, -kInf, 2.5}));
  EXPECT_EQ(s.simplices.simplex(2)[1], 1);
  EXPECT_EQ(s.namer()(2), "s.txt:5");
  for (const char* text : {"", "0 1\n", ": 1\n", "0 :\n", "0 : 1 2\n", "-1 : 0\n", "0 : nan\n",
                           "0 x : 1\n", "0 1.5 : 1\n", "0 : 1e999\n"}) {
    bad_data([&] { read_simplices(Input::view(text, "s")); });
  }
}

TEST(ReadOff, ReadsMeshes) {
  const std::string text =
      "OFF\n# c\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1 255 0 0\n3 0 1 2\n3 0 1 3 0.5\n";
  const Mesh mesh = read_off(Input::view(text, "m.off"));
  EXPECT_EQ(mesh.vertices.rows(), 4);
  EXPECT_EQ(mesh.corners, (std::vector<Index>{0, 1, 2, 0, 1, 3}));
  for (const std::string word : {"COFF", "NOFF", "STCNOFF"}) {
    const auto read =
        read_any(Input::view(word + "\n1 0 0\n1 2 3 0.5 0.5 0.5 1\n", "m"), Format::automatic, {});
    EXPECT_EQ(std::get<Mesh>(read.data).vertices, (Points{{1, 2, 3}})) << word;
  }
  check_prefixes(
      text, "m.off", [](const Input& in) { read_off(in); },
      // A face is still complete if its colour is missing or lacks digits.
      [&](std::size_t length) { return length + 5 >= text.size(); });
  for (const char* bad :
       {"OFF\n1000000000000 0 0\n", "OFF\n-1 0 0\n", "OFF\n1 1 0\n0 0 0\n3 0 0 1\n",
        "OFF\n1 0 0\n0 0 nan\n", "OFF 1 0 0\n0 0 0\n1 2 3\n", "4OFF\n1 0 0\n0 0 0 1\n",
        "COFFE\n1 0 0\n0 0 0\n", "OFF\n1 1 0\n0 0 0\n4000000000 0\n", "OFF\n0 0 0\n"}) {
    bad_data([&] { read_off(Input::view(bad, "m.off")); });
  }
  const auto says = [](const char* content) {
    return bad_data([&] { read_off(Input::view(content, "m.off")); });
  };
  EXPECT_TRUE(
      contains(says("OFF\n"), "found the end of the file, expected the numbers of vertices"));
  EXPECT_TRUE(contains(says("OFF\n# in line 3:\n2 0 0\n0.125 0.125 0.125\n"),
                       "too few vertices, found 1, expected 2, the number in the header"));
}

TEST(ReadOff, TheCountMayFollowTheWordAtOnce) {
  for (const std::string start : {"OFF2 0 0\n", "COFF2 0\n", "OFF2\t0 0\r\n"}) {
    const std::string text = start + "0.5 1 2\n3 4 5\n";
    const ReadResult read = read_any(Input::view(text, "m.txt"), Format::automatic);
    EXPECT_EQ(read.format, Format::off) << start;
    EXPECT_EQ(std::get<Mesh>(read.data).vertices, (Points{{0.5, 1, 2}, {3, 4, 5}})) << start;
  }
  EXPECT_EQ(read_any(Input::view("OFF1,OFF2\n1,2\n3,4\n", "t.csv"), Format::automatic).format,
            Format::points);
  EXPECT_TRUE(
      contains(bad_data([] { read_off(Input::view("OFF3 0 0\n0.125 0.125 0.125\n", "m.off")); }),
               "too few vertices, found 1, expected 3"));
}

TEST(Weld, JoinsVerticesAtOnePosition) {
  // Two triangles with an edge in common, whose ends are listed for each of them.
  const std::string off =
      "OFF\n7 3 0\n0 0 0\n1 0 0\n0 1 0\n1 0 0\n0 1 0\n1 1 0\n-0 0 0\n"
      "3 0 1 2\n3 3 5 4\n3 6 0 1\n";
  const TempDir dir;
  const auto read = [&](const char* values, bool weld) {
    return read_any(Input::view(off, "m.off"), Format::automatic, {.weld = weld},
                    dir.write("v.txt", values));
  };
  const auto says = [](const ReadResult& result, const char* words) {
    return std::ranges::any_of(result.notes,
                               [&](const Message& note) { return contains(note.str(), words); });
  };
  const char* even = "0 1 2 1 2 3 0";
  const ReadResult split = read(even, false);
  EXPECT_EQ(std::get<Mesh>(split.data).vertices.rows(), 7);
  EXPECT_TRUE(says(split, "3 positions have several vertices each"));
  EXPECT_TRUE(says(split, "weld joins them"));
  const ReadResult welded = read(even, true);
  const Mesh& mesh = std::get<Mesh>(welded.data);
  EXPECT_EQ(mesh.vertices, (Points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}));
  EXPECT_EQ(mesh.values, (std::vector<double>{0, 1, 2, 3}));
  EXPECT_EQ(mesh.corners, (std::vector<Index>{0, 1, 2, 1, 3, 2, 0, 1}));
  EXPECT_EQ(mesh.offsets, (std::vector<std::size_t>{0, 3, 6, 8}));
  EXPECT_EQ(welded.point_ids, (std::vector<Index>{0, 1, 2, 5}));
  EXPECT_TRUE(says(welded, "3 of 7 vertices joined"));
  EXPECT_TRUE(contains(bad_data([&] { read("0 1 2 1 9 3 0", true); }),
                       "the values 2 of vertex 2 and 9 of vertex 4, expected equal values"));
  EXPECT_TRUE(
      says(read_any(Input::view("OFF\n1 0 0\n0 0 0\n", "m.off"), Format::automatic, {.weld = true}),
           "weld does nothing"));
  EXPECT_TRUE(fails_with(ErrorKind::usage, [&] {
    read_any(Input::view("1 2\n3 4\n", "p.txt"), Format::automatic, {.weld = true});
  }));
}

TEST(ReadAny, DetectsFormats) {
  const std::vector<std::tuple<std::string, std::string, Format>> cases{
      {"p.txt", "1 2 3\n4 5 6\n", Format::points},
      {"p.txt", "0 1 2\n3 4 5\n6 7 8\n", Format::points},
      {"d.txt", "0 1 2\n1 0 3\n2 3 0\n", Format::distance},
      {"l.txt", "1\n2 3\n4 5 6\n", Format::lower_distance},
      {"u.txt", "1 2 3\n4 5\n6\n", Format::upper_distance},
      {"e.sparse", "0 1 1\n", Format::sparse},
      {"a.bin", le(1.0f), Format::binary},
      {"x", "0 : 1\n", Format::simplices},
      {"x.phat", "0\n0\n1 0 1\n", Format::phat},
      {"x", "OFF\n1 0 0\n0 0 0\n", Format::off},
      {"x", "# .PCD v.7\nVERSION .7\n", Format::pcd},
      {"x", "ply\nformat ascii 1.0\n", Format::ply},
      {"x", "P5\n1 1 255\n0", Format::pgm},
      {"x", le(std::int64_t{8067171840}) + le(std::int64_t{1}), Format::dipha}};
  for (const auto& [name, text, format] : cases) {
    EXPECT_EQ(detect_format(Input::view(text, name)), format) << name << ": " << text;
  }
  const ReadResult result = read_any(Input::view("1,2\n3,4\n", "p.csv"));
  EXPECT_EQ(result.description, "2 points in R^2, CSV");
  EXPECT_TRUE(fails_with(ErrorKind::usage,
                         [] { read_any(Input::view("1 2\n", "p"), Format::points, {}, "v"); }));
  for (const FormatInfo& info : formats()) {
    EXPECT_EQ(info.read == nullptr, info.format == Format::automatic) << info.name;
    EXPECT_EQ(format_from_name(info.name), info.format);
    EXPECT_EQ(&format_info(info.format), &info);
    EXPECT_TRUE(std::ranges::all_of(info.description().str(), [](char c) {
      return c < 0 || c >= ' ';
    })) << info.name;
  }
  EXPECT_EQ(format_from_name("tsv"), std::nullopt);
}

TEST(FormatsPage, NamesEveryFormat) {
  const Input page =
      Input::open(std::filesystem::path(PH_SOURCE_DIR) / "docs/reference/formats.md");
  const auto named = [&](std::string_view name) {
    std::string quoted(1, '`');
    quoted.append(name).append(1, '`');
    return page.text().find(quoted) != std::string_view::npos;
  };
  for (const FormatInfo& info : formats()) {
    EXPECT_TRUE(named(info.name) || info.format == Format::automatic) << info.name;
  }
  for (const BarcodeFormatInfo& info : barcode_formats())
    EXPECT_TRUE(named(info.name)) << info.name;
}

TEST(ReadText, EveryPrefixIsRejectedOrComplete) {
  const auto textual = [](const std::string& text) {
    return [text](std::size_t length) { return length > 0 && text[length - 1] != ' '; };
  };
  const std::string simplices = "0 : 0\n1 : 0\n0 1 : 1\n";
  check_prefixes(
      simplices, "s", [](const Input& in) { read_simplices(in); }, textual(simplices));
  const std::string square_text = "0 1 2\n1 0 3\n2 3 0\n";
  check_prefixes(
      square_text, "d", [](const Input& in) { read_distances(in); },
      [&](std::size_t length) { return length == 1 || length == 2 || length == 17; });
}

}  // namespace
}  // namespace ph::test
