// SPDX-License-Identifier: MIT
// Processes that share a folder, which are threads here: what they send each other, and what
// becomes of the others when one of them ends.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <thread>

#include "barcode/ranks/folder_transport.hpp"
#include "barcode/ranks/run_folder.hpp"
#include "facade/parts/post.hpp"
#include "ph/error.hpp"

namespace ph::barcode {
namespace {

using Bytes = std::vector<std::byte>;
namespace fs = std::filesystem;

constexpr int kPatience = 3;

class Exchange : public testing::Test {
 protected:
  Exchange()
      : folder_(
            (fs::temp_directory_path() / ("ph-exchange-" + std::to_string(std::random_device()())))
                .string()) {}
  ~Exchange() override { fs::remove_all(folder_); }

  /// @return what each rank threw; empty: nothing.
  std::vector<std::string> run(int size, const std::function<void(RunFolder&)>& rank) const {
    std::vector<std::string> thrown(static_cast<std::size_t>(size));
    std::vector<std::thread> threads;
    for (int i = 0; i < size; ++i)
      threads.emplace_back([&, i] {
        try {
          RunFolder run(folder_, i, size, kPatience);
          rank(run);
        } catch (const std::exception& error) {
          thrown[static_cast<std::size_t>(i)] = error.what();
        }
      });
    for (std::thread& thread : threads) thread.join();
    return thrown;
  }
  static void join(RunFolder& run) {
    run.join("the same\n", [](const std::string&) {});
  }

  const std::string folder_;
};

/// Bytes that are another number of others for each message.
Bytes message(int from, int to, int number) {
  Bytes bytes(static_cast<std::size_t>(number % 5 * 1000));
  for (std::size_t i = 0; i < bytes.size(); ++i)
    bytes[i] =
        static_cast<std::byte>(i * 7 + static_cast<std::size_t>(31 * from + 11 * to + number));
  return bytes;
}

TEST_F(Exchange, MessagesComeInTheirOrder) {
  constexpr int kMessages = 40;
  for (const int size : {1, 2, 4}) {
    const auto thrown = run(size, [&](RunFolder& folder) {
      join(folder);
      FolderTransport transport(folder);
      Post post(transport);
      for (int k = 0; k < kMessages; ++k)
        for (int to = 0; to < size; ++to)
          if (to != post.rank()) post.send(to, message(post.rank(), to, k));
      for (int from = size - 1; from >= 0; --from)
        for (int k = 0; k < kMessages && from != post.rank(); ++k)
          EXPECT_EQ(post.receive(from), message(from, post.rank(), k));
      EXPECT_TRUE(folder.leave());
    });
    EXPECT_EQ(thrown, std::vector<std::string>(static_cast<std::size_t>(size)));
    EXPECT_TRUE(fs::is_empty(folder_));
  }
}

TEST_F(Exchange, WhatAnOlderRunLeftIsRefused) {
  run(2, join);  // ends without a word
  const auto thrown = run(2, join);
  for (const std::string& what : thrown)
    EXPECT_NE(what.find("is there already"), what.npos) << what;
  EXPECT_NE(thrown[1].find("part-2"), std::string::npos);
}

TEST_F(Exchange, AFailureEndsTheOthersAtOnce) {
  const auto begin = std::chrono::steady_clock::now();
  const auto thrown = run(3, [&](RunFolder& folder) {
    join(folder);
    if (folder.rank() == 1) return folder.fail("no bread");
    FolderTransport(folder).receive(1);
  });
  EXPECT_EQ(thrown[0], "part 2 has failed: no bread");
  EXPECT_EQ(thrown[2], thrown[0]);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(kPatience));
}

TEST_F(Exchange, AfterAnErrorNothingIsLeftIfAllHaveEnded) {
  const auto end_after_error = [](RunFolder& folder) {
    try {
      join(folder);
      if (folder.rank() == 2) throw Error(ErrorKind::io, "no bread");
      FolderTransport(folder).receive(2);
    } catch (const Error& error) {
      folder.abandon(error.what());
    }
  };
  run(3, end_after_error);
  EXPECT_TRUE(fs::is_empty(folder_));
  run(1, [](RunFolder& folder) {
    join(folder);
    folder.abandon("no bread");
  });
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(Exchange, SilenceIsTakenForDeath) {
  const auto thrown = run(3, [&](RunFolder& folder) {
    join(folder);
    if (folder.rank() != 2) FolderTransport(folder).receive(0 == folder.rank() ? 1 : 0);
  });
  // The one that looks at part 3 says so, and the other one has it from there.
  EXPECT_EQ(thrown[1], "part 3 has said nothing for 3 s: it is taken to have died");
  EXPECT_EQ(thrown[0], "part 2 has failed: " + thrown[1]);
}

TEST_F(Exchange, TheyHaveToComputeTheSame) {
  const auto thrown = run(2, [&](RunFolder& folder) {
    try {
      folder.join(folder.rank() == 0 ? "a\nb\n" : "a\nc\n", [](const std::string&) {});
    } catch (const Error& error) {
      folder.fail(error.what());
      throw;
    }
    FolderTransport(folder).receive(1 - folder.rank());
  });
  EXPECT_EQ(thrown[1], "--exchange: part 2: found c, expected b as part 1");
  EXPECT_EQ(thrown[0], "part 2 has failed: " + thrown[1]);
}

TEST_F(Exchange, AStopIsToldToTheOthers) {
  const auto thrown = run(2, [&](RunFolder& folder) {
    join(folder);
    if (folder.rank() == 0) folder.stop();
    FolderTransport(folder).receive(1 - folder.rank());
  });
  EXPECT_EQ(thrown[0], "stopped");
  EXPECT_EQ(thrown[1], "part 1 has failed: it was stopped");
}

TEST_F(Exchange, AMessageThatChangedIsAnError) {
  const auto thrown = run(2, [&](RunFolder& folder) {
    join(folder);
    FolderTransport transport(folder);
    Post post(transport);
    if (folder.rank() == 1) {
      post.send(0, message(1, 0, 1));
      const fs::path file = folder.messages_to(0) / "2-0";
      std::fstream(file, std::ios::in | std::ios::out | std::ios::binary).seekp(20).put('x');
      post.send(0, message(1, 0, 2));
    } else {
      while (!fs::exists(folder.messages_to(0) / "2-1")) std::this_thread::yield();
      post.receive(1);
    }
  });
  EXPECT_EQ(thrown[0],
            "part 1: message from part 2: found another checksum than was sent: it is damaged");
}

TEST_F(Exchange, AFolderThatVanishesIsAnError) {
  const auto thrown = run(2, [&](RunFolder& folder) {
    join(folder);
    if (folder.rank() == 0) fs::remove_all(fs::path(folder_) / "ph-run");
    FolderTransport(folder).receive(1 - folder.rank());
  });
  for (const std::string& what : thrown) EXPECT_EQ(what, folder_ + "/ph-run is gone");
}

}  // namespace
}  // namespace ph::barcode
