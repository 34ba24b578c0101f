// SPDX-License-Identifier: MIT
// Tests files that exist only on POSIX systems: FIFOs, and files without read permission.
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <thread>

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
