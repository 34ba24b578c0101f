// SPDX-License-Identifier: MIT

#include <chrono>
#include <cmath>

#include "ph/io/cloud.hpp"
#include "ph/io/read.hpp"
#include "tests/libph/io/packed.hpp"
#include "tests/libph/io/read_support.hpp"
#include "tests/support/patience.hpp"

namespace ph::test {
namespace {

TEST(Gzip, IsUnpackedByContentWhateverTheFormat) {
  const TempDir dir;
  EXPECT_EQ(Input::open(dir.write("a.CSV.gz", gzipped("1,2\n"))).text(), "1,2\n");
  EXPECT_EQ(Input::open(dir.file("a.CSV.gz")).extension(), ".csv");
  EXPECT_EQ(read_points(dir.file("a.CSV.gz"))(0, 1), 2);
  EXPECT_EQ(read_any(dir.write("b.sparse.gz", gzipped("0 1 2\n"))).format, Format::sparse);
  EXPECT_EQ(read_any(dir.write("c.sparse", gzipped("0 1 2\n"))).format, Format::sparse);
  EXPECT_EQ(read_cloud(dir.write("d.xyz.gz", gzipped("0 1 2\n"))).size(), 1);
  EXPECT_TRUE(contains(bad_data([&] { read_points(dir.write("e.gz", gzipped("1\nx\n2 3\n"))); }),
                       "e.gz:2:1"));
  std::string large;
  for (int i = 0; i < 400000; ++i) large += std::to_string(i % 1009 * 97) + "\n";
  EXPECT_EQ(Input::open(dir.write("f.gz", gzipped(large))).text(), large);
  EXPECT_EQ(read_points(dir.write("g.gz", gzipped("1 2\n") + gzipped("3 4\n"))).rows(), 2);
  EXPECT_EQ(Input::open(dir.write("h.gz", gzipped(""))).size(), 0U);
}

TEST(Gzip, DamageIsRefused) {
  const TempDir dir;
  const std::string text = "1 2\n3 4\n5 6\n";
  const std::string whole = gzipped(text);
  for (std::size_t length = 2; length < whole.size(); ++length) {
    const auto path = dir.write("cut.gz", whole.substr(0, length));
    EXPECT_TRUE(contains(bad_data([&] { Input::open(path); }), "gzip")) << length;
  }
  EXPECT_TRUE(contains(bad_data([&] { Input::open(dir.write("more.gz", whole + "more")); }),
                       "trailing data"));
  bad_data([&] { Input::open(dir.write("half.gz", whole + whole.substr(0, 5))); });
  for (std::size_t i = 2; i < whole.size(); ++i) {
    std::string bytes = whole;
    bytes[i] = static_cast<char>(bytes[i] ^ 0x10);
    // A changed flag or time in the header may remain undetected.
    fails_with(ErrorKind::bad_data,
               [&] { EXPECT_EQ(Input::open(dir.write("flipped.gz", bytes)).text(), text) << i; });
  }
}

TEST(Gzip, BombsEndSoon) {
  const TempDir dir;
  std::string bomb = gzipped(std::string(std::size_t{16} << 20, '0'));
  for (int i = 0; i < 6; ++i) bomb += bomb;  // 1 GB in 1 MB
  const auto path = dir.write("bomb.gz", bomb);
  const auto start = std::chrono::steady_clock::now();
  EXPECT_TRUE(contains(bad_data([&] { Input::open(path); }), "expand too much"));
  RunContext context;
  context.memory.set_limit(std::size_t{16} << 20);
  EXPECT_TRUE(fails_with(ErrorKind::resource, [&] { Input::open(path, &context); }));
  EXPECT_LE(context.memory.peak(), std::size_t{16} << 20);
  EXPECT_EQ(context.memory.used(), 0U);
  EXPECT_LT(std::chrono::steady_clock::now() - start, patience(5));
}

TEST(Input, AStreamOfNulsIsRefusedAtOnce) {
  if (!std::filesystem::is_character_file("/dev/zero")) GTEST_SKIP() << "no device /dev/zero";
  RunContext context;
  const auto start = std::chrono::steady_clock::now();
  EXPECT_TRUE(contains(bad_data([&] { Input::open("/dev/zero", &context); }), "NUL bytes"));
  EXPECT_LT(context.memory.peak(), std::size_t{4} << 20);
  EXPECT_LT(std::chrono::steady_clock::now() - start, patience(1));
  const TempDir dir;  // the first bytes show that a file of NULs is not text
  const auto path = dir.write("nul.txt", "");
  std::error_code error;
  std::filesystem::resize_file(path, std::uintmax_t{8} << 30, error);
  if (error) GTEST_SKIP() << "no file of 8 GiB here: " << error.message();
  EXPECT_TRUE(contains(bad_data([&] { read_any(path); }), "NUL byte"));
  EXPECT_LT(std::chrono::steady_clock::now() - start, patience(1));
}

}  // namespace
}  // namespace ph::test
