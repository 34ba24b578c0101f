// SPDX-License-Identifier: MIT
// Tests files that exist only on POSIX systems: FIFOs, and files without read permission.
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <thread>

#include "ph/detail/core/file_pages.hpp"
#include "ph/io/cloud.hpp"
#include "ph/io/write.hpp"
#include "tests/libph/io/read_support.hpp"
#include "tests/support/patience.hpp"

namespace ph::test {
namespace {

TEST(PosixInput, SaysThatAFileMayNotBeRead) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may read everything";
  const TempDir dir;
  const auto secret = dir.write("secret", "1 2\n");
  ASSERT_EQ(::chmod(secret.c_str(), 0), 0);
  EXPECT_TRUE(fails_with(ErrorKind::no_input, [&] { Input::open(secret); }));
}

TEST(PosixInput, ReadsFifos) {
  const TempDir dir;
  const auto path = dir.file("fifo");
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  std::thread writer([&] {
    std::ofstream out(path);
    for (int i = 0; i < 50000; ++i) out << i << " 2\n";
  });
  const Points points = read_points(path);
  writer.join();
  EXPECT_EQ(points.rows(), 50000);
  EXPECT_EQ(points(49999, 0), 49999);
}

/// Reads a FIFO without an end. @param bytes are repeated. @return the message.
std::string refusal_of_endless(const std::string& bytes, const std::string& name,
                               const std::function<void(const std::filesystem::path&)>& read) {
  const TempDir dir;
  const auto path = dir.file(name);
  EXPECT_EQ(::mkfifo(path.c_str(), 0600), 0);
  ::signal(SIGPIPE, SIG_IGN);
  std::size_t written = 0;
  std::thread writer([&] {
    std::ofstream out(path, std::ios::binary);
    constexpr std::size_t most = std::size_t{64} << 20;
    for (; out && written < most; written += bytes.size()) out << bytes << std::flush;
  });
  std::string message;
  try {
    read(path);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::bad_data);
    message = error.what();
  }
  writer.join();
  EXPECT_LT(written, std::size_t{1} << 20) << name;
  return message;
}

TEST(PosixInput, RefusesEndlessStreamsByTheirFirstBytes) {
  std::string noise(8192, '\0');
  for (std::size_t i = 0; i < noise.size(); ++i) noise[i] = static_cast<char>(i * i * 31 % 251);
  const std::string words = "neither a number nor a magic number\n" + std::string(4096, ' ');
  for (const FormatInfo& info : formats()) {
    const std::string name(info.name);
    const bool may_be_anything =
        info.format == Format::binary || info.format == Format::raw || info.format == Format::phat;
    if (may_be_anything) continue;
    const std::string found = refusal_of_endless(
        noise, "fifo", [&](const std::filesystem::path& path) { read_any(path, info.format); });
    EXPECT_TRUE(contains(found, "not ")) << name << ": " << found;
    EXPECT_FALSE(contains(found, "truncated")) << name << ": " << found;
  }
  for (const char* extension : {"npy", "png", "pcd", "ply", "off", "npz", "pgm"}) {
    const auto read = [](const std::filesystem::path& path) { read_any(path); };
    const std::string name = std::string("fifo.") + extension;
    EXPECT_TRUE(contains(refusal_of_endless(words, name, read), "not a")) << name;
  }
  const auto barcode = [](const std::filesystem::path& path) { read_barcode(path); };
  EXPECT_TRUE(contains(refusal_of_endless(noise, "fifo.npy", barcode), "not an NPY file"));
  EXPECT_TRUE(contains(refusal_of_endless(noise, "fifo", barcode), "not plain text"));
  const auto cloud = [](const std::filesystem::path& path) { read_cloud(path); };
  EXPECT_TRUE(contains(refusal_of_endless(words, "fifo.pcd", cloud), "PCD"));
  EXPECT_TRUE(contains(refusal_of_endless(noise, "fifo", cloud), "not plain text"));
  const auto depth = [](const std::filesystem::path& path) {
    Input::open(path, nullptr, Input::Excess::refused, depth_start_check());
  };
  EXPECT_TRUE(contains(refusal_of_endless(words, "fifo", depth), "not a depth image"));
}

/// Writes a text into a FIFO and reads it.
template <class Read>
auto read_from_fifo(const std::string& text, Read&& read) {
  const TempDir dir;
  const auto path = dir.file("fifo");
  EXPECT_EQ(::mkfifo(path.c_str(), 0600), 0);
  std::thread writer([&] { std::ofstream(path, std::ios::binary) << text; });
  auto result = read(path);
  writer.join();
  return result;
}

TEST(PosixInput, ReadsStreamsWhoseMagicWordComesLate) {
  const std::string comments =
      std::string("# a comment\n  \n") + "#" + std::string(9000, '-') + "\n";
  std::string vertices;
  for (int i = 0; i < 2000; ++i) vertices += "0.5 1.5 2.5\n";
  for (const std::string& before : {std::string(), std::string("# a comment\n\n  "), comments}) {
    const std::string off = before + "OFF # a mesh\n2000 0 0\n" + vertices;
    const Mesh mesh = read_from_fifo(off, [](const auto& path) { return read_off(path); });
    EXPECT_EQ(mesh.vertices.rows(), 2000);
  }
  const std::string ply =
      "ply \nformat ascii 1.0\nelement vertex 2000\nproperty float x\n"
      "property float y\nproperty float z\nend_header\n" +
      vertices;
  const auto read = [](const std::filesystem::path& path) { return read_any(path, Format::ply); };
  EXPECT_EQ(std::get<Points>(read_from_fifo(ply, read).data).rows(), 2000);
}

TEST(PosixInput, MappedTextLeavesMemoryAsItIsRead) {
  constexpr std::size_t mib = std::size_t{1} << 20, lines = 24'000;
  const TempDir dir;
  const auto path = dir.file("padded.txt");
  {
    std::ofstream out(path);
    const std::string padding(1000, ' ');
    for (std::size_t i = 0; i < lines; ++i) out << i << " 2" << padding << '\n';
  }
  const ResidentFiles resident;
  if (resident.bytes() == 0) GTEST_SKIP() << "the system does not tell the memory";
  const Input input = Input::open(path);
  ASSERT_GT(input.size(), 20 * mib) << "large enough to be mapped";
  const std::size_t before = resident.bytes();
  std::size_t most = before;
  for (int pass = 0; pass < 2; ++pass) {
    std::size_t found = 0;
    for (TextLines text(input); text.next(); ++found)
      if (found % 100 == 0) most = std::max(most, resident.bytes());
    EXPECT_EQ(found, lines);
  }
  EXPECT_LT(most, before + 4 * mib);
}

TEST(PosixInput, StopsWaitingOnRequest) {
  const TempDir dir;
  const auto path = dir.file("fifo");
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  std::stop_source source;
  RunContext context;
  context.stop = source.get_token();
  std::thread stopper([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    source.request_stop();
  });
  const auto start = std::chrono::steady_clock::now();
  EXPECT_TRUE(fails_with(ErrorKind::cancelled, [&] { Input::open(path, &context); }));
  stopper.join();
  EXPECT_LT(std::chrono::steady_clock::now() - start, patience(2));
}

}  // namespace
}  // namespace ph::test
