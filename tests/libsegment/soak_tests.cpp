// SPDX-License-Identifier: MIT
// Segments a thousand frames. Memory must not grow, and threads must change nothing.
#include <gtest/gtest.h>
#include <malloc.h>

#include <iostream>

#include "ph/label_tracker.hpp"
#include "tests/libsegment/scenery.hpp"

namespace ph::segment {
namespace {

using test::TableScene;

/// Small frames, each of which is different.
std::vector<std::vector<float>> frames(int count) {
  std::vector<std::vector<float>> result;
  for (int i = 0; i < count; ++i) {
    const double x = 0.01 * i;
    result.push_back(TableScene({{{-0.22 + x, -0.05, 0}, {-0.10 + x, 0.07, 0.12}},
                                 {{0.1, -0.05, 0}, {0.2, 0.05, 0.1 + x}},
                                 {{-0.2 + 2 * x, 0.1, 0}, {-0.1 + 2 * x, 0.2, 0.1}}},
                                0.4)
                         .xyz());
  }
  return result;
}

// The bytes in use, and the bytes that the allocator has obtained from the system.
struct Heap {
  double used, held;
};
Heap heap() {
  const struct mallinfo2 info = mallinfo2();
  return {static_cast<double>(info.uordblks + info.hblkhd),
          static_cast<double>(info.arena + info.hblkhd)};
}

TEST(Soak, AThousandFramesTakeNoMoreMemoryThanAHundred) {
  const auto scenes = frames(12);
  constexpr double kibibyte = 1024;
  for (const Method method : {Method::surface, Method::paper}) {
    SegmentOptions options;
    options.method = method;
    LabelTracker tracker;
    Heap before{};
    std::size_t segments = 0;
    for (int i = 0; i < 1000; ++i) {
      if (i == 100) before = heap();
      std::vector<float> xyz = scenes[static_cast<std::size_t>(i) % scenes.size()];
      for (float& c : xyz) c += 1e-4F * static_cast<float>(i % 7);
      const Segmentation s = segment(CloudView{xyz, {}}, options);
      tracker.update(s.tree, s.cut);
      segments += s.cut.segments.size();
    }
    const Heap after = heap();
    std::cout << segments << " segments; in use " << (after.used - before.used) / kibibyte
              << " KiB more, held " << (after.held - before.held) / kibibyte << " KiB more\n";
    EXPECT_GT(segments, 2000U);
    EXPECT_LT(after.used - before.used, 64 * kibibyte);
    EXPECT_LT(after.held - before.held, 4096 * kibibyte);
  }
}

TEST(Soak, ThreadsChangeNoByteOfTheTree) {
  for (const auto& xyz : frames(6)) {
    const std::string bytes = tree_bytes(segment(CloudView{xyz, {}}).tree);
    for (const int threads : {1, 2, 3, 8}) {
      RunContext context;
      context.threads = threads;
      EXPECT_EQ(tree_bytes(segment(CloudView{xyz, {}}, {}, context).tree), bytes) << threads;
    }
  }
}

}  // namespace
}  // namespace ph::segment
