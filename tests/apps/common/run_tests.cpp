// SPDX-License-Identifier: MIT
// Tests how a program runs: exit codes, memory limits, progress.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <chrono>
#include <string>
#include <thread>

#include "apps/common/run/progress.hpp"
#include "apps/common/run/session.hpp"
#include "apps/common/system/memory_limit.hpp"
#include "apps/common/terminal/exit_code.hpp"
#include "apps/common/terminal/messages.hpp"
#include "tests/apps/common/kind_of.hpp"

namespace ph::app {
namespace {

TEST(ExitCodes, AreThoseOfSysexits) {
  EXPECT_EQ(exit_code(ErrorKind::usage), 64);
  EXPECT_EQ(exit_code(ErrorKind::bad_data), 65);
  EXPECT_EQ(exit_code(ErrorKind::no_input), 66);
  EXPECT_EQ(exit_code(ErrorKind::not_built_in), 69);
  EXPECT_EQ(exit_code(ErrorKind::internal), 70);
  EXPECT_EQ(exit_code(ErrorKind::cannot_create), 73);
  EXPECT_EQ(exit_code(ErrorKind::io), 74);
  EXPECT_EQ(exit_code(ErrorKind::resource), 75);
  EXPECT_EQ(exit_code(ErrorKind::cancelled), 130);
}

TEST(Session, PassesOptionsOn) {
  CommonOptions options;
  options.threads = 3;
  options.memory_limit = 1000;
  options.quiet = true;
  std::stop_source stop;
  const Session session("test", options, stop.get_token());
  EXPECT_EQ(session.context().threads, 3);
  EXPECT_EQ(session.context().memory.limit(), 1000u);
  EXPECT_NO_THROW(session.context().poll());
  stop.request_stop();
  EXPECT_EQ(kind_of([&] { session.context().poll(); }), ErrorKind::cancelled);
}

// ---- the progress bar, and output that must not share its line

constexpr std::string_view kWipe = "\r\x1b[K";
constexpr auto kBarIsThere = std::chrono::milliseconds(600);       // after the start of the run
constexpr auto kTooLongSilence = std::chrono::milliseconds(1000);  // between two signs of progress

/// What `act` prints on stderr.
template <class Act>
std::string stderr_of(Act&& act) {
  testing::internal::CaptureStderr();
  act();
  return testing::internal::GetCapturedStderr();
}

std::size_t count_of(std::string_view part, std::string_view text) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(Progress, ABarIsHeardEverySecondOnceSomethingWasReported) {
  std::size_t before = 0;
  const std::string text = stderr_of([&] {
    ProgressReporter progress(ProgressMode::bar, true);
    std::this_thread::sleep_for(kBarIsThere + kTooLongSilence);
    before = static_cast<std::size_t>(lseek(STDERR_FILENO, 0, SEEK_CUR));
    progress.report({"read", 1, 4});
    std::this_thread::sleep_for(kTooLongSilence);
  });
  EXPECT_EQ(before, 0U) << "nothing is drawn before the first report";
  EXPECT_EQ(count_of("read [", text), 2U) << text;
  EXPECT_TRUE(text.ends_with(kWipe)) << "it is gone in the end";
}

TEST(Progress, ABarIsHeldBack) {
  std::size_t before = 0, after = 0;
  const std::string text = stderr_of([&] {
    ProgressReporter progress(ProgressMode::bar, true);
    std::this_thread::sleep_for(kBarIsThere);
    progress.report({"old", 1, 4});
    progress.hold();
    before = static_cast<std::size_t>(lseek(STDERR_FILENO, 0, SEEK_CUR));
    progress.report({"held", 1, 4});
    std::this_thread::sleep_for(kTooLongSilence);
    progress.release();
    std::this_thread::sleep_for(kTooLongSilence);
    after = static_cast<std::size_t>(lseek(STDERR_FILENO, 0, SEEK_CUR));
    progress.report({"new", 1, 4});
  });
  EXPECT_EQ(count_of("old [", text), 1U);
  EXPECT_TRUE(std::string_view(text).substr(0, before).ends_with(kWipe));
  EXPECT_EQ(after, before) << "until the next report";
  EXPECT_EQ(count_of("held", text), 0U);
  EXPECT_EQ(count_of("new [", text), 1U);
}

TEST(Progress, LinesOfJsonAreNeverHeldBack) {
  const std::string text = stderr_of([&] {
    ProgressReporter progress(ProgressMode::json, true);
    progress.hold();
    std::this_thread::sleep_for(kTooLongSilence);
    progress.report({"reduce", 2, 3});
  });
  EXPECT_EQ(count_of("{\"stage\": \"start\"", text), 1U) << text;
  EXPECT_EQ(count_of("{\"stage\": \"reduce\", \"done\": 2, \"total\": 3", text), 1U) << text;
  EXPECT_EQ(count_of("\"rank\"", text), 0U) << text;
  EXPECT_EQ(count_of("\x1b", text), 0U);
}

TEST(Progress, LinesOfJsonSayWhoseTheyAre) {
  const std::string text = stderr_of([] {
    ProgressReporter progress(ProgressMode::json, true, 3);
    progress.report({"reduce", 2, 0});
  });
  EXPECT_EQ(count_of("\"total\": null, ", text), 1U) << text;
  EXPECT_EQ(count_of(", \"rank\": 3}\n", text), 1U) << text;
}

TEST(Progress, MessagesNeverShareALineWithABar) {
  constexpr auto long_enough = std::chrono::milliseconds(300);
  std::size_t written = 0;
  const std::string text = stderr_of([&] {
    ProgressReporter progress(ProgressMode::bar, true);
    std::this_thread::sleep_for(kBarIsThere);
    std::jthread other([&](const std::stop_token& stop) {
      while (!stop.stop_requested()) progress.report({"stage", 1, 2});
    });
    const auto end = std::chrono::steady_clock::now() + long_enough;
    for (; std::chrono::steady_clock::now() < end; written += 2) {
      print_line("message");
      print_without_memory("prefix", "message");
    }
  });
  std::size_t messages = 0, bars = 0;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (lines.eof()) break;  // the bar, which was erased at the end
    ++messages;
    const std::size_t wiped = line.rfind(kWipe);
    bars += wiped != line.npos;
    const std::string message = wiped == line.npos ? line : line.substr(wiped + kWipe.size());
    ASSERT_TRUE(message == "message" || message == "prefix: message") << message;
  }
  EXPECT_EQ(messages, written);
  EXPECT_GT(bars, 0U) << "the two never met";
}

// ---- the limit of the heap

std::uint64_t data_limit() {
  rlimit data{};
  getrlimit(RLIMIT_DATA, &data);
  return data.rlim_cur;
}

class HeapBounds : public testing::Test {
 protected:
  void SetUp() override {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "sanitizers map far more than the program asks for";
#endif
    getrlimit(RLIMIT_DATA, &at_start_);
  }
  void TearDown() override { setrlimit(RLIMIT_DATA, &at_start_); }
  void set_limit(std::uint64_t bytes) {
    rlimit data = at_start_;
    data.rlim_cur = bytes;
    setrlimit(RLIMIT_DATA, &data);
  }
  static constexpr std::uint64_t kMiB = 1 << 20;
  rlimit at_start_{};
};

TEST_F(HeapBounds, AreLoosenedOnce) {
  {
    HeapBound heap;
    heap.loosen();
    EXPECT_EQ(data_limit(), at_start_.rlim_cur) << "there is no bound yet";
    heap.bound(512 * kMiB);
    const std::uint64_t bound = data_limit();
    ASSERT_LT(bound, at_start_.rlim_cur);
    EXPECT_GE(bound, 512 * kMiB);
    heap.loosen();
    const std::uint64_t loosened = data_limit();
    EXPECT_GT(loosened, bound);
    EXPECT_LE(loosened, bound + 8 * kMiB);
    for (int failure = 0; failure < 100; ++failure) heap.loosen();
    EXPECT_EQ(data_limit(), loosened);
  }
  EXPECT_EQ(data_limit(), at_start_.rlim_cur);
}

TEST_F(HeapBounds, LeaveALimitOfTheUserAlone) {
  const std::uint64_t of_the_user = 4096 * kMiB;
  if (at_start_.rlim_cur < of_the_user) GTEST_SKIP() << "the limit here is lower";
  set_limit(of_the_user);
  HeapBound heap;
  heap.bound(std::size_t{1} << 40);
  heap.loosen();
  EXPECT_EQ(data_limit(), of_the_user) << "no bound below it was set";
}

TEST_F(HeapBounds, AreNotLoosenedBeyondALimitOfTheUser) {
  std::uint64_t bound = 0;
  {
    HeapBound heap;
    heap.bound(512 * kMiB);
    bound = data_limit();
  }
  if (at_start_.rlim_cur < bound + kMiB) GTEST_SKIP() << "the limit here is lower";
  set_limit(bound + kMiB);
  HeapBound heap;
  heap.bound(512 * kMiB);
  ASSERT_LT(data_limit(), bound + kMiB);
  heap.loosen();
  EXPECT_EQ(data_limit(), bound + kMiB);
}

}  // namespace
}  // namespace ph::app
