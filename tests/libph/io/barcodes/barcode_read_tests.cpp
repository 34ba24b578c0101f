// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>

#include "ph/io/write.hpp"
#include "tests/libph/io/barcodes/barcode_support.hpp"

namespace ph::test {
namespace {

constexpr std::array kFormats{BarcodeFormat::csv,  BarcodeFormat::json,  BarcodeFormat::ripser,
                              BarcodeFormat::pers, BarcodeFormat::dipha, BarcodeFormat::npy};

TEST(ReadBarcode, EveryFormatByContent) {
  for (const BarcodeFormat format : kFormats) {
    const Barcode barcode = example();
    const Barcode read = back(text_of(barcode, format));
    ASSERT_EQ(read.size(), barcode.size()) << barcode_format_name(format);
    for (std::size_t i = 0; i < read.size(); ++i) {
      EXPECT_EQ(read[i].dim, barcode[i].dim);
      const auto same = [&](double a, double b) {
        // Ripser's format has six digits.
        return a == b || (format == BarcodeFormat::ripser && std::abs(a - b) <= 1e-6 * std::abs(b));
      };
      EXPECT_TRUE(same(read[i].birth, barcode[i].birth)) << barcode_format_name(format) << i;
      EXPECT_TRUE(same(read[i].death, barcode[i].death)) << barcode_format_name(format) << i;
    }
  }
}

TEST(ReadBarcode, BytesThatBeginLikeJsonAreNone) {
  const auto is = [](const std::string& bytes, const char* name) {
    return is_barcode(Input::view(bytes, name));
  };
  std::string cells = test::le(std::int64_t{'{'});
  for (int i = 0; i < '{'; ++i) cells += test::le(std::int64_t{0}) + test::le(std::int64_t{0});
  EXPECT_FALSE(is(cells, "m.phat"));
  EXPECT_FALSE(is(cells, "m"));
  EXPECT_FALSE(is(std::string("{\0\x80\x3f", 4), "d.bin"));
  EXPECT_FALSE(is("{", "d.sparse"));
  EXPECT_TRUE(is("{\"bars\": []}", "b"));
  EXPECT_TRUE(is("\n {\"bars\": []}", "b.txt"));
}

TEST(ReadBarcode, EmptyOnesToo) {
  for (const BarcodeFormat format : kFormats) {
    const std::string name = "b." + std::string(barcode_format_name(format));
    EXPECT_TRUE(back(text_of(Barcode(), format), name).empty()) << name;
  }
  bad_data([] { back("", "b.csv"); });
  bad_data([] { back("\n# nothing\n"); });
}

// The option --significance adds a column of p-values to the bars.
TEST(ReadBarcode, ValuesOfPMayFollow) {
  const auto stored = [](const std::string& text) {
    return read_stored_barcode(Input::view(text, "b.csv"));
  };
  // The p-values move with their bars, which are not in order here.
  const StoredBarcode read = stored("dim,birth,death,p\n1,1,2,0.25\n0,0,inf,\n1,1,3,\n");
  ASSERT_EQ(read.bars.size(), 3U);
  EXPECT_EQ(read.bars[1], (Bar{1, 1, 2}));
  ASSERT_EQ(read.p_values.size(), 3U);
  EXPECT_TRUE(std::isnan(read.p_values[0]) && std::isnan(read.p_values[2]));
  EXPECT_EQ(read.p_values[1], 0.25);
  EXPECT_TRUE(read.left_out.empty());
  for (const char* p : {"1.5", "-0.1", "x"})
    EXPECT_TRUE(
        contains(bad_data([&] { stored("dim,birth,death,p\n0,0,1," + std::string(p) + "\n"); }),
                 "b.csv:2:7"));
}

// The columns have the names and the order that pandas, R and other programs use.
TEST(ReadBarcode, ColumnsByName) {
  for (const char* text :
       {"birth,death,dim\n0,1,0\n0.5,inf,1\n", ",dim,birth,death\n0,0,0,1\n1,1,0.5,inf\n",
        "Death;Birth;Dimension;Persistence\n1;0;0;1\nInf;0.5;1;Inf\n",
        "\"dimension\" \"Birth\" \"Death\"\n\"1\" 0 0 1\n\"a b\" 1 0.5 Inf\n",
        "\"\",\"dimension\",\"birth\",\"death\"\n\"1\",0,0,1\n\"2\",1,0.5,Inf\n",
        "p\tbirth\tdim\tdeath\n0.5\t0\t0\t1\n1e-3\t0.5\t1\tinf\n",
        "dim,p,birth,death\n0,,0,1\n1,NA,0.5,inf\n"}) {
    const Barcode read = back(text, "b.csv");
    ASSERT_EQ(read.size(), 2U) << text;
    EXPECT_EQ(read[0], (Bar{0, 0, 1})) << text;
    EXPECT_EQ(read[1], (Bar{1, 0.5, kInfinity})) << text;
    EXPECT_TRUE(is_barcode(Input::view(text, "b.csv")));
  }
  EXPECT_EQ(read_stored_barcode(Input::view("dim,birth,death,lifetime,p\n", "b.csv")).left_out,
            std::vector<std::string>{"lifetime"});
  const auto refused = [](const std::string& text, const std::string& place) {
    EXPECT_TRUE(contains(bad_data([&] { back(text, "b.csv"); }), "b.csv:" + place)) << text;
  };
  refused("birth,death\n0,1\n", "1:1: header");
  refused("dim,birth,death,multiplicity\n0,0,1,2\n", "1:1: header");
  refused("dim,birth,death,birth\n0,0,1,2\n", "1:1: header");
  refused("dim,birth,,death\n0,0,0,1\n", "1:1: header");
  refused("birth,death,dim\n0,1\n", "2:4: dimension missing");
  refused("dim,death,birth\n0,1\n", "2:4: birth missing");
  refused("dim,birth,death\n0,0,1\n\"2\",1,0.5,2\n", "3:1: dimension is not an integer");
  refused("p,dim,birth,death\n2,0,0,1\n", "2:1: p-value, found 2");
  refused("dim,birth,death\n2,0,0,1\n", "2:7: extra cell");
}

TEST(ReadBarcode, RowsWithAndWithoutTheCharacteristic) {
  for (const char* text :
       {"0 0 1\n1 0.5 inf\n", "2 0 0 1\n2 1 0.5 inf\n", "0,0,1\n1,0.5,inf\n",
        "dim,birth,death\n0,0,1\n1,0.5,inf\n", "# GUDHI\n2 1 0.5 inf\n2 0 0 1",
        "\"dimension\",\"Birth\",\"Death\"\n0,0,1\n1,0.5,Inf\n",
        "0.000e+00 0.000e+00 1.000e+00\n1.000e+00 5.000e-01 inf\n", "1.0 .5 inf\n0.0 0 1\n"}) {
    const Barcode read = back(text, "b.pers");
    ASSERT_EQ(read.size(), 2U) << text;
    EXPECT_EQ(read[0], (Bar{0, 0, 1}));
    EXPECT_EQ(read[1], (Bar{1, 0.5, kInfinity}));
  }
  for (const char* text : {"0 1\n",
                           "0 0 1 2 3\n",
                           "0 0\n",
                           "-1 0 1\n",
                           "0.5 0 1\n",
                           "0 2 1\n",
                           "0 nan 1\n",
                           "0 0 nan\n",
                           "0 inf inf\n",
                           "0 0 1\n2 0 0 1\n",
                           "1 0 0 1\n",
                           "birth,death\n0,1\n",
                           "death,birth,dim\n1,2,0\n",
                           "0 0 1,5\n",
                           "0 0 1x\n",
                           "99999999999 0 1\n",
                           "0 0 1.#INF\n",
                           "1e10 0 1\n",
                           "-1.0 0 1\n",
                           "1.5e0 0 1\n"}) {
    EXPECT_TRUE(contains(bad_data([&] { back(text, "b.pers"); }), "b.pers")) << text;
  }
}

TEST(ReadBarcode, TextOfRipser) {
  const std::string text =
      "point cloud with 4 points in dimension 2\nvalue range: [1,1.41421]\n"
      "persistence intervals in dim 0:\n [0,1)\n [0, )\npersistence intervals in dim 1:\n"
      " [1,1.41421)\n";
  const Barcode read = back(text);
  ASSERT_EQ(read.size(), 3U);
  EXPECT_EQ(read[1], (Bar{0, 0, kInfinity}));
  EXPECT_EQ(read[2], (Bar{1, 1, 1.41421}));
  for (const char* tail : {"[1,2\n", "1,2)\n", "[1 2)\n", "[,2)\n", "[2,1)\n", "[a,b)\n",
                           "[1,2) x\n", "persistence intervals in dim x:\n", "[1,2,3)\n"}) {
    bad_data([&] { back(text + tail); });
  }
  bad_data([] { read_barcode(Input::view("value range: [1,2]\n", "b"), BarcodeFormat::ripser); });
}

TEST(ReadBarcode, EqualBarsKeepTheirOrder) {
  Barcode barcode;
  for (Index i = 40; i > 0; --i) {
    barcode.add({0, 1, 2}, std::array<Index, 1>{7}, std::array<Index, 2>{7, 100 + i});
  }
  barcode.sort();
  for (std::size_t i = 0; i < barcode.size(); ++i) {
    EXPECT_EQ(barcode.death_cell(i)->numbers[1], 140 - static_cast<Index>(i));
  }
}

TEST(ReadBarcode, HeadersAreShownPrintable) {
  EXPECT_TRUE(contains(bad_data([] { back("a,\xE2,c\n0,1,2\n", "b.csv"); }), "\"a,\\xE2,c\""));
}

TEST(ReadBarcode, RowsOfAnArrayThatAreNoBars) {
  // The header of an array with one row, followed by the three numbers of the row.
  const std::string header = text_of(example(), BarcodeFormat::npy).substr(0, 10) +
                             "{'descr': '<f8', 'fortran_order': False, 'shape': (1, 3), }";
  const auto row = [&](double dim, double birth, double death) {
    return header + std::string(127 - header.size(), ' ') + "\n" + le(dim) + le(birth) + le(death);
  };
  EXPECT_EQ(back(row(1, 2, 3))[0], (Bar{1, 2, 3}));
  for (const std::string& bytes : {row(0.5, 1, 2), row(-1, 1, 2), row(1e9, 1, 2), row(1, 2, 1),
                                   row(std::nan(""), 1, 2), row(1, std::nan(""), 2)}) {
    EXPECT_TRUE(contains(bad_data([&] { back(bytes); }), "row 0"));
  }
  std::string square = row(1, 2, 3);
  square.replace(square.find("(1, 3)"), 6, "(3, 1)");
  EXPECT_TRUE(contains(bad_data([&] { back(square, "b.npy"); }), "shape (3, 1)"));
}

// CubicalRipser writes two positions after each bar, and writes infinity as the largest double.
TEST(ReadBarcode, RowsWithVoxels) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  for (const std::size_t width : {9, 11}) {
    std::string bytes = text_of(example(), BarcodeFormat::npy).substr(0, 10) +
                        "{'descr': '<f8', 'fortran_order': False, 'shape': (2, " +
                        std::to_string(width) + "), }";
    bytes.append(127 - bytes.size(), ' ') += '\n';
    for (const Bar& bar : {Bar{1, 1, kLargest}, Bar{0, -kLargest, 7}}) {
      bytes += le(double(bar.dim)) + le(bar.birth) + le(bar.death);
      for (std::size_t k = 3; k < width; ++k) bytes += le(double(k));
    }
    const StoredBarcode read = read_stored_barcode(Input::view(bytes, "b.npy"));
    ASSERT_EQ(read.bars.size(), 2U);
    EXPECT_EQ(read.bars[0], (Bar{0, -kInfinity, 7}));
    EXPECT_EQ(read.bars[1], (Bar{1, 1, kInfinity}));
    EXPECT_EQ(read.left_out.size(), 1U);
  }
}

TEST(ReadBarcode, BinaryDamage) {
  for (const BarcodeFormat format : {BarcodeFormat::dipha, BarcodeFormat::npy}) {
    const std::string whole = text_of(example(), format);
    check_prefixes(
        whole, "b", [&](const Input& in) { read_barcode(in, format); }, never());
    bad_data([&] { back(whole + "x"); });
  }
  const auto diagram = [](std::int64_t type, std::int64_t count, std::int64_t dim, double birth,
                          double death) {
    return le(std::int64_t{8067171840}) + le(type) + le(count) + le(dim) + le(birth) + le(death);
  };
  EXPECT_EQ(back(diagram(2, 1, -2, 1, 5))[0], (Bar{1, 1, kInfinity}));
  EXPECT_EQ(back(diagram(2, 1, 1, 1, 5))[0], (Bar{1, 1, 5}));
  for (const std::string& bytes :
       {diagram(1, 1, 1, 1, 5), diagram(2, 2, 1, 1, 5), diagram(2, -1, 1, 1, 5),
        diagram(2, std::int64_t{1} << 60, 1, 1, 5), diagram(2, 1, std::int64_t{1} << 40, 1, 5),
        diagram(2, 1, std::numeric_limits<std::int64_t>::min(), 1, 5), diagram(2, 1, 1, 5, 1),
        diagram(2, 1, 1, std::nan(""), 1), diagram(2, 1, 1, 1, std::nan(""))}) {
    bad_data([&] { back(bytes); });
  }
}

}  // namespace
}  // namespace ph::test
