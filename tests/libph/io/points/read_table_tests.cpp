// SPDX-License-Identifier: MIT
// Tables with names, with indexes and with chosen columns.
#include "ph/io/read.hpp"
#include "tests/libph/io/points/read_any.hpp"

namespace ph::test {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

TEST(ReadTable, LeavesAnIndexOut) {
  const Points expected = Points{{1.5, 2}, {3.5, 4}};
  for (const std::string text :
       {",x,y\n0,1.5,2\n1,3.5,4\n", "\"\",\"x\",\"y\"\n\"a\",1.5,2\n\"b, c\",3.5,4\n",
        "index;x;y\n1;1.5;2\n2;3.5;4\n", "x y\n1 1.5 2\n2 3.5 4\n", ",0,1\n7,1.5,2\n3,3.5,4\n"}) {
    const ReadResult result = any(text);
    EXPECT_EQ(std::get<Points>(result.data), expected) << text;
    EXPECT_TRUE(says(result, "left out")) << text;
  }
  EXPECT_EQ(std::get<Points>(any("t,x\n0,5\n1,6\n").data).cols(), 2);
  EXPECT_TRUE(says(any("id,x\n4,5\n9,6\n"), "columns 2-2"));
}

TEST(ReadTable, ColumnsBesideCoordinatesAreNamed) {
  const std::string rows = "0.5,1.25,2,10\n0.25,1,3,20\n";
  const struct {
    std::string text;
    Index columns;
    const char* note;
  } cases[] = {
      {"x,y,z,intensity\n" + rows, 4,
       "intensity is read as a coordinate; columns x,y,z leaves it out"},
      {"time,X,Y,Z\n" + rows, 4, "time is read as a coordinate; columns X,Y,Z leaves it out"},
      {"x,y,r,label\n" + rows, 4,
       "r and label are read as coordinates; columns x,y leaves them out"},
      {"x y z nx ny nz i\n1 2 3 4 5 6 7\n", 7,
       "nx, ny and 2 more are read as coordinates; columns x,y,z leaves them out"},
  };
  for (const auto& [text, columns, note] : cases) {
    const ReadResult result = any(text);
    EXPECT_EQ(std::get<Points>(result.data).cols(), columns) << text;
    EXPECT_TRUE(says(result, note)) << text;
  }
  for (const char* text : {"x,y,z\n1,2,3\n4,5,7\n", "a,b,c,d\n1,2,3,4\n", "x,y,y,i\n1,2,3,4\n",
                           ",x,y,z\n1,1,2,3\n2,4,5,7\n", "x,z,i\n1,2,3\n"})
    EXPECT_FALSE(says(any(text), "coordinate")) << text;
  const ReadOptions some{.columns = {"x", "y", "z"}};
  EXPECT_FALSE(says(any(cases[0].text, some), "coordinate"));
  EXPECT_EQ(std::get<Points>(any(cases[0].text, some).data),
            (Points{{0.5, 1.25, 2}, {0.25, 1, 3}}));
}

TEST(ReadTable, LatitudesAndLongitudesAreNoDistances) {
  const std::string sphere = "are read as coordinates of the plane, but differences of degrees";
  for (const char* text : {"lat,lon\n1,2\n3,4\n", "Longitude;name;LATITUDE\n1;2;3\n4;5;6\n",
                           "depth lat lng\n1 2 3\n4 5 7\n"})
    EXPECT_TRUE(says(any(text), sphere)) << text;
  EXPECT_TRUE(
      says(any("long,lat\n1,2\n3,4\n"),
           "(cos lat cos long, cos lat sin long, sin lat) is the point on the unit sphere"));
  const std::string places = "city,lat,lon\na,1,2\nb,3,4\n";
  EXPECT_TRUE(says(any(places, {.columns = {"lat", "lon"}}), sphere));
  for (const char* text : {"lat,x\n1,2\n3,4\n", "flat,long\n1,2\n3,4\n",
                           "lat,latitude,lon\n1,2,3\n4,5,6\n", "1,2\n3,4\n"})
    EXPECT_FALSE(says(any(text), sphere)) << text;
  EXPECT_FALSE(says(any(places, {.columns = {"lat"}}), sphere));
}

TEST(ReadTable, WholeNumbersBesideFractionsAreNamed) {
  std::string four, six, fractions, two;
  for (int i = 0; i < 8; ++i) {
    const std::string xyz = std::to_string(i) + ".5 0.25 " + std::to_string(7 * i % 5) + ".125";
    four += xyz + " " + std::to_string(3 * i) + "\n";
    six += xyz + " 1 2 3\n";
    fractions += xyz + " 0.5\n";
    two += std::to_string(i) + ".5 0.25 1 2\n";
  }
  EXPECT_TRUE(says(any(four),
                   "column 4 has only whole numbers, unlike the first three, and is read as a "
                   "coordinate; columns 1-3 leaves it out"));
  EXPECT_TRUE(says(any(six), "columns 4 to 6 have only whole numbers"));
  for (const std::string& text : {fractions, two, four.substr(0, four.find('\n'))})
    EXPECT_FALSE(says(any(text), "whole numbers")) << text;
  EXPECT_FALSE(says(any(four, {.columns = {"1-3"}}), "whole numbers"));
  std::vector<double> numbers;
  for (int i = 0; i < 20; ++i) numbers.insert(numbers.end(), {i + 0.5, i * 0.3, 0.7, 5.0 * i});
  EXPECT_TRUE(says(any(npy("(20, 4)", numbers)), "column 4 has only whole numbers"));
}

TEST(ReadTable, ANumberOfRowsBeforeTheRowsIsChecked) {
  for (const char* text :
       {"//X Y Z R\n2\n0.5 1 2 9\n3 4 5 9\n", "2\n0.5 1 2\n3 4 5\n", "x,y\n3\n0.5,1\n3,4\n5,6\n"}) {
    const ReadResult result = any(text);
    EXPECT_EQ(std::get<Points>(result.data)(0, 0), 0.5) << text;
    EXPECT_TRUE(says(result, "says the number of rows")) << text;
  }
  const auto message = [](const std::string& text) { return bad_data([&] { any(text); }); };
  EXPECT_TRUE(contains(message("x y\n3\n0.5 1\n3 4\n"),
                       "truncated, found 2 points, expected 3, as line 2 says"));
  EXPECT_TRUE(contains(message("x y\n3\n"), "truncated, found 0 points, expected 3"));
  EXPECT_TRUE(contains(message("x y\n3\n0"), "truncated, found 1 points, expected 3"));
  EXPECT_TRUE(contains(message("1\n0.5 1 2\n3 4 5\n"),
                       "trailing data, found 2 points, expected 1, as line 1 says"));
  EXPECT_TRUE(contains(message("2\n0.5 1\n"), "ragged row")) << "may be a truncated triangle";
  EXPECT_TRUE(contains(message("2.5\n0.5 1 2\n3 4 5\n"), "ragged row"));
  EXPECT_EQ(any("1\n2 3\n4 5 6\n").format, Format::lower_distance);
  EXPECT_EQ(std::get<Points>(any("3\n1\n2\n").data).rows(), 3) << "points on a line";
  const std::string square = "0 1 2\n1 0 3\n2 3 0\n";
  EXPECT_EQ(std::get<DistanceMatrix>(any("3\n" + square).data).size(), 3);
  EXPECT_TRUE(contains(message("4\n" + square), "t.csv:1:1: number of rows, found 4, expected 3"));
}

TEST(ReadTable, ChoosesColumns) {
  const std::string text = "name,x,2,y\na,1,2,3\nb,4,5,6\n";
  const auto points = [&](std::vector<std::string> columns) {
    return std::get<Points>(any(text, {.columns = std::move(columns)}).data);
  };
  // A line that contains a number is still a header if it contains a requested name. The request
  // "2" is refused, because 2 may be a name or a position.
  EXPECT_EQ(points({"x"}), (Points{{1}, {4}}));
  EXPECT_TRUE(fails_with(ErrorKind::usage, [&] { points({"x", "2"}); }));
  EXPECT_TRUE(fails_with(ErrorKind::usage, [&] { points({"z"}); }));
  const std::string named = "name,x,u,y\na,1,2,3\nb,4,5,6\n";
  const auto of = [&](std::vector<std::string> columns) {
    return std::get<Points>(any(named, {.columns = std::move(columns)}).data);
  };
  EXPECT_EQ(of({"y", "x"}), (Points{{1, 3}, {4, 6}}));
  EXPECT_EQ(of({"2-3"}), (Points{{1, 2}, {4, 5}}));
  for (const char* wrong : {"z", "5", "0", "3-2", "-", "2-", "99999999999999999999"}) {
    EXPECT_TRUE(fails_with(ErrorKind::usage, [&] { of({wrong}); })) << wrong;
  }
  EXPECT_TRUE(fails_with(ErrorKind::usage, [&] { of({"x", "2"}); }));
  EXPECT_TRUE(fails_with(ErrorKind::usage, [&] {
    read_any(Input::view("OFF\n1 0 0\n0 0 0\n", "m.off"), Format::off, {.columns = {"1"}});
  }));
}

TEST(ReadTable, YearsAreNamesIfAskedFor) {
  const std::string text = "city,2019,2020\nA,1.5,2\nB,3.5,4\n";
  const ReadResult named = any(text, {.columns = {"2019", "2020"}});
  EXPECT_EQ(std::get<Points>(named.data), (Points{{1.5, 2}, {3.5, 4}}));
  const ReadResult numbered = any(text, {.columns = {"2-3"}});
  EXPECT_EQ(std::get<Points>(numbered.data).rows(), 3);
  EXPECT_TRUE(says(numbered, "line 1 is read as numbers"));
  EXPECT_FALSE(says(any("A,1,2\nB,3,4\n", {.columns = {"2-3"}}), "line 1 is read"));
  EXPECT_EQ(std::get<Points>(any("0,1\n1.5,2\n", {.columns = {"0"}}).data), Points{{1.5}});
  for (const std::string points : {"0,2\n3,4\n", "0,1\n2,3\n", "0,2.5\n3,4.5\n"})
    EXPECT_THROW(any(points, {.columns = {"0"}}), Error) << points;
}

TEST(ReadTable, AnEmptyFirstCellIsAMissingValueIfNumbersFollow) {
  const std::string text = ",5.5\n0.5,0.25\n1,2\n";
  EXPECT_TRUE(
      contains(bad_data([&] { any(text, {.array = ArrayMeaning::points}); }), "1:1: empty cell"));
  const ReadResult kept = any(text, {.nan = NanPolicy::drop, .array = ArrayMeaning::points});
  EXPECT_EQ(std::get<Points>(kept.data), (Points{{0.5, 0.25}, {1, 2}}));
  // A line is a header if it numbers the columns, or if the rows below it begin with names.
  EXPECT_EQ(std::get<Points>(any(",1,2\n1,1.5,2\n2,3.5,4\n").data), (Points{{1.5, 2}, {3.5, 4}}));
  const ReadResult labelled =
      any("\"\",\"34\",\"7\"\n\"34\",0,2.5\n\"7\",2.5,0\n", {.array = ArrayMeaning::distances});
  EXPECT_EQ(std::get<DistanceMatrix>(labelled.data).size(), 2);
  EXPECT_EQ(std::get<Points>(any(",2019,2020\nA,1.5,2\nB,3.5,4\n").data),
            (Points{{1.5, 2}, {3.5, 4}}));
}

TEST(ReadTable, MissingValuesAreNoHeader) {
  for (const std::string missing : {"NA", "#N/A", "\"NA\""}) {
    const std::string text = missing + "\n4\n7\n";
    EXPECT_TRUE(contains(bad_data([&] { any(text); }), "1:1: not a number")) << missing;
    const ReadResult kept = any(text, {.nan = NanPolicy::drop});
    EXPECT_EQ(std::get<Points>(kept.data), (Points{{4}, {7}})) << missing;
    EXPECT_EQ(kept.point_ids, (std::vector<Index>{1, 2})) << missing;
  }
  EXPECT_TRUE(contains(bad_data([&] { any("1,2\n3,#DIV/0!\n"); }), "2:3: not a number"));
}

TEST(ReadTable, ATabSeparatesTwoCells) {
  const std::string text = "\tx\ty\tz\n0\t1.5\t\t7\n1\t2.5\t3\t8\n2\t4\t5\t\n3\t1\t2\t3\n";
  EXPECT_TRUE(contains(bad_data([&] { any(text); }), ":2:7: empty cell"));
  const ReadResult kept = any(text, {.nan = NanPolicy::drop});
  EXPECT_EQ(std::get<Points>(kept.data), (Points{{2.5, 3, 8}, {1, 2, 3}}));
  EXPECT_TRUE(contains(bad_data([&] { any("1\t2\n\t\n"); }), ":2:1: empty cell"));
  EXPECT_TRUE(contains(bad_data([&] { any("1\t2\n\t3\n"); }), ":2:1: empty cell"));
  EXPECT_EQ(std::get<Points>(any("refl x\ty (m)\n1\t2\t\n3\t4\t\n").data),
            (Points{{1, 2}, {3, 4}}));
  EXPECT_EQ(std::get<Points>(any("1\t2\t\t# c\n\t# c\n3\t4\n").data), (Points{{1, 2}, {3, 4}}));
  EXPECT_TRUE(contains(bad_data([&] { any("1\t\t2\n3\t\t4\n"); }), "write one tab between cells"));
  // In a table whose separators are blanks, a tab counts as a blank.
  EXPECT_EQ(std::get<Points>(any("x y\t\n1 2\t\n3 4\t\n").data), (Points{{1, 2}, {3, 4}}));
  EXPECT_EQ(std::get<Points>(any("x\t\ty\n1 2\n3 4\n").data), (Points{{1, 2}, {3, 4}}));
  EXPECT_EQ(std::get<Points>(any("1 2\t3\n4\t\t5 6\n\t7 8 9\n").data),
            (Points{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}}));
}

TEST(ReadTable, ColumnsThatAreNotReadHoldAnything) {
  for (const std::string city :
       {"New York", "\"say \"\"hi\"\", now\"", "\"a#1\"", "a;b", "2020-01-01 0:00"}) {
    const std::string text = "city,x,y\n" + city + ",1,2\nParis,3,4\n";
    EXPECT_EQ(std::get<Points>(any(text, {.columns = {"x", "y"}}).data), (Points{{1, 2}, {3, 4}}))
        << city;
  }
  EXPECT_EQ(std::get<Points>(any(",x,y\nfoo bar,1,2\nbaz,3,4\n").data), (Points{{1, 2}, {3, 4}}));
}

TEST(ReadTable, LeavesAnIndexOfLevelsOut) {
  const ReadResult result = any(",,x,y\n0,1,5.5,6\n0,2,7,8\n");
  EXPECT_EQ(std::get<Points>(result.data), (Points{{5.5, 6}, {7, 8}}));
  EXPECT_TRUE(says(result, "the first 2 columns have no name"));
  // R writes the names of rows in quotes, without a name for the column of these names.
  EXPECT_EQ(std::get<Points>(any("\"x\" \"y\"\n\"7\" 2 3\n\"9\" 4 5\n").data),
            (Points{{2, 3}, {4, 5}}));
  EXPECT_EQ(std::get<Points>(any("id,a,b\n1.0,5,6\n2.0,7,9\n").data), (Points{{5, 6}, {7, 9}}));
}

TEST(ReadTable, ReadsTheHeaderOfCloudCompare) {
  const std::string text = "//X Y Z R\n1 2 3 255\n4 5 6 0\n";
  EXPECT_EQ(std::get<Points>(any(text, {.columns = {"X", "Y", "Z"}}).data),
            (Points{{1, 2, 3}, {4, 5, 6}}));
}

TEST(ReadTable, SaysWhatMayBeAHeaderOfNumbers) {
  EXPECT_TRUE(says(any("0\n0.5\n1.5\n"), "the first row is a whole number"));
  EXPECT_FALSE(says(any("0.0\n0.5\n1.5\n"), "the first row"));
  EXPECT_TRUE(says(any("0,1,2,3,4\n5,7,9,1,0.5\n", {.array = ArrayMeaning::image}),
                   "the first row holds column numbers and is read as values"));
}

TEST(ReadTable, EmptyCellsAreMissingIfNanIsDropped) {
  const std::string text = ",a,b,c\na,1,,0.5\nb,,1,\nc,0.5,,1\n";
  const ReadOptions options{.from_correlation = true, .nan = NanPolicy::drop};
  const auto d = std::get<DistanceMatrix>(any(text, options).data);
  EXPECT_EQ(d(0, 2), 0.5);
  EXPECT_EQ(d(0, 1), kInf);
  EXPECT_EQ(d(2, 1), kInf);
  bad_data([&] { any(text, {.from_correlation = true}); });
}

std::string repeated(std::string_view text, int times) {
  std::string all;
  while (times-- > 0) all += text;
  return all;
}

TEST(ReadTable, CellsOfNothingTakeAByte) {
  const std::string wide = repeated("1,,,,,,,,,2\n", 1000);
  const Points two = std::get<Points>(any(wide, {.columns = {"1", "10"}}).data);
  ASSERT_EQ(two.rows(), 1000);
  for (Index i = 0; i < two.rows(); ++i) ASSERT_TRUE(two(i, 0) == 1 && two(i, 1) == 2) << i;
  const std::string holes = "1,2,3,4\n" + repeated(",,,\n", 1000);
  EXPECT_EQ(std::get<Points>(any(holes, {.nan = NanPolicy::drop}).data).rows(), 1);
  const ReadResult grid =
      read_any(Input::view(holes, "g.csv"), Format::grid, {.nan = NanPolicy::drop});
  EXPECT_EQ(std::get<Image>(grid.data).extents, (std::vector<Index>{1001, 4}));
  std::string unknown_cells = "a";
  for (int i = 1; i < 40; ++i) unknown_cells += ",a" + std::to_string(i);
  unknown_cells += '\n' + repeated(repeated(",", 39).append("\n"), 40);
  const auto unknown = std::get<DistanceMatrix>(
      read_any(Input::view(unknown_cells, "d.csv"), Format::distance, {.nan = NanPolicy::drop})
          .data);
  EXPECT_EQ(unknown.size(), 40);
  EXPECT_EQ(unknown(3, 7), kInf);
}

TEST(ReadTable, TheLastCellMayBeEmptyWhereItIsNotTaken) {
  EXPECT_EQ(std::get<Points>(any("1,2,3\n4,5,\n", {.columns = {"1-2"}}).data),
            (Points{{1, 2}, {4, 5}}));
  const auto distances = [](const std::string& text) {
    return std::get<DistanceMatrix>(
        read_any(Input::view(text, "m.csv"), Format::distance, {.columns = {"1-3"}}).data);
  };
  EXPECT_EQ(distances("0,1,2,9\n1,0,3,\n2,3,0,\n")(1, 2), 3);
  const std::string message = bad_data([&] { distances("0,1,2,9,9,9,9\n1,0\n2,3,0,9,9,9,9\n"); });
  EXPECT_TRUE(contains(message, "found 2 cells, expected 7")) << message;
}

TEST(ReadTable, ColumnsAndRowsMayHaveNumbers) {
  const auto is_matrix = [](const std::string& text, const char* note) {
    const ReadResult result = any(text);
    ASSERT_EQ(result.format, Format::distance) << text;
    EXPECT_EQ(std::get<DistanceMatrix>(result.data).size(), 3) << text;
    EXPECT_EQ(std::get<DistanceMatrix>(result.data)(1, 2), 3) << text;
    EXPECT_TRUE(says(result, note)) << text;
  };
  for (const char* header : {"0,1,2\n", "1,2,3\n", "\"0\",\"1\",\"2\"\n"})
    is_matrix(std::string(header) + "0,1,2\n1,0,3\n2,3,0\n", "line 1 holds the column numbers");
  is_matrix("0,0,1,2\n1,1,0,3\n2,2,3,0\n", "first column holds the row numbers");
  is_matrix("1 0 1 2\n2 1 0 3\n3 2 3 0\n", "first column holds the row numbers");
  EXPECT_TRUE(
      contains(bad_data([] { any("0,1,2\n1,.5,.2\n.5,1,.3\n.2,.3,1\n"); }), "from_correlation"));
  // In images and points, nothing is removed, but there is a note about rows or columns that seem
  // to count.
  const ReadResult slope = read_any(Input::view("0 1 2 3\n1 2 3 4\n2 3 4 5\n", "s"), Format::grid);
  EXPECT_EQ(std::get<Image>(slope.data).extents, (std::vector<Index>{3, 4}));
  EXPECT_EQ(std::get<Points>(
                read_any(Input::view("0 1 2\n5 1 2\n1 7 3\n2 3 4\n", "p"), Format::points).data)
                .rows(),
            4);
  const ReadResult three = any("0,1,2\n5,1,2\n9,7,3\n2,3,4\n");
  EXPECT_EQ(std::get<Points>(three.data).rows(), 4);
  EXPECT_TRUE(says(three, "first row holds column numbers"));
  EXPECT_TRUE(says(any("0,1\n0.25,1.5\n"), "first row holds column numbers"));
  EXPECT_FALSE(says(any("0,1\n5,7\n"), "first row"));
  EXPECT_EQ(std::get<Points>(any("0,0,1,2\n1,4,5,3\n2,2,3,0\n").data).cols(), 4);
}

TEST(ReadTable, NamesOfColumnsHaveOneMeaning) {
  const auto first = [](const std::string& text, const std::string& column) {
    return std::get<Points>(any(text, {.columns = {column}}).data)(0, 0);
  };
  const std::string numbered = ",0,1,2\na,5,6,7\nb,1,2,3\n";
  for (const char* either : {"1", "2"})
    EXPECT_TRUE(fails_with(ErrorKind::usage, [&] { first(numbered, either); })) << either;
  EXPECT_EQ(first(numbered, "0"), 5);
  EXPECT_EQ(first(numbered, "3-3"), 6);
  EXPECT_EQ(first(numbered, "4"), 7);
  EXPECT_EQ(first("1,2,3\n5,6,7\n8,9,7\n", "2"), 2);  // the file has no header
  const std::string twice = "x,y,x\n5,6,7\n1,2,3\n";
  EXPECT_TRUE(fails_with(ErrorKind::usage, [&] { first(twice, "x"); }));
  EXPECT_EQ(first(twice, "3"), 7);
  const std::string of_r = "x y\na 5 6\nb 7 8\n";
  EXPECT_EQ(first(of_r, "x"), 5);
  EXPECT_EQ(first(of_r, "y"), 6);
}

TEST(ReadTable, ColumnsOfWhatIsNoTableAreRefused) {
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
      "property float z\nend_header\n1 2 3\n";
  std::string dipha;
  for (const std::int64_t word :
       {std::int64_t{8067171840}, std::int64_t{7}, std::int64_t{1}, std::int64_t{0}})
    dipha += le(word);  // the last word, 0, is the distance
  const ReadOptions options{.columns = {"1"}};
  const Input cloud = Input::view(ply, "c.ply"), matrix = Input::view(dipha, "m.dipha");
  EXPECT_TRUE(fails_with(ErrorKind::usage, [&] { read_any(cloud, Format::points, options); }));
  EXPECT_TRUE(fails_with(ErrorKind::usage, [&] { read_any(matrix, Format::distance, options); }));
  EXPECT_NO_THROW(read_any(cloud, Format::points));
  EXPECT_NO_THROW(read_any(matrix, Format::distance));
}

TEST(ReadTable, LettersOfOtherFormatsMayBeNames) {
  for (const char* text : {"PAR1,PAR2\n1,2\n3,4\n", "P3\n1\n2\n3\n", "P6\n1\n2\n3\n",
                           "LASF,b\n1,2\n3,4\n", "BZh,b\n1,2\n3,4\n", "GIF8 b\n1 2\n3 4\n"})
    EXPECT_GE(std::get<Points>(any(text).data).rows(), 2) << text;
  for (const auto& [bytes, name] : std::vector<std::pair<std::string, const char*>>{
           {std::string("PAR1\x15\x04\x15\0PAR1", 12), "Parquet"},
           {"P3\n# by hand\n2 1\n255\n1 2 3 4 5 6\n", "PPM"},
           {"P6\n2 1\n255\n123456", "PPM"},
           {"P1\n# two wide\n2 2\n0 1\n1 0\n", "PBM"},
           {"%%MatrixMarket matrix coordinate real general\n3 3 1\n1 2 0.5\n", "Matrix Market"},
           {std::string("BM\x3a\0\0\0\0\0\0\0\x36\0\0\0\x28", 15), "BMP"},
           {"solid cube\n facet normal 0 0 1\n", "STL"},
           {std::string("BZh91AY&SY\0\x01\x02", 13), "bzip2"}})
    EXPECT_TRUE(contains(bad_data([&] { any(bytes); }), name)) << name;
}

TEST(ReadTable, HintsSayWhatHelps) {
  const auto message = [](const std::string& text, const ReadOptions& options = {}) {
    return bad_data([&] { any(text, options); });
  };
  for (const char* text : {"1,2\n3,nan\n", "1,2\n,3\n", "1,2\n\"\",3\n"})
    EXPECT_TRUE(contains(message(text), "nan drop")) << message(text);
  EXPECT_TRUE(contains(message("1,2\na,3\n"), "names or an index?"));
  EXPECT_FALSE(contains(message("1,2\na,3\n"), "nan drop"));
  for (const char* text : {"1,2\n3,inf\n", "1,2\n3,1e999\n"})
    EXPECT_FALSE(contains(message(text), "; ")) << message(text);
}

TEST(ReadTable, RowsHaveTheOrderOfTheColumns) {
  EXPECT_EQ(any(",a,b,c\na,0,1,2\nb,1,0,3\nc,2,3,0\n").format, Format::distance);
  EXPECT_TRUE(contains(bad_data([] { any(",a,b,c\nb,0,1,2\na,1,0,3\nc,2,3,0\n"); }), "order"));
}

}  // namespace
}  // namespace ph::test
