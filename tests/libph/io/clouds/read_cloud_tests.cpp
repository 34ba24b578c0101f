// SPDX-License-Identifier: MIT
#include <cmath>

#include "ph/io/cloud.hpp"
#include "ph/io/read.hpp"
#include "tests/libph/io/clouds/motley_cloud.hpp"
#include "tests/libph/io/read_support.hpp"

namespace ph::test {
namespace {

std::string header(const std::string& fields, const std::string& size, const std::string& type,
                   const std::string& count, const std::string& width, const std::string& height,
                   const std::string& points, const std::string& data) {
  return "# .PCD v.7\nVERSION .7\nFIELDS " + fields + "\nSIZE " + size + "\nTYPE " + type +
         "\nCOUNT " + count + "\nWIDTH " + width + "\nHEIGHT " + height +
         "\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + points + "\nDATA " + data + "\n";
}
std::string xyz_header(const std::string& width, const std::string& height,
                       const std::string& points, const std::string& data) {
  return header("x y z", "4 4 4", "F F F", "1 1 1", width, height, points, data);
}
Cloud pcd(const std::string& bytes, const ReadOptions& options = {}) {
  return read_pcd(Input::view(bytes, "c.pcd"), options);
}

void expect_same(const Cloud& a, const Cloud& b) {
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  EXPECT_EQ(a.viewpoint, b.viewpoint);
  ASSERT_EQ(a.fields.size(), b.fields.size());
  for (std::size_t k = 0; k < a.fields.size(); ++k) {
    EXPECT_EQ(a.fields[k].name, b.fields[k].name);
    EXPECT_EQ(a.fields[k].type, b.fields[k].type);
    EXPECT_EQ(a.fields[k].count, b.fields[k].count);
    EXPECT_EQ(a.fields[k].offset, b.fields[k].offset);
  }
  EXPECT_TRUE(a.data == b.data);
}

TEST(Pcd, ReadsBackEveryFieldInEveryEncoding) {
  for (const Index height : {1, 7}) {
    const Cloud cloud = motley(300, height);
    for (const PcdData data : {PcdData::ascii, PcdData::binary, PcdData::binary_compressed}) {
      std::ostringstream out;
      write_pcd(out, cloud, data);
      expect_same(pcd(out.str()), cloud);
    }
  }
}

TEST(Pcd, EveryPrefixIsRejected) {
  const Cloud cloud = motley(3, 2);
  for (const PcdData data : {PcdData::ascii, PcdData::binary, PcdData::binary_compressed}) {
    std::ostringstream out;
    write_pcd(out, cloud, data);
    const std::string bytes = out.str();
    // In a text file, the last number may end after any of its digits.
    check_prefixes(
        bytes, "c.pcd", [](const Input& in) { read_pcd(in); },
        [&](std::size_t length) { return data == PcdData::ascii && length + 21 > bytes.size(); });
    if (data == PcdData::binary) {
      EXPECT_TRUE(
          contains(bad_data([&] { pcd(bytes.substr(0, bytes.size() - 1)); }), "5 of 6 points"));
    }
    bad_data([&] { pcd(bytes + "1 2 3\n"); });
  }
}

TEST(Pcd, RefusesBadHeadersBeforeAllocating) {
  const std::string body(24, '\0');
  for (const std::string& bytes : std::vector<std::string>{
           "",
           "VERSION .7\n",
           "VERSION 0.8\nFIELDS x\n",
           "VERSION .7\nDATA ascii\n",
           xyz_header("1000000000000", "1", "1000000000000", "binary") + body,
           xyz_header("1000000000000", "1", "1000000000000", "ascii") + "1 2 3\n",
           xyz_header("1000000000000", "1", "1000000000000", "binary_compressed") + body,
           xyz_header("4294967296", "4294967296", "0", "binary") + body,
           xyz_header("9223372036854775807", "1", "9223372036854775807", "binary") + body,
           xyz_header("9223372036854775808", "1", "1", "binary") + body,
           xyz_header("-2", "-1", "2", "binary") + body,
           xyz_header("2", "1", "3", "binary") + body,
           xyz_header("2", "1", "2", "binary") + body + "x",
           xyz_header("2", "1", "2", "gzip") + body,
           xyz_header("2", "1", "2", "") + body,
           xyz_header("2 2", "1", "2", "binary") + body,
           xyz_header("0", "1", "0", "binary"),
           header("x y z", "4 4 4", "F F F", "1 1 2000000000", "2", "1", "2", "binary") + body,
           header("x y z", "4 4 4", "F F F", "1 1 2000000000", "2", "1", "2", "ascii") +
               "1 2 3\n4 5 6\n",
           header("x y z", "4 4 4", "F F F", "1 1 9223372036854775807", "2", "1", "2", "binary") +
               body,
           header("x y z", "4 4 4", "F F F", "1 1 0", "2", "1", "2", "binary") + body,
           header("x y z", "4 4 4", "F F F", "1 1 -1", "2", "1", "2", "binary") + body,
           header("x y z", "4 4 3", "F F F", "1 1 1", "2", "1", "2", "binary") + body,
           header("x y z", "4 4 2", "F F F", "1 1 1", "2", "1", "2", "binary") + body,
           header("x y z", "4 4 4", "F F D", "1 1 1", "2", "1", "2", "binary") + body,
           header("x y z", "4 4", "F F F", "1 1 1", "2", "1", "2", "binary") + body,
           header("x y z", "4 4 4 4", "F F F", "1 1 1", "2", "1", "2", "binary") + body,
           header("x y x", "4 4 4", "F F F", "1 1 1", "2", "1", "2", "binary") + body,
           header("", "", "", "", "2", "1", "2", "binary") + body,
           "VERSION .7\nFIELDS x y z\nFIELDS x y z\n",
           "VERSION .7\nSIZE 4\n",
           "VERSION .7\nCOLOUR 4\n",
           "VERSION .7\nFIELDS x y z\nVIEWPOINT 0 0 0 1 0 0\n",
       }) {
    const std::string message = bad_data([&] { pcd(bytes); });
    EXPECT_TRUE(contains(message, "c.pcd")) << message;
  }
  EXPECT_EQ(pcd(xyz_header("0", "1", "0", "binary"), {.allow_empty = true}).size(), 0);
}

// PCL's tools pad binary data with zeros up to the end of a page.
TEST(Pcd, BinaryDataMayBePadded) {
  std::ostringstream out;
  write_pcd(out, motley(20, 2), PcdData::binary);
  const std::string whole = out.str();
  EXPECT_EQ(pcd(whole + std::string(4000, '\0')).data, pcd(whole).data);
  for (const std::string& more :
       {std::string(1, 'x'), std::string(4000, '\0') + "x", std::string(70000, '\0')})
    EXPECT_TRUE(contains(bad_data([&] { pcd(whole + more); }), "trailing data"));
}

TEST(Pcd, RefusesLyingCompression) {
  std::ostringstream out;
  write_pcd(out, motley(20, 2), PcdData::binary_compressed);
  const std::string whole = out.str();
  const std::size_t start = whole.find("binary_compressed\n") + 18;
  const auto with = [&](std::size_t at, std::uint32_t value) {
    std::string bytes = whole;
    bytes.replace(start + at, 4, le(value));
    return bytes;
  };
  const auto uncompressed = load<std::uint32_t>(
      reinterpret_cast<const std::byte*>(whole.data()) + start + 4, std::endian::little);
  for (const std::string& bytes :
       {with(0, 0), with(0, 1), with(0, 4000000000U), with(4, 0), with(4, uncompressed - 1),
        with(4, uncompressed + 1), with(4, 4000000000U), whole + "x"}) {
    bad_data([&] { pcd(bytes); });
  }
  EXPECT_EQ(pcd(whole + std::string(4000, '\0')).size(), 40);  // PCL pads files in this way
  bad_data([&] { pcd(whole + std::string(70000, '\0')); });
  // Replaces every byte of the compressed data: the reader gives an answer or an error, and never
  // reads out of bounds.
  for (std::size_t i = start + 8; i < whole.size(); ++i) {
    for (const int value : {0, 31, 32, 255}) {
      std::string bytes = whole;
      bytes[i] = static_cast<char>(value);
      fails_with(ErrorKind::bad_data, [&] { EXPECT_EQ(pcd(bytes).size(), 40); });
    }
  }
  // 2000 compressed bytes cannot unpack to a gigabyte.
  const std::string bomb = xyz_header("89478485", "1", "89478485", "binary_compressed") +
                           le(std::uint32_t{2000}) + le(std::uint32_t{1073741820}) +
                           std::string(2000, '\xFF');
  EXPECT_TRUE(contains(bad_data([&] { pcd(bomb); }), "compressed size"));
}

TEST(Pcd, ReadsOldAndMinimalHeaders) {
  const Cloud cloud =
      pcd("VERSION 0.5\r\nFIELDS x y z\r\nSIZE 4 4 4\r\nTYPE F F F\r\nPOINTS 2\r\nDATA ascii\r\n1 "
          "2 3\r\nnan 5 6\r\n");
  EXPECT_EQ(cloud.width, 2);
  EXPECT_EQ(cloud.height, 1);
  EXPECT_EQ(cloud.xyz()[2], 3);
  EXPECT_TRUE(std::isnan(cloud.xyz()[3]));
  for (const char* row : {"1 2\n", "1 2 3 4\n", "1 2 x\n", "1 2 1e39\n", "1,2,3\n4 5 6\n", ""}) {
    bad_data([&] { pcd(xyz_header("1", "1", "1", "ascii") + row); });
  }
  for (const char* value : {"256", "-1", "1.5", "x", ""}) {
    bad_data([&] {
      pcd(header("x a", "4 1", "F U", "1 1", "1", "1", "1", "ascii") + "1 " + value + "\n");
    });
  }
}

TEST(Cloud, HolesLabelsAndColours) {
  Cloud cloud =
      pcd(header("x y z rgb label", "4 4 4 4 4", "F F F F U", "1 1 1 1 1", "2", "1", "2", "ascii") +
          "nan nan nan nan 7\n1 2 3 4.2108e+06 8\n");
  EXPECT_TRUE(cloud.rgb().has_value());
  const std::size_t field = cloud.add_field("label_out", FieldType::uint32);
  cloud.set_uint32(field, {1, 2});
  EXPECT_EQ(cloud.xyz()[5], 3);
  EXPECT_EQ(cloud.stride, 24U);
  EXPECT_EQ(cloud.find("nothing"), nullptr);
  std::ostringstream out;
  write_pcd(out, cloud, PcdData::ascii);
  expect_same(pcd(out.str()), cloud);
  std::vector<Index> dropped;
  const Points points = read_points(Input::view(out.str(), "c.pcd"), {.dropped = &dropped});
  EXPECT_EQ(points, (Points{{1, 2, 3}}));
  EXPECT_EQ(dropped, std::vector<Index>{0});
  bad_data([] { pcd(header("a b", "4 4", "F F", "1 1", "1", "1", "1", "ascii") + "1 2\n").xyz(); });
  const std::string all_holes =
      xyz_header("2", "2", "4", "ascii") + "nan nan nan\nnan nan nan\nnan nan nan\nnan nan nan\n";
  EXPECT_EQ(pcd(all_holes).height, 2);
  EXPECT_TRUE(contains(bad_data([&] { read_any(Input::view(all_holes, "c.pcd")); }), "no points"));
}

TEST(Cloud, NamesThatAreNoWordsAreWrittenAsDifferentOnes) {
  Cloud cloud = motley(2, 1, false);
  cloud.fields[3].name = "a b";
  cloud.fields[4].name = "a,b";
  cloud.fields[5].name = "b_1";  // PLY's name for the second number of b
  std::ostringstream as_pcd, as_ply;
  write_pcd(as_pcd, cloud);
  write_ply(as_ply, cloud);
  const Cloud again = pcd(as_pcd.str());
  EXPECT_EQ(again.fields[3].name, "a_b");
  EXPECT_EQ(again.fields[4].name, "a_b_2");
  EXPECT_TRUE(again.data == cloud.data);
  const Cloud split = read_ply(Input::view(as_ply.str(), "c.ply"));
  EXPECT_NE(split.find("b_1"), nullptr);
  EXPECT_NE(split.find("b_1_2"), nullptr);
}

TEST(Pcd, APointHasALargestSize) {
  const std::string many =
      header("x y z w", "4 4 4 8", "F F F F", "1 1 1 1152921504606846975", "0", "1", "0", "ascii");
  EXPECT_TRUE(contains(bad_data([&] { pcd(many, {.allow_empty = true}); }), "points too large"));
}

TEST(ReadXyz, NamesColumns) {
  const auto xyz = [](const std::string& text) { return read_cloud(Input::view(text, "c.xyz")); };
  const Cloud plain = xyz("1 2 3\nnan nan nan\n4000000.123456789 5 6\n");
  EXPECT_EQ(plain.size(), 3);
  EXPECT_EQ(points_of(plain)(2, 0), 4000000.123456789);
  EXPECT_TRUE(std::isnan(points_of(plain)(1, 0)));
  EXPECT_FALSE(plain.rgb().has_value());
  const Cloud coloured = xyz("1 2 3 255 0 16\n");
  EXPECT_EQ(coloured.rgb()->at(0), 0xFF0010U);
  const Cloud normals = xyz("1 2 3 0.5 0 1\n");
  EXPECT_EQ(normals.fields[3].name, "field_3");
  const Cloud named = xyz("label,Z,Y,X\n7,3,2,1\n");
  EXPECT_EQ(points_of(named), (Points{{1, 2, 3}}));
  EXPECT_EQ(points_of(xyz("//X Y Z R G B\n1 2 3 0 0 0\n")), (Points{{1, 2, 3}}));
  // A column with a name but without values still counts as a column.
  EXPECT_TRUE(contains(
      bad_data([&] { xyz("i,x,y,z,note\n9,1,2,3,\n8,4,5,6,\n"); }),
      "c.xyz:2:1: ragged row, found 4 cells, expected 5, the number of names in the header"));
  for (const char* text : {"1 2\n", "a,b,c\n1,2,3\n", "1 2 inf\n", "", "1 2 3\n4 5\n",
                           "x,y,z,a,a\n0,0,0,1,2\n", "a,x,y,z\n1,2,3,inf\n"}) {
    bad_data([&] { xyz(text); });
  }
}

/// A NumPy file with little-endian numbers in C order.
template <class T>
std::string npy(const std::string& descr, const std::string& shape, const std::vector<T>& values) {
  const std::string header =
      "{'descr': '" + descr + "', 'fortran_order': False, 'shape': " + shape + "}\n";
  std::string bytes =
      std::string("\x93NUMPY\x01\x00", 8) + le(static_cast<std::uint16_t>(header.size())) + header;
  for (const T value : values) bytes += le(value);
  return bytes;
}

TEST(ReadXyz, LeavesAnIndexOut) {
  std::vector<std::string> notes;
  const ReadOptions options{.note = [&](const Message& text) { notes.push_back(text.str()); }};
  for (const std::string text : {",x,y,z\n0,1,2,3\n1,4,5,NA\n", "x y z\n1 1 2 3\n2 4 5 nan\n",
                                 "\"\",\"x\",\"y\",\"z\"\n\"a\",1,2,3\n\"b\",4,5,nan\n"}) {
    notes.clear();
    const Cloud cloud = read_xyz(Input::view(text, "c.csv"), options);
    EXPECT_EQ(cloud.fields.size(), 3U) << text;
    EXPECT_EQ(cloud.size(), 2) << text;
    EXPECT_EQ(cloud.xyz()[1], 2) << text;
    EXPECT_TRUE(std::isnan(cloud.xyz()[5])) << text;
    ASSERT_EQ(notes.size(), 2U) << text;
    EXPECT_TRUE(contains(notes[1], "left out")) << text;
    EXPECT_FALSE(contains(notes[1], "columns")) << text;
  }
  EXPECT_EQ(read_xyz(Input::view("id,x,y,z\n7,1,2,3\n", "c.csv")).fields.size(), 4U);
}

TEST(ReadXyz, TakesTheAtomsOfAMolecule) {
  const std::string water =
      "3\nwater, in # Å\nO 0 0 0.119\nH1\t0 0.763 -0.477\nH2 0 -0.763 -0.477\n";
  const Points expected{{0, 0, 0.119}, {0, 0.763, -0.477}, {0, -0.763, -0.477}};
  for (const char* name : {"w.xyz", "w.txt", "w"}) {
    const ReadResult result = read_any(Input::view(water, name));
    EXPECT_EQ(result.format, Format::xyz) << name;
    EXPECT_EQ(std::get<Points>(result.data), expected) << name;
    ASSERT_EQ(result.notes.size(), 1U) << name;
    EXPECT_TRUE(contains(result.notes[0].str(), "a molecule of 3 atoms: line 2, \"water, in # "))
        << name;
    EXPECT_EQ(points_of(read_cloud(Input::view(water, name))), expected) << name;
  }
  const std::string salt =
      "2\r\nLattice=\"5 0 0 0 5 0 0 0 5\" Properties=species:S:1:pos:R:3:charge:R:1\r\n"
      "Na 0 0 0 1\r\nCl 2.5 0 0 -1";
  const ReadResult result = read_any(Input::view(salt, "s.xyz"));
  EXPECT_EQ(std::get<Points>(result.data), (Points{{0, 0, 0}, {2.5, 0, 0}}));
  EXPECT_TRUE(contains(result.notes.at(0).str(), "the elements and the columns after z are left"));
  EXPECT_EQ(points_of(read_xyz(Input::view("1\n\nHe 1 2 3", "a.xyz"))), (Points{{1, 2, 3}}));
  const std::pair<std::string, const char*> faults[] = {
      {"2\n\nC 0 0 0\nC 1 0 0\nC 2 0 0\n",
       "m.xyz:5:1: trailing data, found C 2 0 0, expected 2 atoms, as line 1 says; if there are "
       "several molecules"},
      {"1\n\nC 0 0 0\n1\n\nC 0 0 1\n", "m.xyz:4:1: trailing data, found 1, expected 1 atoms"},
      {"3\n\nC 0 0 0\nC 1 0 0.5\n", "m.xyz:1:1: truncated, found at most 2, expected 3 atoms"},
      {"3\n\nC 0.25 0.25 0.25\nC 1 0 0.5\n", "m.xyz:4:1: truncated, found 2 atoms, expected 3"},
      {"9999999999999999\n\nC 0 0 0\n", "truncated, found at most 1"},
      {"2\n\nC 0 0 0\n6 0 0 1\n", "m.xyz:4:1: atom without an element, found 6"},
      {"2\n\nC 0 0 0\nC 0 zero 1\n", "m.xyz:4:5: not a number, found \"zero\""},
      {"2\n\nC 0 0 0\nC 0 inf 1\n", "infinite coordinate of point 1"},
      {"1\nProperties=species:S:1:forces:R:3:pos:R:3\nC 0 0 1 5 5 5\n",
       "m.xyz:2:1: columns of a molecule, found Properties=species:S:1:forces"},
      {"2\nlong\nCarbon 0 0 0\nC 0 0 1\n", "not a number, found \"long\""},
      {"2\n\nC 0 0 x\nC 0 0 1\n", "not a number, found \"C\""},
  };
  for (const auto& [text, message] : faults) {
    const std::string found = bad_data([&, t = text] { read_any(Input::view(t, "m.xyz")); });
    EXPECT_TRUE(contains(found, message)) << found;
  }
}

TEST(ReadNpyCloud, TakesPointsAndOrganisedPoints) {
  const auto cloud = [](const std::string& bytes) {
    return read_cloud(Input::view(bytes, "c.npy"));
  };
  const std::vector<float> six{1, 2, 3, std::nanf(""), 5, 6};
  const Cloud points = cloud(npy("<f4", "(2, 3)", six));
  EXPECT_EQ(points.width, 2);
  EXPECT_FALSE(points.organised());
  EXPECT_EQ(points.fields.size(), 3U);
  EXPECT_EQ(points.xyz()[2], 3);
  EXPECT_TRUE(std::isnan(points.xyz()[3]));
  const Cloud organised = cloud(npy("<f4", "(2, 1, 3)", six));
  EXPECT_EQ(organised.width, 1);
  EXPECT_EQ(organised.height, 2);
  EXPECT_EQ(organised.xyz()[5], 6);
  const Cloud bytes = cloud(npy<double>("<f8", "(1, 6)", {1, 2, 3, 255, 0, 16}));
  EXPECT_EQ(bytes.rgb()->at(0), 0xFF0010U);
  const Cloud shares = cloud(npy<double>("<f8", "(2, 6)", {1, 2, 3, 1, 0, 1, 0, 0, 0, 1, 0.2, 0}));
  EXPECT_EQ(*shares.rgb(), (std::vector<std::uint32_t>{0xFF00FF, 0xFF3300}));
  const Cloud intensity = cloud(npy<double>("<f8", "(1, 4)", {1, 2, 3, 7}));
  EXPECT_EQ(intensity.fields[3].name, "field_3");
  const struct {
    std::string bytes, message;
  } faults[] = {
      {npy("<f4", "(3, 2)", six), "save its transpose"},
      {npy<double>("<f8", "(3, 100)", std::vector<double>(300)), "save its transpose"},
      {npy<double>("<f8", "(70, 80)", std::vector<double>(5600)), "camera or intrinsics"},
      {npy("<f4", "(6,)", six), "found shape (6), expected (points, n)"},
      {npy<std::int32_t>("<i4", "(1, 3)", {1, 2, 3}), "found whole numbers, expected floats"},
      {npy<double>("<f8", "(1, 3)", {1, 2, HUGE_VAL}), "infinite coordinate of point 0"},
      {npy<float>("<f4", "(0, 3)", {}), "no points"},
      {npy<float>("<f4", "(2, 3)", {1, 2}), "truncated"},
  };
  for (const auto& [content, message] : faults)
    EXPECT_TRUE(contains(bad_data([&, b = content] { cloud(b); }), message)) << message;
}

// A structured array. @param descr the list of its fields.
std::string records(const std::string& descr, const std::string& shape, const std::string& data) {
  std::string header = "{'descr': " + descr + ", 'fortran_order': False, 'shape': " + shape + ", }";
  header.resize(245, ' ');
  return std::string("\x93NUMPY\x01\x00", 8) + le(std::uint16_t{246}) + header + "\n" + data;
}

TEST(ReadRecords, FieldsAreCoordinates) {
  std::string plain, full;
  for (const float x : {0.5F, 3.0F}) {
    plain += le(x) + le(x + 1) + le(x + 2);
    full += std::string("\7") + le(x) + le(x + 1) + std::string("pad_") + le(x + 2) + "text" +
            le(std::uint16_t{9}) + le(std::uint16_t{8});
  }
  const Points expected{{0.5, 1.5, 2.5}, {3, 4, 5}};
  const auto points = [](const std::string& bytes, const ReadOptions& options = {}) {
    return read_any(Input::view(bytes, "a.npy"), Format::automatic, options);
  };
  const std::string vertices =
      records("[('f0', '<f4'), ('f1', '<f4'), ('f2', '<f4')]", "(2,)", plain);
  const std::string cloud = records(
      "[('ring', '|u1'), ('X', '<f4'), ('Y', '<f4'), ('', '|V4'), ('Z', '<f4'), ('name', '|S4'), "
      "('rg', '<u2', (2,))]",
      "(1, 2)", full);
  EXPECT_EQ(std::get<Points>(points(vertices).data), expected);
  const ReadResult some = points(cloud);
  EXPECT_EQ(std::get<Points>(some.data), expected);
  ASSERT_EQ(some.notes.size(), 1U);
  EXPECT_EQ(some.notes[0].str(),
            "a structured array with the fields ring, X, Y, Z, name, rg: X, Y and Z are read as "
            "coordinates; columns NAMES chooses others");
  EXPECT_EQ(std::get<Points>(points(cloud, {.columns = {"ring", "rg_1", "Z"}}).data),
            (Points{{7, 2.5, 8}, {7, 5, 8}}));
  const auto cloud_of = [](const std::string& bytes) {
    return read_cloud(Input::view(bytes, "a.npy"));
  };
  EXPECT_EQ(points_of(cloud_of(vertices)), expected);
  const Cloud all = cloud_of(cloud);
  EXPECT_EQ(points_of(all), expected);
  EXPECT_EQ(all.fields.size(), 5U) << "padding and text are left out";
  EXPECT_EQ(all.find("rg")->count, 2U);
  EXPECT_EQ(all.width, 2);
  // Big-endian numbers are swapped.
  std::string swapped = plain;
  for (std::size_t k = 0; k < swapped.size(); k += 4)
    std::reverse(swapped.begin() + static_cast<std::ptrdiff_t>(k),
                 swapped.begin() + static_cast<std::ptrdiff_t>(k + 4));
  const std::string big = records("[('x', '>f4'), ('y', '>f4'), ('z', '>f4')]", "(2,)", swapped);
  EXPECT_EQ(std::get<Points>(points(big).data), expected);
  EXPECT_EQ(points_of(cloud_of(big)), expected);
  for (std::size_t length = 0; length < cloud.size(); ++length)
    bad_data([&] { points(cloud.substr(0, length)); });
}

TEST(ReadRecords, RefusesWhatIsNotACloud) {
  const auto message = [](const std::string& bytes, const ReadOptions& options = {}) {
    return bad_data([&] { read_any(Input::view(bytes, "a.npy"), Format::automatic, options); });
  };
  const std::string eight(8, '\0');
  const struct {
    std::string bytes, words;
  } faults[] = {
      {records("[('a', '<f4'), ('label', '<i4')]", "(1,)", eight),
       "found fields a, label, expected fields x, y and z, or only floats; columns NAMES"},
      {records("[('a', '<f4')]", "(3,)", eight), "truncated, found 8 bytes, expected 12"},
      {records("[('a', '<f4')]", "(1,)", eight), "trailing data"},
      {records("[('a', '<f4'), ('a', '<f4')]", "(1,)", eight), "field named twice, found a"},
      {records("[('a', [('b', '<f4')])]", "(1,)", eight), "a structure in a structure"},
      {records("[('a', 'f')]", "(1,)", eight), "type of a field, found f"},
      {records("[('a', '<f4', (0,))]", "(1,)", eight), "records of 0 bytes"},
      {records("[]", "(1,)", eight), "records of 0 bytes"},
      {records("[('a', '<f4', (1048577,))]", "(1,)", eight), "more than 2^20 bytes"},
      {records("[('a', '|V1048577')]", "(1,)", eight), "more than 2^20 bytes"},
      {records("[('a', '<f4' ('b', '<f4')]", "(1,)", eight), "NPY header"},
  };
  for (const auto& [bytes, words] : faults)
    EXPECT_TRUE(contains(message(bytes), words)) << message(bytes);
  const std::string vertices = records("[('x', '<f8')]", "(1,)", eight);
  EXPECT_TRUE(contains(message(vertices, {.array = ArrayMeaning::image}), "a structured array"));
  EXPECT_TRUE(contains(bad_data([&] { read_cloud(Input::view(vertices, "a.npy")); }),
                       "found fields x, expected fields x, y and z, or three fields of floats"));
}

TEST(ReadClouds, CapitalsNameCoordinates) {
  const std::string pcd =
      "VERSION 0.7\nFIELDS X Y Z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 1\nHEIGHT 1\n"
      "POINTS 1\nDATA ascii\n1 2 3\n";
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float X\nproperty float Y\n"
      "property float Z\nend_header\n1 2 3\n";
  for (const std::string& text : {pcd, ply}) {
    EXPECT_EQ(std::get<Points>(read_any(Input::view(text, "c"), Format::automatic).data),
              (Points{{1, 2, 3}}));
    EXPECT_NE(read_cloud(Input::view(text, "c")).find("z"), nullptr);
  }
}

TEST(ReadClouds, OrganisedArraysArePoints) {
  const std::string bytes = npy<float>("<f4", "(2, 1, 3)", {1, 2, 3, 4, 5, 6});
  const auto read = [&](ArrayMeaning meaning) {
    return read_any(Input::view(bytes, "a.npy"), Format::automatic, {.array = meaning});
  };
  EXPECT_EQ(std::get<Points>(read(ArrayMeaning::points).data), (Points{{1, 2, 3}, {4, 5, 6}}));
  const ReadResult volume = read(ArrayMeaning::automatic);
  EXPECT_TRUE(std::holds_alternative<Image>(volume.data));
  ASSERT_EQ(volume.notes.size(), 1U);
  EXPECT_EQ(volume.notes[0].str(),
            "an array of three axes: read as a volume; format points reads 2 x 1 points with three "
            "coordinates each");
}

TEST(ReadDepth, KnowsWhichUnitIsUsual) {
  const auto depth = [](const std::string& bytes, const std::string& name = "d.npy") {
    return read_depth(Input::view(bytes, name));
  };
  const DepthImage metres = depth(npy<float>("<f4", "(1, 3)", {0.5F, std::nanf(""), 2}));
  EXPECT_EQ(metres.scale, 1);
  EXPECT_EQ(metres.depth.extents, (std::vector<Index>{1, 3}));
  const Cloud cloud = cloud_from_depth(metres.depth, {}, {{1, 1, 0, 0}}, metres.scale);
  EXPECT_EQ(cloud.xyz()[2], 0.5F);
  EXPECT_TRUE(std::isnan(cloud.xyz()[5]));
  EXPECT_EQ(cloud.xyz()[8], 2);
  EXPECT_EQ(depth(npy<std::uint16_t>("<u2", "(1, 2)", {1, 2})).scale, 1000);
  EXPECT_EQ(depth(npy<std::int32_t>("<i4", "(1, 2)", {1, 2})).scale, 1000) << "not a float";
  EXPECT_EQ(depth("P5 2 1 65535\n" + std::string(4, '\1'), "d.pgm").depth.values[1], 257);
  for (const std::string& bytes :
       {npy<float>("<f4", "(1, 2, 3)", std::vector<float>(6)), std::string("1 2 3\n")})
    bad_data([&] { depth(bytes); });
}

TEST(ReadDepth, RefusesMoreThanOneChannel) {
  for (const int channels : {1, 2, 3, 4}) {
    Raster raster{1, 1, channels, 8,
                  std::vector<std::uint16_t>(static_cast<std::size_t>(channels))};
    raster.samples.back() = 255;
    std::ostringstream out;
    write_png(out, raster);
    const std::string bytes = out.str();
    const auto read = [&] { read_depth(Input::view(bytes, "d.png")); };
    if (channels == 1) {
      EXPECT_NO_THROW(read());
      continue;
    }
    const std::string message = bad_data(read);
    EXPECT_TRUE(contains(message, "found " + std::to_string(channels) + " channels, expected 1"));
    EXPECT_FALSE(contains(message, "--")) << message;
  }
}

TEST(CloudFromDepth, CountsWhatCannotBe) {
  const Image depth{{1, 3}, {-1.0, 1.0, 1.0}};
  // In units of the focal length, the pixels are at -1, 0 and 1 from the centre. Beyond 0.7, the
  // lens has no rays.
  const Camera camera{{1, 1, 1, 0}, 3, 1, {Lens::Model::polynomial, {-0.3}}};
  DepthCounts counts;
  const std::vector<float> xyz = cloud_from_depth(depth, {}, camera, 1, &counts).xyz();
  EXPECT_EQ(counts.negative, 1);
  EXPECT_EQ(counts.unseen, 1);
  EXPECT_TRUE(std::isnan(xyz[2]) && std::isnan(xyz[8]));
  EXPECT_EQ(xyz[5], 1);
}

TEST(CloudFromDepth, BackProjectsPixels) {
  const Image depth{{2, 2}, std::vector<std::uint16_t>{0, 1000, 2000, 500}};
  const Raster colour{2, 2, 3, 8, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}};
  const Cloud cloud = cloud_from_depth(depth, colour, {{.fx = 2, .fy = 4, .cx = 1, .cy = 0}}, 1000);
  EXPECT_EQ(cloud.width, 2);
  EXPECT_EQ(cloud.height, 2);
  const std::vector<float> xyz = cloud.xyz();
  EXPECT_TRUE(std::isnan(xyz[0]) && std::isnan(xyz[1]) && std::isnan(xyz[2]));
  EXPECT_EQ(std::vector<float>(xyz.begin() + 3, xyz.end()),
            (std::vector<float>{0, 0, 1, -1, 0.5, 2, 0, 0.125, 0.5}));
  EXPECT_EQ(*cloud.rgb(), (std::vector<std::uint32_t>{0x010203, 0x040506, 0x070809, 0x0A0B0C}));
  EXPECT_EQ(cloud_from_depth(depth, std::nullopt, {{1, 1, 0, 0}}).fields.size(), 3U);
  EXPECT_TRUE(fails_with(ErrorKind::usage, [&] { cloud_from_depth(depth, {}, {{0, 1, 0, 0}}); }));
  EXPECT_TRUE(fails_with(ErrorKind::usage, [&] {
    cloud_from_depth(depth, {}, {{1, 1, 0, 0}}, 0);
  }));
  const Image volume{{1, 2, 2}, depth.values};
  EXPECT_TRUE(fails_with(ErrorKind::usage, [&] { cloud_from_depth(volume, {}, {{1, 1, 0, 0}}); }));
  const Camera other{{1, 1, 0, 0}, 4, 4};
  EXPECT_TRUE(fails_with(ErrorKind::usage, [&] { cloud_from_depth(depth, {}, other); }));
  bad_data([&] { cloud_from_depth(depth, Raster{1, 1, 1, 8, {0}}, {{1, 1, 0, 0}}); });
}

}  // namespace
}  // namespace ph::test
