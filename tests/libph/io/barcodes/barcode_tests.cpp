// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <clocale>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "ph/detail/io/json_writer.hpp"
#include "ph/io/write.hpp"
#include "tests/libph/io/read_support.hpp"

namespace ph {
namespace {

namespace fs = std::filesystem;

/// Creates a separate folder for each test.
class BarcodeIo : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.file(name).string(); }
  std::string read(const std::string& name) const {
    std::ifstream file(path(name), std::ios::binary);
    return (std::ostringstream() << file.rdbuf()).str();
  }
  std::size_t file_count() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_.file("")), fs::directory_iterator()));
  }
  std::string text_of(const Barcode& barcode, BarcodeFormat format, const BarcodeInfo& info = {}) {
    OutputFile file(path("barcode"));
    write_barcode(file, barcode, format, {.info = &info});
    file.commit();
    return read("barcode");
  }

 private:
  test::TempDir folder_;
};

Barcode example() {
  Barcode barcode;
  const std::array<Index, 2> edge{0, 2};
  const std::array<Index, 3> triangle{0, 1, 2};
  barcode.add({0, 0, 0.1}, std::array<Index, 1>{2}, edge);
  barcode.add({0, -0.0, kInfinity}, std::array<Index, 1>{0}, {});
  barcode.add({2, 1.0 / 3, 1e22}, edge, triangle);
  barcode.sort();
  return barcode;
}

TEST_F(BarcodeIo, Csv) {
  EXPECT_EQ(text_of(example(), BarcodeFormat::csv),
            "dim,birth,death\n0,0,0.1\n0,0,inf\n2,0.3333333333333333,1e+22\n");
  EXPECT_EQ(text_of(Barcode(), BarcodeFormat::csv), "dim,birth,death\n");
}

TEST_F(BarcodeIo, Ripser) {
  BarcodeInfo info;
  info.max_dim = 3;
  EXPECT_EQ(text_of(example(), BarcodeFormat::ripser, info),
            "persistence intervals in dim 0:\n [0,0.1)\n [0, )\n"
            "persistence intervals in dim 1:\n"
            "persistence intervals in dim 2:\n [0.333333,1e+22)\n"
            "persistence intervals in dim 3:\n");
}

TEST_F(BarcodeIo, Json) {
  BarcodeInfo info;
  info.program = "test 1";
  info.input = "a \"b\"\n\xff";
  info.complex = "rips";
  info.engine = "twist";
  info.timings = {{"read", 0.5}};
  EXPECT_EQ(text_of(example(), BarcodeFormat::json, info),
            R"({
  "format": "ph-barcode",
  "version": 1,
  "program": "test 1",
  "input": {"path": "a \"b\"\n)"
            "\xef\xbf\xbd"
            R"(", "description": ""},
  "complex": "rips",
  "field": 2,
  "max_dim": 0,
  "threshold": null,
  "engine": "twist",
  "bars": [
    {"dim": 0, "birth": 0, "death": 0.1, "birth_cell": {"vertices": [2]}, "death_cell": {"vertices": [0, 2]}},
    {"dim": 0, "birth": 0, "death": null, "birth_cell": {"vertices": [0]}, "death_cell": null},
    {"dim": 2, "birth": 0.3333333333333333, "death": 1e+22, "birth_cell": {"vertices": [0, 2]}, "death_cell": {"vertices": [0, 1, 2]}}
  ],
  "timings": {"read": 0.5},
  "peak_memory": null
}
)");
}

TEST_F(BarcodeIo, NumbersReadBack) {
  for (const double value : {0.1, 1.0 / 3, 5e-324, 1.7976931348623157e308, -2.5, 1e-7, 123456789.0})
    EXPECT_EQ(std::strtod(shortest(value).c_str(), nullptr), value);
  EXPECT_EQ(shortest(-0.0), "0");
  EXPECT_EQ(shortest(kInfinity), "inf");
  EXPECT_EQ(shortest(-kInfinity), "-inf");
}

TEST_F(BarcodeIo, FormatsByName) {
  EXPECT_EQ(barcode_format_of_path("a.b/c.CSV"), BarcodeFormat::csv);
  EXPECT_EQ(barcode_format_of_path("a.json"), BarcodeFormat::json);
  EXPECT_EQ(barcode_format_of_path("a.csv/b"), std::nullopt);
  EXPECT_EQ(barcode_format_of_path("a.none"), std::nullopt);
  for (const char* name : {"csv", "json", "ripser", "pers", "dipha", "npy", "none"})
    EXPECT_EQ(barcode_format_name(*barcode_format_named(name)), name);
  EXPECT_EQ(barcode_format_named("CSV"), std::nullopt);
}

TEST_F(BarcodeIo, JsonStringsAreUtf8) {
  EXPECT_EQ(json::string("\x01\x7f"), "\"\\u0001\\u007f\"");
  EXPECT_EQ(json::string("ü ∞ 😀"), "\"ü ∞ 😀\"");
  EXPECT_EQ(json::string("\xc0\xaf"), "\"\xef\xbf\xbd\xef\xbf\xbd\"");  // an overlong encoding
  EXPECT_EQ(json::string("\xe2\x88"), "\"\xef\xbf\xbd\xef\xbf\xbd\"");  // a truncated encoding
}

TEST_F(BarcodeIo, FileAppearsOnCommit) {
  OutputFile file(path("out"));
  file.write("all");
  EXPECT_FALSE(fs::exists(path("out")));
  OutputFile moved(std::move(file));
  moved.commit();
  EXPECT_EQ(read("out"), "all");
  EXPECT_EQ(file_count(), 1u);
}

TEST_F(BarcodeIo, OldFileStaysUntilCommit) {
  write_file(path("out"), "old");
  OutputFile file(path("out"));
  file.write("new");
  EXPECT_EQ(read("out"), "old");
  file.commit();
  EXPECT_EQ(read("out"), "new");
}

TEST_F(BarcodeIo, StreamsPassErrorsOn) {
  OutputFile file(path("out"));
  {
    OutputStream stream(file);
    stream << "x = " << 1.5 << '\n';
  }
  file.commit();
  EXPECT_EQ(read("out"), "x = 1.5\n");

  if (!std::filesystem::is_character_file("/dev/full")) GTEST_SKIP() << "no device /dev/full";
  OutputFile full("/dev/full");
  OutputStream stream(full);
  const std::string much(1 << 20, 'x');
  EXPECT_TRUE(test::fails_with(ErrorKind::io, [&] { stream << much; }))
      << "a full device took a megabyte";
}

TEST_F(BarcodeIo, FaultsOfOutputs) {
  const auto kind_of = [](const std::string& name) {
    try {
      write_file(name, "text");
    } catch (const Error& error) {
      return error.kind();
    }
    return ErrorKind::internal;
  };
  EXPECT_EQ(kind_of(path("missing/out")), ErrorKind::cannot_create);
  EXPECT_EQ(kind_of(path("")), ErrorKind::cannot_create);
  EXPECT_EQ(kind_of(""), ErrorKind::cannot_create);
  EXPECT_EQ(kind_of(path(std::string(300, 'x'))), ErrorKind::cannot_create);
  if (!std::filesystem::is_character_file("/dev/full")) GTEST_SKIP() << "no device /dev/full";
  EXPECT_EQ(kind_of("/dev/full"), ErrorKind::io);
}

}  // namespace
}  // namespace ph
