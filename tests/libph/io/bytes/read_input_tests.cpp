// SPDX-License-Identifier: MIT
#include <chrono>
#include <clocale>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "ph/detail/core/machine_memory.hpp"
#include "ph/io/cloud.hpp"
#include "ph/io/read.hpp"
#include "tests/libph/io/read_support.hpp"
#include "tests/support/patience.hpp"
#include "tests/support/run_contexts.hpp"

namespace ph::test {
namespace {

TEST(Printable, EscapesWhatATerminalOrALogWouldObey) {
  EXPECT_EQ(printable("plain \xC3\xA9"), "plain \xC3\xA9");
  EXPECT_EQ(printable("a\nb\tc\rd"), "a\\nb\\tc\\rd");
  EXPECT_EQ(printable("\x1B[31m\x7F\xFF\xC3"), "\\x1B[31m\\x7F\\xFF\\xC3");
  // A control character (CSI), and a right-to-left override.
  EXPECT_EQ(printable("\xC2\x9B\xE2\x80\xAE"), "\\xC2\\x9B\\xE2\\x80\\xAE");
  EXPECT_EQ(printable("\xED\xA0\x80"), "\\xED\\xA0\\x80");  // a surrogate
  EXPECT_EQ(printable(std::string(100, 'x'), 5), "xxxxx...");
}

TEST(Input, SaysWhyAFileCannotBeRead) {
  const TempDir dir;
  for (const auto& path : {dir.file("missing"), dir.file(""), dir.file(std::string(5000, 'n')),
                           std::filesystem::path("")}) {
    EXPECT_TRUE(fails_with(ErrorKind::no_input, [&] { Input::open(path); })) << path;
  }
  expect_error(ErrorKind::no_input, "new\\nline\\x1B%s<script>",
               [&] { Input::open(dir.file("new\nline\x1B%s<script>")); });
}

TEST(Input, ReadsSmallMappedAndEmptyFiles) {
  const TempDir dir;
  EXPECT_EQ(Input::open(dir.write("a.TXT", "1 2\n")).text(), "1 2\n");
  EXPECT_EQ(Input::open(dir.file("a.TXT")).extension(), ".txt");
  EXPECT_EQ(Input::open(dir.write("empty", "")).size(), 0U);
  const std::string large(std::size_t{17} << 20, '#');
  EXPECT_EQ(Input::open(dir.write("large", large)).text(), large);
  Input moved = Input::open(dir.file("a.TXT"));
  const Input target = std::move(moved);
  EXPECT_EQ(target.text(), "1 2\n");
}

TEST(Input, AnEndlessStreamStopsAtTheBudget) {
  if (!std::filesystem::is_character_file("/dev/urandom")) GTEST_SKIP() << "no device /dev/urandom";
  LimitedContext context(std::size_t{8} << 20);
  EXPECT_TRUE(fails_with(ErrorKind::resource, [&] { Input::open("/dev/urandom", &context); }));
  EXPECT_LE(context.memory.peak(), std::size_t{8} << 20);
  EXPECT_EQ(context.memory.used(), 0U);
}

TEST(Input, ReadersKeepToTheBudget) {
  std::string text;
  for (int i = 0; i < 20000; ++i) text += "1 2 3\n";
  const TempDir dir;
  const auto path = dir.write("p.txt", text);
  LimitedContext context(text.size() + 1000);
  EXPECT_TRUE(fails_with(ErrorKind::resource, [&] { read_points(path, {.context = &context}); }));
  context.memory.set_limit(text.size() * 8);
  EXPECT_EQ(read_points(path, {.context = &context}).rows(), 20000);
  EXPECT_EQ(context.memory.used(), 0U);
}

TEST(Input, BytesInMemoryHaveABudgetToo) {
  std::string text;
  for (int i = 0; i < 300000; ++i) text += std::to_string(i) + " 1\n";
  LimitedContext context(100'000);
  EXPECT_TRUE(
      fails_with(ErrorKind::resource, [&] { read_points(Input::view(text, "t.txt", &context)); }));
  EXPECT_EQ(read_points(Input::view(text, "t.txt")).rows(), 300000);
  StoppedContext stopped;
  EXPECT_TRUE(
      fails_with(ErrorKind::cancelled, [&] { read_points(Input::view(text, "t.txt", &stopped)); }));
}

TEST(Input, HeaderBombsCostNothing) {
  const std::string huge = "1000000000000";
  const std::string pcd = "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " +
                          huge + "\nHEIGHT 1\nPOINTS " + huge + "\nDATA ";
  const std::string npy_header =
      "{'descr': '<f8', 'fortran_order': True, 'shape': (" + huge + ",)}";
  const std::vector<std::pair<std::string, std::string>> bombs{
      {"a.pcd", pcd + "ascii\n1 2 3\n"},
      {"b.pcd", pcd + "binary\n" + std::string(100, 'x')},
      {"c.pcd", pcd + "binary_compressed\n" + std::string(100, 'x')},
      {"d.ply", "ply\nformat binary_little_endian 1.0\nelement vertex " + huge +
                    "\nproperty float x\nproperty float y\nproperty float z\nend_header\nxxxx"},
      {"e.ply",
       "ply\nformat ascii 1.0\nelement vertex " + huge + "\nproperty float x\nend_header\n1\n"},
      {"f.npy", std::string("\x93NUMPY\x01\x00", 8) +
                    le(static_cast<std::uint16_t>(npy_header.size())) + npy_header + "xxxx"},
      {"g.phat", le(std::int64_t{1000000000000}) + le(std::int64_t{0})},
      {"j.dipha", le(std::int64_t{8067171840}) + le(std::int64_t{7}) + le(std::int64_t{1} << 31)},
      {"k.dipha", le(std::int64_t{8067171840}) + le(std::int64_t{1}) + le(std::int64_t{1} << 50) +
                      le(std::int64_t{1}) + le(std::int64_t{1} << 50)},
      {"l.pgm", "P5 2000000000 2000000000 255 x"},
      {"m.perseus", "3\n1000000 1000000 1000000\n1\n"},
      {"n.perseus", "2\n1000000 0 1\n0 1000000 1\n"},
      {"o.pts", huge + "\n1 2 3\n"},
      {"h.off", "OFF\n" + huge + " " + huge + " 0\n0 0 0\n"},
      {"i.png",
       std::string("\x89PNG\r\n\x1A\n\0\0\0\rIHDR\x7F\xFF\xFF\xFF\x7F\xFF\xFF\xFF\x08\x06\0\0\0",
                   29)}};
  const auto before = status_bytes("VmHWM:");
  for (const auto& [name, bytes] : bombs) {
    const auto start = std::chrono::steady_clock::now();
    bad_data([&, n = name, b = bytes] { read_any(Input::view(b, n)); });
    EXPECT_LT(std::chrono::steady_clock::now() - start, patience(0.05)) << name;
  }
  if (!before) GTEST_SKIP() << "the system does not tell the memory";
  EXPECT_LT(status_bytes("VmHWM:").value(), *before + (16 << 20));
}

TEST(Input, TheLocaleHasNoInfluence) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  int tried = 0;
  for (const char* name : {"de_DE.UTF-8", "tr_TR.UTF-8", "fr_FR.UTF-8", "C.UTF-8"}) {
    if (std::setlocale(LC_ALL, name) == nullptr) continue;
    ++tried;
    EXPECT_EQ(read_points(Input::view("1.5,2.25\n", "p"))(0, 1), 2.25) << name;
    EXPECT_EQ(read_distances(Input::view("0 INF\nINF 0\n", "p")).size(), 2) << name;
    Cloud cloud = read_cloud(Input::view("1.5 2 3\n", "p"));
    std::ostringstream out;
    write_pcd(out, cloud, PcdData::ascii);
    EXPECT_TRUE(contains(out.str(), "\n1.5 2 3\n")) << name;
  }
  std::setlocale(LC_ALL, before.c_str());
  if (tried == 0) GTEST_SKIP() << "no locale de_DE.UTF-8 or tr_TR.UTF-8";
}

}  // namespace
}  // namespace ph::test
